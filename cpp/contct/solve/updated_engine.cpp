// One factor for many events: the response at the pairs is updated by one column of the inverse an event.
#include <algorithm>
#include <cmath>
#include <map>

#include "contct/solve/factored_stiffness.hpp"
#include "contct/solve/spring_engine.hpp"

namespace contct {
namespace {

// The least 1 - k c for removing a stiff spring: below it, too many of its digits have cancelled.
constexpr double least_denominator = 1e-2;

// Columns that are solved for together: a factor is read from memory once for all of them.
constexpr std::size_t block_width = 8;

/// Columns until their sums cost what a factor costs: c^2 / 2 columns of pairs against n kd^2 / 2. Twice as
/// many, since a factor's products come from the cache and the columns' do not: the total is then least.
std::size_t columns_worth_keeping(double flops_of_factor, std::size_t pairs) {
  const double worth = std::sqrt(2 * flops_of_factor / static_cast<double>(std::max<std::size_t>(pairs, 1)));
  return static_cast<std::size_t>(std::clamp(worth, 8.0, 1000.0));
}

/// K0 is factored; K = K0 + the springs that have been taken in since, or less those taken out. With
/// c_j = K_j^-1 e_j, the column of toggle j when it came, and g_j = sigma k / (1 + sigma k (c_j)_p),
///
///     K^-1 = K0^-1 - sum g_j c_j c_j^T                                  (Sherman and Morrison)
///
/// restricted to the pairs everywhere. Columns of K0^-1 do not depend on the toggles: those of pairs that
/// are likely to be next are solved for together.
class inverse_columns {
 public:
  /// Must outlive this object.
  inverse_columns(factored_stiffness& k0, std::size_t pairs) : k0_(k0), pairs_(pairs) {}

  struct toggle {
    int pair;
    double sigma_k;
    double weight;               // g
    std::vector<double> column;  // c [pairs]
  };
  [[nodiscard]] const std::vector<toggle>& toggles() const { return toggles_; }
  [[nodiscard]] int passes() const { return passes_; }  ///< over the factor, so far

  /// The factor is a new one: drop all that depended on the last.
  void start_anew() {
    toggles_.clear();
    ahead_.clear();
  }

  /// K^-1 e for the dof of a pair, at the pairs [pairs]. `last_s`: the kernel's last scale factors [pairs],
  /// or nothing; the pairs with the least are likely to be next.
  [[nodiscard]] std::vector<double> column(int pair, std::span<const double> last_s) {
    auto found = ahead_.find(pair);
    if (found != ahead_.end()) {
      ++used_ahead_;
    } else {
      solve_ahead(pair, last_s);
      found = ahead_.find(pair);
    }
    std::vector<double> c = std::move(found->second);
    ahead_.erase(found);
    correct(c);
    return c;
  }

  /// K becomes K + sigma_k e e^T; `c` is the pair's column. Corrects the response at the pairs, too.
  void take_in(int pair, double sigma_k, std::vector<double> c, std::span<double> response) {
    const double g = sigma_k / (1.0 + sigma_k * c[pair]);
    toggles_.push_back({pair, sigma_k, g, std::move(c)});
    subtract(toggles_.back(), response);
  }

  /// K0^-1 b becomes K^-1 b, at the pairs [pairs].
  void correct(std::span<double> at_pairs) const {
    for (const toggle& t : toggles_) subtract(t, at_pairs);
  }

 private:
  static void subtract(const toggle& t, std::span<double> at_pairs) {
    const double factor = t.weight * at_pairs[t.pair];
    const double* const c = t.column.data();
    for (std::size_t i = 0; i < at_pairs.size(); ++i) at_pairs[i] -= factor * c[i];
  }

  /// The pair, and as many others as fill a block: those with the least scale factors whose columns are not
  /// yet solved for. Only the pair itself while fewer than half of such columns are used.
  [[nodiscard]] std::vector<int> likely_next(int pair, std::span<const double> last_s) const {
    std::vector<int> chosen = {pair};
    constexpr std::size_t enough_to_judge = 4 * block_width;
    const bool seldom_used = solved_ahead_ >= enough_to_judge && 2 * used_ahead_ < solved_ahead_;
    if (last_s.size() != pairs_ || seldom_used) return chosen;
    std::vector<std::pair<double, int>> nearest;
    for (int i = 0; i < static_cast<int>(pairs_); ++i)
      if (last_s[i] < 1.0 && i != pair && !ahead_.contains(i)) nearest.emplace_back(last_s[i], i);
    const auto wanted = nearest.begin() + static_cast<int>(std::min(block_width - 1, nearest.size()));
    std::partial_sort(nearest.begin(), wanted, nearest.end());
    for (auto n = nearest.begin(); n != wanted; ++n) chosen.push_back(n->second);
    return chosen;
  }

