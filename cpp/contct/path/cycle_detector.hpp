// Detects cycles of toggles at which nothing moves.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "contct/kernel/call.hpp"

namespace contct::path {

/// Watches statuses while nothing moves. The path is deterministic: when a set of statuses returns while D
/// and R* are the same to the last bit, the same toggles follow for ever. Brent's method finds this with one
/// saved set.
class cycle_detector {
 public:
  explicit cycle_detector(std::size_t pairs) : toggles_(pairs) {}

  /// A new step begins.
  void reset();

  /// Tell of one increment: whether D or R* moved, the statuses after it, and its events.
  /// Returns true when these statuses came before and nothing has moved since.
  bool repeats(bool moved, std::span<const int> status, std::span<const event> events);

  /// Pairs, from 0, that toggled more than once in the last increments (at most 200 of them).
  [[nodiscard]] std::vector<int> restless_pairs() const;

 private:
  void remember(std::span<const event> events);

  std::vector<int> saved_;
  long steps_since_saved_ = 0;
  long next_save_ = 1;
  std::deque<std::vector<event>> recent_;
  std::vector<int> toggles_;  // of each pair, in recent_
};

}  // namespace contct::path
