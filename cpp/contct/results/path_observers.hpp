// Observers of a path: lockstep with other kernels, early toggles, the trace, and explanations.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/harness/explanation.hpp"
#include "contct/harness/lockstep.hpp"
#include "contct/kernel/trace.hpp"
#include "contct/path/observer.hpp"

namespace contct {

/// Puts each call of a path to other kernels, and compares their answers.
class lockstep_on_path : public observer, public lockstep {
 public:
  using lockstep::lockstep;
  void called(const answered_call& c) override { put(c); }
};

/// A toggle of a pair that was not at its face.
struct early_toggle {
  int step;         ///< from 1
  int number;       ///< number of the increment, from 1
  event what;       ///< pair from 0
  double distance;  ///< distance from the face at the toggle
  double share;     ///< `distance` as a share of the largest deflection at any pair so far
};

/// Records toggles of pairs that are farther from the face than rounding explains.
class early_toggles final : public observer {
 public:
  void called(const answered_call& c) override;
  void incremented(const increment& i) override;

  [[nodiscard]] const std::vector<early_toggle>& all() const { return all_; }

 private:
  std::map<int, double> distances_;  // from the face, of each pair (from 0) that the last call toggled
  double largest_ = 0.0;
  std::vector<early_toggle> all_;
};

/// Passes the trace of a path to a function: first the header, then each call. Keeps no calls in memory.
class trace_recorder final : public observer {
 public:
  using sink = std::function<void(std::string_view text)>;
  trace_recorder(const trace_header& h, sink to);
  void called(const answered_call& c) override;

 private:
  sink to_;
  std::string text_;
};

/// The requested step and increment, from 1; 0 requests all.
struct increments_wanted {
  int step = 0;
  int increment = 0;
  [[nodiscard]] bool holds(int s, int i) const {
    return (step == 0 || step == s) && (increment == 0 || increment == i);
  }
};

struct explained_increment {
  const increment& what;
  double fraction_before = 0.0;  ///< share of the step's load applied before the increment
  const explained_call& call;
  const call_outputs* other = nullptr;  ///< the second kernel's outputs; null without an answer
  std::optional<mismatch> apart;        ///< the first difference between the two kernels
  bool left_undone = false;  ///< the driver undid the toggles, because the remaining load is only rounding
};

/// Explains the path of a kernel with the 1989 rule. Passes each requested increment to a function, with
/// a second kernel's answer, and keeps no increments.
class explained_path final : public lockstep_on_path {
 public:
  using sink = std::function<void(const explained_increment&)>;
  /// `second` names one kernel, or is empty. Throws std::invalid_argument if the precision or rule of
  /// this kernel differs from the leader's.
  explained_path(const kernel_facts& leader, std::span<const std::string> second, increments_wanted wanted,
                 sink to);

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;

  /// The number of increments passed on.
  [[nodiscard]] std::int64_t explained() const { return explained_; }
  [[nodiscard]] int steps() const { return steps_; }
  /// The number of increments of the longest requested step.
  [[nodiscard]] int most_increments() const { return most_increments_; }

 private:
  int real_bytes_;
  increments_wanted wanted_;
  sink to_;
  std::int64_t explained_ = 0;
  int steps_ = 0, most_increments_ = 0;
  double fraction_ = 0.0;  // share of the step's load applied so far
  double largest_ = 0.0;
  explained_call call_;
};

}  // namespace contct
