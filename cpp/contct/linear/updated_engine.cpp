// The engine with one factor for many events: each event updates the responses of the pairs by one column of
// the inverse.
#include <algorithm>
#include <cmath>
#include <map>

#include "contct/linear/factored_stiffness.hpp"
#include "contct/linear/spring_engine.hpp"

namespace contct {
namespace {

// The least 1 - k c_p for removing a spring k by an update; below, too many digits of 1 - k c_p have
// cancelled.
constexpr double least_denominator = 1e-2;

// The number of columns solved for together, so that the factor is read from memory once.
constexpr std::size_t block_width = 8;

/// The number of toggles after which a new factor is cheaper: c toggles take c^2 / 2 additions of columns
/// [pairs], and these additions then cost as much as a factorisation.
std::size_t columns_worth_keeping(double flops_of_factor, std::size_t pairs) {
  const double worth = std::sqrt(2 * flops_of_factor / static_cast<double>(std::max<std::size_t>(pairs, 1)));
  return static_cast<std::size_t>(std::clamp(worth, 8.0, 1000.0));
}

/// Computes columns of K^-1. K0 is factored; K is K0 plus the springs added since, minus the springs removed
/// since. Toggle j adds (sigma = 1) or removes (sigma = -1) the spring k of pair p. With c_j = K_j^-1 e_p,
/// the column of p before this toggle, and g_j = sigma k / (1 + sigma k (c_j)_p),
///
///     K^-1 = K0^-1 - sum g_j c_j c_j^T                                  (Sherman and Morrison)
///
/// with all vectors restricted to the pairs. Columns of K0^-1 do not depend on the toggles, so the columns of
/// pairs that are likely to toggle next are solved for together.
class inverse_columns {
 public:
  /// Counts solves with the factor in `solves`, which must outlive this object, as `k0` must.
  inverse_columns(factored_stiffness& k0, std::size_t pairs, std::int64_t& solves)
      : k0_(k0), pairs_(pairs), solves_(solves) {}

  struct toggle {
    int pair;
    double sigma_k;
    double weight;               // g
    std::vector<double> column;  // c [pairs]
  };
  [[nodiscard]] const std::vector<toggle>& toggles() const { return toggles_; }

  /// Drops all toggles and columns, because K0 has a new factor.
  void start_anew() {
    toggles_.clear();
    ahead_.clear();
  }

  /// [pairs] the column K^-1 e of `pair`. `last_s`: see residual_load.
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

  /// Replaces K by K + sigma_k e e^T, and updates `response` [pairs]. `c`: the column of `pair`.
  void take_in(int pair, double sigma_k, std::vector<double> c, std::span<double> response) {
    const double g = sigma_k / (1.0 + sigma_k * c[pair]);
    toggles_.push_back({pair, sigma_k, g, std::move(c)});
    subtract(toggles_.back(), response);
  }

  /// Changes K0^-1 b to K^-1 b [pairs].
  void correct(std::span<double> at_pairs) const {
    for (const toggle& t : toggles_) subtract(t, at_pairs);
  }

 private:
  static void subtract(const toggle& t, std::span<double> at_pairs) {
    const double factor = t.weight * at_pairs[t.pair];
    const double* const c = t.column.data();
    for (std::size_t i = 0; i < at_pairs.size(); ++i) at_pairs[i] -= factor * c[i];
  }

  /// Returns `pair` and, to fill a block, the pairs with the smallest scale factors below 1 whose columns are
  /// not known yet. Only `pair` if fewer than half of the columns solved ahead have been used.
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
    ++solves_;
  }

  factored_stiffness& k0_;
  std::size_t pairs_;
  std::int64_t& solves_;
  std::vector<toggle> toggles_;
  std::map<int, std::vector<double>> ahead_;  // by pair: columns of K0^-1 [pairs]
  std::size_t solved_ahead_ = 0, used_ahead_ = 0;
};

/// Keeps x, the response of every pair to the step's whole load increment. A toggle with column c and weight
/// g changes x to x - g x_p c. All work of an event but the column is O(pairs). Memory: a factor, and a
/// column [pairs] for each toggle.
///
/// Rounding accumulates in x (drift). The drift monitor decides when one more solve checks x. K is factored
/// again if the drift is too large, if the columns cost more than a factor, or if 1 + sigma k c_p has lost
/// its digits.
class updated_engine final : public spring_engine {
 public:
  updated_engine(const linear_system& s, std::unique_ptr<matrix_factor> by)
      : spring_engine(s, std::move(by)),
        columns_(stiffness_, s.pairs.size(), counts_.solves),
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

  [[nodiscard]] double reciprocal_condition() override {
    has_factor_ = false;
    response_to_ = 0;
    return spring_engine::reciprocal_condition();
  }

 private:
  void factor_wanted() override {
    if (!has_factor_ || !columns_.toggles().empty() || applied_ != wanted_) factor_anew();
    apply_all();
  }

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

  /// Updates the response for the toggle of `pair`. False if a new factor is needed.
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

  /// Checks the drift of x: solves K0 y = f - sum of sigma k x_p e_p, where y - x is the drift. False if the
  /// drift is more than allowed.
  [[nodiscard]] bool still_solves(std::span<const double> increment) {
    ++counts_.checks;
    std::copy(increment.begin(), increment.end(), work_.begin());
    for (const inverse_columns::toggle& t : columns_.toggles())
      structure_.pairs[t.pair].add_to(work_, -t.sigma_k * response_[t.pair]);
    stiffness_.solve(work_);
    ++counts_.solves;
    for (std::size_t i = 0; i < response_.size(); ++i) {
      const double again = structure_.pairs[i].seen_in(work_);
      drift_.include(again, again - response_[i]);
    }
    return drift_.accepts();
  }

  inverse_columns columns_;
  bool has_factor_ = false;
  std::size_t most_toggles_;       // until a new factor
  std::vector<double> response_;   // [pairs] response to the whole increment
  std::uint64_t response_to_ = 0;  // version of this increment; 0: none
  std::vector<double> work_;       // [dofs]
  drift_monitor drift_{16};
};

}  // namespace

std::unique_ptr<stiffness_engine> make_updated_engine(const linear_system& s,
                                                      std::unique_ptr<matrix_factor> by) {
  return std::make_unique<updated_engine>(s, std::move(by));
}

}  // namespace contct
