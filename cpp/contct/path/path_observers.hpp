// Who observes a path: its calls in lockstep with other kernels, its trace, the toggles that came too early,
// and the explanation of its increments.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contct/compare/explanation.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/kernel/trace.hpp"
#include "contct/path/observer.hpp"

namespace contct {

/// Puts each call of a path to other kernels.
class lockstep_on_path final : public observer, public lockstep {
 public:
  using lockstep::lockstep;
  void called(const answered_call& c) override { put(c); }
};

/// A pair that was toggled away from its face.
struct early_toggle {
  int step;         ///< from 1
  int number;       ///< of the increment, from 1
  event what;       ///< pair from 0
  double distance;  ///< from the face when it was toggled
  double share;     ///< the same, of the largest deflection at any pair so far
};

/// Remembers the toggles that were off their face by more than rounding.
class early_toggles final : public observer {
 public:
  void called(const answered_call& c) override;
  void incremented(const increment& i) override;

  /// In the order in which they happened.
  [[nodiscard]] const std::vector<early_toggle>& all() const { return all_; }

 private:
  std::map<int, double> distances_;  // of the pairs toggled in the last call, from 0
  double largest_ = 0.0;
  std::vector<early_toggle> all_;
};

/// Hands a path's trace on as it grows, header first: memory does not grow with the calls.
class trace_recorder final : public observer {
 public:
  using sink = std::function<void(std::string_view text)>;
  trace_recorder(const trace_header& h, sink to);
  void called(const answered_call& c) override;

 private:
  sink to_;
  std::string text_;
};

/// Which increments are wanted; 0 is all. All count from 1.
struct increments_wanted {
  int step = 0;
  int increment = 0;
  [[nodiscard]] bool holds(int s, int i) const {
    return (step == 0 || step == s) && (increment == 0 || increment == i);
  }
};

/// One increment, as passed to the observer.
struct explained_increment {
  const increment& what;
  double fraction_before = 0.0;  ///< share of the step's load consumed before it
  const explained_call& call;
  const call_outputs* other = nullptr;  ///< the second kernel's; null if there is no answer of one
  std::optional<mismatch> apart;        ///< where the second kernel differs first
  bool left_undone = false;  ///< the driver took the toggles back: the load that is left is rounding
};

/// Explains a path of a kernel that has the 1989 rule, and passes on the requested increments, one at a time,
/// with another kernel's answer: earlier ones are not kept.
class explained_path final : public observer {
 public:
  using sink = std::function<void(const explained_increment&)>;
  /// `second`: one kernel by name, or none. Throws std::invalid_argument when it differs in precision or
  /// rule.
  explained_path(const kernel_facts& leader, std::span<const std::string> second, increments_wanted wanted,
                 sink to);

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  [[nodiscard]] std::int64_t calls() const { return compared_.calls(); }
  [[nodiscard]] tally compared() const { return compared_.compared(); }
  [[nodiscard]] const std::optional<mismatch_report>& first() const { return compared_.first(); }
  /// The number of increments passed on.
  [[nodiscard]] std::int64_t explained() const { return explained_; }
  /// The number of steps begun, and the increments of the longest requested one.
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] int most_increments() const { return most_increments_; }

 private:
  int real_bytes_;
  lockstep compared_;  // with the second kernel, if there is one
  increments_wanted wanted_;
  sink to_;
  std::int64_t explained_ = 0;
  int steps_ = 0, number_ = 0, most_increments_ = 0;
  double fraction_ = 0.0;  // share of the step's load consumed so far
  double largest_ = 0.0;   // deflection so far
  explained_call call_;    // the last one
};

}  // namespace contct
