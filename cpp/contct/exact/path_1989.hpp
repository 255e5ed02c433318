// The path that the 1989 rule takes in exact arithmetic, call by call.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contct/exact/listing.hpp"
#include "contct/exact/position.hpp"

namespace contct::exact {

/// One call of CONTCT on the exact path, and the increment that it led to.
struct exact_call {
  int step = 0, increment = 0;  ///< from 1
  listing_answer answer;
  exact_increment led_to;
};

/// The 1989 driver without rounding.
class path_1989 {
 public:
  /// `p` must outlive this object.
  explicit path_1989(const exact_problem& p) : at_(p) {}

  /// Ask CONTCT once more and apply what it answers. False where the path has ended. Throws too_long.
  bool next(const exact_progress& tell = {});

  /// The last call; there was one.
  [[nodiscard]] const exact_call& call() const { return call_; }
  /// Did the last call end a step?
  [[nodiscard]] bool ended_step() const { return call_.answer.s_min == 1; }
  /// After `next` has returned false: how the path ended.
  [[nodiscard]] path_status status() const { return status_; }
  /// Where the step ended, or where it stopped.
  [[nodiscard]] exact_step_end state(std::vector<exact_increment> increments) const {
    return at_.end(std::move(increments), false);
  }

 private:
  bool begin_increment();
  void ask(const vector& d_star);

  position at_;
  exact_call call_;
  path_status status_ = path_status::solved;
};

}  // namespace contct::exact
