// One factor for many events: the response at the pairs is updated by one column of the inverse an event.
#include <algorithm>
#include <cmath>

#include "contct/solve/factored_stiffness.hpp"
#include "contct/solve/inverse_columns.hpp"
#include "contct/solve/spring_engine.hpp"

namespace contct::solve {
namespace {

// The least 1 - k c when a stiff spring opens: with less, too many of its digits have cancelled.
constexpr double least_denominator = 1e-2;

/// Columns until their sums cost what a factor costs: c^2 / 2 columns of pairs against n kd^2 / 2. Twice as
/// many, since a factor's products come from the cache and the columns' do not: the total is then least.
std::size_t columns_worth_keeping(double flops_of_factor, std::size_t pairs) {
  const double worth = std::sqrt(2 * flops_of_factor / static_cast<double>(std::max<std::size_t>(pairs, 1)));
  return static_cast<std::size_t>(std::clamp(worth, 8.0, 1000.0));
}

/// Keeps x, the response of every pair to the step's whole load increment. When the spring k of pair p goes
/// in (sigma = 1) or out (-1), K' = K + sigma k e e^T, and with c = K^-1 e, a column of the inverse at the
/// pairs (Sherman and Morrison):
///
///     g = sigma k / (1 + sigma k c_p),   x' = x - g x_p c
///
/// `inverse_columns` has the columns. Nothing else costs more than O(pairs) an event.
/// Memory: a factor, and a column of pairs a toggle.
///
/// Updates drift: the drift monitor says when x is checked by one more solve. The factor is made anew when
/// the drift is too large, when the columns cost more than a factor would, or when 1 + sigma k c_p has lost
/// its digits.
class updated_engine final : public spring_engine {
 public:
  updated_engine(const linear_structure& s, std::string_view name, factored_by how)
      : spring_engine(s),
        name_(name),
        stiffness_(s, how),
        columns_(s, stiffness_),
        most_toggles_(columns_worth_keeping(stiffness_.flops(), s.pairs.size())),
        response_(s.pairs.size()),
        work_(s.dofs()) {}
  [[nodiscard]] std::string_view name() const override { return name_; }

  void respond(const residual_load& residual, std::span<double> d_star) override {
    if (!has_factor_) factor_anew();
    if (!apply_switched([&](int pair) { return update(pair, residual.last_s); })) factor_anew();
    if (response_to_ != residual.version) {
      respond_anew(residual);
    } else if (drift_.is_due() && columns_.toggles() > 0 && !still_solves(residual.increment)) {
      factor_anew();
      respond_anew(residual);
    }
    for (std::size_t i = 0; i < d_star.size(); ++i) d_star[i] = residual.share * response_[i];
  }

  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override {
    if (!has_factor_ || columns_.toggles() > 0 || applied_ != wanted_) factor_anew();
    apply_all();
    stiffness_.solve_refined(with_pair_forces(structure_, load, pair_forces), u);
  }

  [[nodiscard]] double reciprocal_condition() override {
    has_factor_ = false;
    response_to_ = 0;
    return stiffness_.reciprocal_condition(wanted_);
  }

  [[nodiscard]] engine_counts counts() const override {
    engine_counts all = counts_;
    all.solves += columns_.passes();
    return all;
  }

 private:
  void factor_anew() {
    has_factor_ = false;
    stiffness_.factor(apply_all());
    ++counts_.factors;
    has_factor_ = true;
    columns_.start_anew();
    response_to_ = 0;
  }

  void respond_anew(const residual_load& residual) {
    std::copy(residual.increment.begin(), residual.increment.end(), work_.begin());
    stiffness_.solve(work_);
    ++counts_.solves;
    gather_at_pairs(structure_, work_, response_);
    columns_.correct(response_);
    response_to_ = residual.version;
  }

  /// Update the response by the toggle of one pair. False when that takes a new factor.
  [[nodiscard]] bool update(int pair, std::span<const double> last_s) {
    if (columns_.toggles() >= most_toggles_) return false;
    const double sigma_k = applied_[pair] != 0 ? stiffness_of(pair) : -stiffness_of(pair);
    const std::span<const double> c = columns_.column(pair, last_s);
    if (!(1.0 + sigma_k * c[pair] > least_denominator)) return false;
    const double factor = columns_.take_in(pair, sigma_k) * response_[pair];
    for (std::size_t i = 0; i < response_.size(); ++i) response_[i] -= factor * c[i];
    ++counts_.updates;
    return true;
  }

  /// Compares x with the solution of K_0 y = f - sum of sigma k x_p e_p, which is x again.
  [[nodiscard]] bool still_solves(std::span<const double> increment) {
    ++counts_.checks;
    std::copy(increment.begin(), increment.end(), work_.begin());
    for (const inverse_columns::toggle& t : columns_.all_toggles())
      work_[structure_.dof_of_pair(t.pair)] -= t.sigma_k * response_[t.pair];
    stiffness_.solve(work_);
    ++counts_.solves;
    drift found;
    for (std::size_t i = 0; i < response_.size(); ++i) {
      const double again = work_[structure_.dof_of_pair(i)];
      found.include(again, again - response_[i]);
    }
    return drift_.accepts(found);
  }

  std::string name_;
  factored_stiffness stiffness_;
  inverse_columns columns_;
  bool has_factor_ = false;
  std::size_t most_toggles_;                          // between factors
  std::vector<double> response_;                      // to the whole increment [pairs]
  std::uint64_t response_to_ = 0;                     // which increment
  std::vector<double> work_;                          // [dofs]
  drift_monitor drift_{{16, 256, 1e-11, 1e-11 / 4}};  // 1e-8 of D is promised
};

}  // namespace

std::unique_ptr<stiffness_engine> make_updated_engine(const linear_structure& s, std::string_view name) {
  const factored_by how = name == "dissected" ? factored_by::cholmod : factored_by::storage;
  return std::make_unique<updated_engine>(s, name, how);
}

}  // namespace contct::solve
