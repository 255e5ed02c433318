// What all engines have: a structure, the springs that are wanted and those that are applied, and counts.
#pragma once

#include <vector>

#include "contct/solve/engine.hpp"

namespace contct::solve {

/// Switching a spring only records that it is wanted; the next response applies it.
class spring_engine : public stiffness_engine {
 public:
  void switch_spring(int pair, bool closed) final {
    wanted_[pair] = closed ? 1 : 0;
    switched_.push_back(pair);
  }
  [[nodiscard]] engine_counts counts() const override { return counts_; }

 protected:
  explicit spring_engine(const linear_structure& s) : structure_(s), applied_(s.pairs.size()) {
    for (const contact_pair& p : s.pairs) wanted_.push_back(p.closed ? 1 : 0);
  }

  /// All wanted springs count as applied: for an engine that makes a new factor with them.
  const std::vector<char>& apply_all() {
    switched_.clear();
    return applied_ = wanted_;
  }

  /// Apply the springs that have been switched by `update(pair)`: first those that close, then those that
  /// open, so that the structure is held throughout. False as soon as `update` is: a new factor is due.
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

  [[nodiscard]] double stiffness_of(int pair) const { return structure_.pairs[pair].stiffness; }

  const linear_structure& structure_;
  std::vector<char> wanted_;   // closed, as switched [pairs]
  std::vector<char> applied_;  // closed, in the factor and its updates [pairs]
  engine_counts counts_;

 private:
  std::vector<int> switched_;  // pairs that may differ
};

}  // namespace contct::solve