  void solve_ahead(int pair, std::span<const double> last_s) {
    const std::vector<int> chosen = likely_next(pair, last_s);
    std::vector<std::vector<double>> columns = k0_.columns_at_pairs(chosen);
    for (std::size_t i = 0; i < chosen.size(); ++i) ahead_[chosen[i]] = std::move(columns[i]);
    solved_ahead_ += chosen.size() - 1;
    ++passes_;
  }

  factored_stiffness& k0_;
  std::size_t pairs_;
  std::vector<toggle> toggles_;
  std::map<int, std::vector<double>> ahead_;  // columns of K0^-1 at the pairs, by their pair
  int passes_ = 0;
  std::size_t solved_ahead_ = 0, used_ahead_ = 0;
};

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
  updated_engine(const linear_structure& s, factored_by how)
      : spring_engine(s, how),
        columns_(stiffness_, s.pairs.size()),
        most_toggles_(columns_worth_keeping(stiffness_.flops(), s.pairs.size())),
        response_(s.pairs.size()),
        work_(s.dofs()) {}

  void respond(const residual_load& residual, std::span<double> d_star) override {
    if (!has_factor_) factor_anew();
    if (!apply_switched([&](int pair) { return update(pair, residual.last_s); })) factor_anew();
    if (response_to_ != residual.version) {
      respond_anew(residual);
    } else if (drift_.is_due() && !columns_.toggles().empty() && !still_solves(residual.increment)) {
      factor_anew();
      respond_anew(residual);
    }
    for (std::size_t i = 0; i < d_star.size(); ++i) d_star[i] = residual.share * response_[i];
  }

  void recover(std::span<const double> load, std::span<const double> pair_forces,
               std::span<double> u) override {
    if (!has_factor_ || !columns_.toggles().empty() || applied_ != wanted_) factor_anew();
    apply_all();
    solve_for_all(load, pair_forces, u);
  }

  [[nodiscard]] double reciprocal_condition() override {
    has_factor_ = false;
    response_to_ = 0;
    return spring_engine::reciprocal_condition();
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
    if (columns_.toggles().size() >= most_toggles_) return false;
    const double k = structure_.pairs[pair].stiffness;
    const double sigma_k = applied_[pair] != 0 ? k : -k;
    std::vector<double> column = columns_.column(pair, last_s);
    if (!(1.0 + sigma_k * column[pair] > least_denominator)) return false;
    columns_.take_in(pair, sigma_k, std::move(column), response_);
    ++counts_.updates;
    return true;
  }

  /// Compares x with the solution of K_0 y = f - sum of sigma k x_p e_p, which is x again.
  [[nodiscard]] bool still_solves(std::span<const double> increment) {
    ++counts_.checks;
    std::copy(increment.begin(), increment.end(), work_.begin());
    for (const inverse_columns::toggle& t : columns_.toggles())
      add_at_pair(structure_, t.pair, -t.sigma_k * response_[t.pair], work_);
    stiffness_.solve(work_);
    ++counts_.solves;
    drift found;
    for (std::size_t i = 0; i < response_.size(); ++i) {
      const double again = structure_.seen_by_pair(i, work_);
      found.include(again, again - response_[i]);
    }
    return drift_.accepts(found);
  }

  inverse_columns columns_;
  bool has_factor_ = false;
  std::size_t most_toggles_;       // between factors
  std::vector<double> response_;   // to the whole increment [pairs]
  std::uint64_t response_to_ = 0;  // which increment
  std::vector<double> work_;       // [dofs]
  drift_monitor drift_{16};
};

}  // namespace

std::unique_ptr<stiffness_engine> make_updated_engine(const linear_structure& s, factored_by how) {
  return std::make_unique<updated_engine>(s, how);
}

}  // namespace contct
