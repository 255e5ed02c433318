// The common part of all engines: a factor, the wanted and the applied springs, counts, and a drift monitor.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "contct/solve/factored_stiffness.hpp"

namespace contct {

/// The result of a check: the largest response of a pair, and the largest correction of a response.
struct drift {
  double size = 0.0;
  double correction = 0.0;

  void include(double response, double corrected_by) {
    size = std::max(size, std::abs(response));
    correction = std::max(correction, std::abs(corrected_by));
  }
};

/// Decides when a response is checked. The interval between checks halves if the drift is more than allowed,
/// and doubles if it is negligible.
class drift_monitor {
 public:
  /// `first_check`: the number of responses until the first check, and the first interval. The longest
  /// interval is 16 times as long.
  explicit drift_monitor(int first_check)
      : longest_(16 * first_check), until_check_(first_check), check_every_(first_check) {}

  /// Counts a response. True if it must be checked.
  [[nodiscard]] bool is_due() { return --until_check_ <= 0; }
  void check_next() { until_check_ = 1; }
  void start_interval() { until_check_ = check_every_; }

  /// False if the drift is more than allowed.
  [[nodiscard]] bool accepts(const drift& found) {
    const bool good = found.correction <= allowed * found.size;
    if (!good) check_every_ = std::max(check_every_ / 2, shortest);
    if (found.correction < allowed / 4 * found.size) check_every_ = std::min(2 * check_every_, longest_);
    start_interval();
    return good;
  }

 private:
  static constexpr int shortest = 4;
  static constexpr double allowed = 1e-11;  // relative to the response
  int longest_;
  int until_check_;
  int check_every_;
};

/// An engine that records the wanted springs in switch_spring and applies them at the next response.
class spring_engine : public stiffness_engine {
 public:
  void switch_spring(int pair, bool closed) final {
    wanted_[pair] = closed ? 1 : 0;
    switched_.push_back(pair);
  }
  [[nodiscard]] engine_counts counts() const override { return counts_; }
  [[nodiscard]] double reciprocal_condition() override { return stiffness_.reciprocal_condition(wanted_); }

 protected:
  explicit spring_engine(const linear_structure& s, factored_by how = factored_by::storage)
      : structure_(s), stiffness_(s, how), applied_(s.pairs.size()) {
    for (const contact_pair& p : s.pairs) wanted_.push_back(p.closed ? 1 : 0);
  }

  /// Marks all wanted springs as applied, for an engine that factors K with them next.
  const std::vector<char>& apply_all() {
    switched_.clear();
    return applied_ = wanted_;
  }

  /// Applies the switched springs by update(pair): first the added ones, then the removed ones, so that the
  /// structure is always held. False as soon as `update` returns false: a new factor is needed.
  template <class Update>
  [[nodiscard]] bool apply_switched(Update update) {
    for (const char closed : {char{1}, char{0}}) {
      for (const int pair : switched_) {
        if (wanted_[pair] != closed || applied_[pair] == closed) continue;
        applied_[pair] = closed;
        if (!update(pair)) return false;
      }
    }
    switched_.clear();
    return true;
  }

  /// Solves for u [dofs] with the factor, which must contain the wanted springs.
  void solve_for_all(std::span<const double> load, std::span<const double> pair_forces, std::span<double> u) {
    stiffness_.solve_refined(with_pair_forces(structure_, load, pair_forces), u);
  }

  const linear_structure& structure_;
  factored_stiffness stiffness_;
  std::vector<char> wanted_;   // [pairs] 1 if the spring is switched in
  std::vector<char> applied_;  // [pairs] 1 if the spring is in the factor or its updates
  engine_counts counts_;

 private:
  std::vector<int> switched_;  // pairs whose wanted and applied springs may differ
};

/// The engines "updated" (and "petsc") and "condensed"; make_engine calls these functions.
[[nodiscard]] std::unique_ptr<stiffness_engine> make_updated_engine(const linear_structure& s,
                                                                    factored_by how);
[[nodiscard]] std::unique_ptr<stiffness_engine> make_condensed_engine(const linear_structure& s);

/// True if `s` is a beam with pairs, stored as a band.
[[nodiscard]] bool can_be_condensed(const linear_structure& s);

}  // namespace contct
