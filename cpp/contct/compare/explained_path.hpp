// Explains a path: what the listing did in each call and why, with another kernel's answer beside it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "contct/compare/compare.hpp"
#include "contct/compare/explanation.hpp"
#include "contct/path/observer.hpp"

namespace contct::compare {

/// Which increments are wanted; 0 is all. All count from 1.
struct increments_wanted {
  int step = 0;
  int increment = 0;
  [[nodiscard]] bool holds(int s, int i) const {
    return (step == 0 || step == s) && (increment == 0 || increment == i);
  }
};

/// One increment, as it is handed on.
struct explained_increment {
  const increment& what;
  double fraction_before = 0.0;  ///< share of the step's load consumed before it
  const explained_call& call;
  const call_outputs* other = nullptr;  ///< the second kernel's; null where there is none, or no answer
  std::optional<mismatch> apart;        ///< where the second kernel differs first
  bool left_undone = false;  ///< the driver took the toggles back: the load that is left is rounding
};

/// Observes a path of a kernel that has the listing's rule, and hands on the increments that are wanted, one
/// at a time: nothing is kept of those before.
class explained_path final : public observer {
 public:
  using sink = std::function<void(const explained_increment&)>;
  /// `second` may be null. Throws std::invalid_argument when it differs in precision or rule.
  explained_path(kernel_facts leader, std::unique_ptr<kernel> second, increments_wanted wanted, sink to);

  void called(const answered_call& c) override;
  void incremented(const increment& i) override;
  void step_ended(const step_state& s) override;

  [[nodiscard]] std::int64_t calls() const { return calls_; }
  [[nodiscard]] tally compared() const { return follower_ ? follower_->compared : tally{}; }
  [[nodiscard]] const std::optional<mismatch_report>& first() const;
  /// How many increments were handed on.
  [[nodiscard]] std::int64_t explained() const { return explained_; }
  /// Steps that were begun, and the increments of the longest among those that are wanted.
  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] int most_increments() const { return most_increments_; }

 private:
  kernel_facts leader_;
  std::unique_ptr<kernel> second_;
  std::optional<follower> follower_;  // asks the second kernel
  increments_wanted wanted_;
  sink to_;
  std::int64_t calls_ = 0, explained_ = 0;
  int steps_ = 0, number_ = 0, most_increments_ = 0;
  double fraction_ = 0.0;  // share of the step's load consumed so far
  double largest_ = 0.0;   // deflection so far
  explained_call call_;    // the last one
};

}  // namespace contct::compare
