// The 1989 rule in exact arithmetic: one call of CONTCT, the path call by call, and that path beside a
// kernel's own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contct/exact/position.hpp"
#include "contct/path/observer.hpp"

namespace contct {

/// What CONTCT is told of a pair.
struct listing_pair {
  rational c;       ///< position of its face
  rational d;       ///< D there
  rational d_star;  ///< d* there
  bool closed;      ///< in contact
  int surface;      ///< face_above or face_below
};

/// What CONTCT answers.
struct listing_answer {
  rational_vector s;                ///< SS [pairs]
  std::vector<listing_branch> way;  ///< how each pair came to its s [pairs]
  rational s_min = 1;               ///< SMIN
  std::vector<int> toggled;         ///< pairs from 0, in their order

  /// Pairs, from 0, that have their event exactly at SMIN.
  [[nodiscard]] std::vector<int> winners() const;
};

/// One call of CONTCT without rounding. EPSGAP, DELTA and EPSMUL are the decimals that are printed.
[[nodiscard]] listing_answer answer_exactly(std::span<const listing_pair> pairs);

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
  void ask(const rational_vector& d_star);

  position at_;
  exact_call call_;
  path_status status_ = path_status::solved;
};

/// A place on a path: a step and an increment in it, from 1.
struct path_place {
  int step, increment;
};

/// Observes the path of a kernel with the listing's rule and asks the exact path one call for each of its
/// calls. Both are comparable as long as they had the same events: then the call of the same number is the
/// same one but for rounding.
class exact_companion final : public observer {
 public:
  /// `p` must outlive this object. Nothing is computed behind `last`, where that is given; an increment 0 in
  /// it means all of the step.
  explicit exact_companion(const exact_problem& p, std::optional<path_place> last = {})
      : path_(p), last_(last) {}

  void incremented(const increment& i) override;

  /// The exact call with the number of the kernel's last one. Null after the paths have parted, and where
  /// the exact one cannot be followed.
  [[nodiscard]] const exact_call* call() const { return has_call_ ? &path_.call() : nullptr; }
  /// The first increment of which the events differ.
  [[nodiscard]] const std::optional<path_place>& parted() const { return parted_; }
  /// Why the exact path was not followed up to here, or ended before; empty where neither is so.
  [[nodiscard]] const std::string& stopped() const { return stopped_; }

 private:
  path_1989 path_;
  std::optional<path_place> last_, parted_;
  std::string stopped_;
  bool has_call_ = false;
};

}  // namespace contct
