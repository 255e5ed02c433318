// The common part of all engines: a factor, the requested and the applied springs, counts, and a monitor of
// drift.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "contct/solve/factored_stiffness.hpp"

namespace contct {

/// The result of a check at the pairs: the largest response, and the largest correction to one.
struct drift {
  double size = 0.0;
  double correction = 0.0;

  void include(double response, double corrected_by) {
    size = std::max(size, std::abs(response));
    correction = std::max(correction, std::abs(corrected_by));
  }
};

/// Checks every so many responses. The interval halves when the drift is more than allowed, and doubles when
/// it is negligible.
class drift_monitor {
 public:
  /// `first_check`: responses until the first check, and at first between two; 16 times as many at most.
  explicit drift_monitor(int first_check)
      : longest_(16 * first_check), until_check_(first_check), check_every_(first_check) {}

  /// Count a response. True when it is to be checked.
  [[nodiscard]] bool is_due() { return --until_check_ <= 0; }
  void check_next() { until_check_ = 1; }
  void start_interval() { until_check_ = check_every_; }

  /// False when the drift is more than is allowed.
  [[nodiscard]] bool accepts(const drift& found) {
    const bool good = found.correction <= allowed * found.size;
    if (!good) check_every_ = std::max(check_every_ / 2, shortest);
    if (found.correction < allowed / 4 * found.size) check_every_ = std::min(2 * check_every_, longest_);
    start_interval();
    return good;
  }

 private:
  static constexpr int shortest = 4;
  static constexpr double allowed = 1e-11;  // correction relative to the response: 1e-8 of D is promised
  int longest_;
  int until_check_;
  int check_every_;
};

/// Switching a spring only records that it is wanted; the next response applies it.
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

  /// All wanted springs count as applied: for an engine that makes a new factor with them.
  const std::vector<char>& apply_all() {
    switched_.clear();
    return applied_ = wanted_;
  }

  /// Apply the springs that have been switched by `update(pair)`: first the added ones, then the removed
  /// ones, so that the structure is held throughout. False as soon as `update` returns false: a new factor is
  /// needed.
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

  /// Solve for every dof by the factor, which has the wanted springs.
  void solve_for_all(std::span<const double> load, std::span<const double> pair_forces, std::span<double> u) {
    stiffness_.solve_refined(with_pair_forces(structure_, load, pair_forces), u);
  }

  const linear_structure& structure_;
  factored_stiffness stiffness_;
  std::vector<char> wanted_;   // in, as switched [pairs]
  std::vector<char> applied_;  // in the factor and its updates [pairs]
  engine_counts counts_;

 private:
  std::vector<int> switched_;  // pairs that may differ
};

/// The engines that have a source of their own: see make_engine.
[[nodiscard]] std::unique_ptr<stiffness_engine> make_updated_engine(const linear_structure& s,
                                                                    factored_by how);
[[nodiscard]] std::unique_ptr<stiffness_engine> make_condensed_engine(const linear_structure& s);

/// Is this a beam with pairs, stored as a band: one that can be condensed?
[[nodiscard]] bool can_be_condensed(const linear_structure& s);

}  // namespace contct
