// The common part of all engines: a factor, the wanted and the applied springs, counts, and a drift monitor.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "contct/linear/factored_stiffness.hpp"

namespace contct {

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

  /// In a check, takes the response of a pair and its correction, the drift.
  void include(double response, double correction) {
    size_ = std::max(size_, std::abs(response));
    correction_ = std::max(correction_, std::abs(correction));
  }

  /// Ends a check. False if the largest drift is more than allowed relative to the largest response.
  [[nodiscard]] bool accepts() {
    const bool good = correction_ <= allowed * size_;
    if (!good) check_every_ = std::max(check_every_ / 2, shortest);
    if (correction_ < allowed / 4 * size_) check_every_ = std::min(2 * check_every_, longest_);
    size_ = correction_ = 0.0;
    start_interval();
    return good;
  }

 private:
  static constexpr int shortest = 4;
  static constexpr double allowed = 1e-11;
  int longest_;
  int until_check_;
  int check_every_;
  double size_ = 0.0, correction_ = 0.0;  // the largest of the present check
};

/// An engine that records the wanted springs in switch_spring and applies them at the next response.
class spring_engine : public stiffness_engine {
 public:
  void switch_spring(int pair, bool closed) final {
    wanted_[pair] = closed ? 1 : 0;
    switched_.push_back(pair);
  }
  void recover(std::span<const double> load, std::span<const double> pair_forces, std::span<double> u) final {
    factor_wanted();
    stiffness_.solve_refined(with_pair_forces(structure_, load, pair_forces), u);
  }
  [[nodiscard]] engine_counts counts() const final { return counts_; }
  [[nodiscard]] double reciprocal_condition() override { return stiffness_.reciprocal_condition(wanted_); }

 protected:
  spring_engine(const linear_system& s, std::unique_ptr<matrix_factor> by)
      : structure_(s), stiffness_(s, std::move(by)), applied_(s.pairs.size()) {
    for (const pair_in<double>& p : s.pairs) wanted_.push_back(p.closed ? 1 : 0);
  }

  /// Makes the factor that of K with the wanted springs. Throws no_factor.
  virtual void factor_wanted() = 0;

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

  const linear_system& structure_;
  factored_stiffness stiffness_;
  std::vector<char> wanted_;   // [pairs] 1 if the spring is switched in
  std::vector<char> applied_;  // [pairs] 1 if the spring is in the factor or its updates
  engine_counts counts_;

 private:
  std::vector<int> switched_;  // pairs whose wanted and applied springs may differ
};

/// The engines "updated" (and "petsc") and "condensed"; make_engine calls these functions.
[[nodiscard]] std::unique_ptr<stiffness_engine> make_updated_engine(const linear_system& s,
                                                                    std::unique_ptr<matrix_factor> by);
[[nodiscard]] std::unique_ptr<stiffness_engine> make_condensed_engine(const linear_system& s);

/// True if `s` is a beam with pairs, stored as a band.
[[nodiscard]] bool can_be_condensed(const linear_system& s);

}  // namespace contct
