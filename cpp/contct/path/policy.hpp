// The decisions on a path that the paper's loop does not determine.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "contct/kernel/kernel.hpp"
#include "contct/path/path_state.hpp"

namespace contct {

/// How the structure responds to the residual load.
enum class response {
  elastic,  ///< d* is the response to the whole residual load: K w* = R*
  rigid,    ///< d* is a rigid-body motion at constant load: R* does not change
  none,     ///< nothing holds the structure
};

/// The number of successive answers with SMIN = 0, for `nc` pairs, that the corrected kernel decides. In
/// later answers, the policy toggles the pair with the least index.
[[nodiscard]] constexpr int quick_answers_at_rest(std::size_t nc) {
  return 20 + 4 * static_cast<int>(nc);
}

/// The decisions on one path under the 1989 rule: the path follows the kernel, except at events within
/// rounding of full load. The loop in path.cpp calls these functions in this order.
class path_policy {
 public:
  /// Both arguments must outlive this object.
  path_policy(path_state& now, kernel& leader) : now_(now), leader_(leader) {}
  virtual ~path_policy() = default;
  path_policy(const path_policy&) = delete;
  path_policy& operator=(const path_policy&) = delete;

  virtual void begin_step() {}

  /// Writes d* [pairs] to the state, and returns the kind of the response. Throws no_factor.
  virtual response respond();

  /// Calls the kernel, which toggles statuses. Overrides the kernel's answer if the decision needs more than
  /// one call. Returns s_min, or nothing for a mechanism: a rigid-body motion that meets no face.
  virtual std::optional<double> decide();

  /// False if the events of this increment leave a mechanism.
  [[nodiscard]] virtual bool goes_on() const { return now_.held(); }

  /// Writes the displacements under the load applied so far to `u` [dofs]. Returns false if the structure
  /// cannot be held for a solve. Throws no_factor.
  virtual bool displace(std::span<double> u);

  /// The reciprocal condition of the equilibrated stiffness in the current state.
  [[nodiscard]] virtual double reciprocal_condition() { return now_.engine.reciprocal_condition(); }

 protected:
  /// True if the share of the step's load that remains after s_min is at most the error of an event's load:
  /// 1e-9, or eps / rcond up to 1e-6. Unloading to zero separates the last pairs exactly at full load, but
  /// rounding can make the computed event too early.
  [[nodiscard]] bool reaches_full_load(double s_min) const;

  /// Undoes the kernel's toggles and returns s = 1, so that all of R* is applied. The listing also ignores an
  /// event exactly at s = 1.
  double leave_undone() {
    now_.status = now_.sprung;
    now_.find_events();
    return 1.0;
  }

  path_state& now_;
  kernel& leader_;
};

/// Makes the policy that fits the rule of `leader`. Both arguments must outlive the policy.
[[nodiscard]] std::unique_ptr<path_policy> make_policy(path_state& now, kernel& leader);

}  // namespace contct
