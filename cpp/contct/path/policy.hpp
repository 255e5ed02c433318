// What has to be decided on a path besides the paper's loop.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "contct/kernel/kernel.hpp"
#include "contct/path/path_state.hpp"

namespace contct::path {

/// How the structure responds to the residual load.
enum class response {
  elastic,  ///< K w* = R*: the whole residual load would move it by d*
  rigid,    ///< a rigid-body motion at constant load: R* stays
  none,     ///< nothing holds it
};

/// The decisions of one path. A policy reads and changes the path's state; the loop calls these verbs in this
/// order. The defaults are the 1989 driver's.
class path_policy {
 public:
  /// Both must outlive this object.
  path_policy(path_state& now, kernel& leader) : now_(now), leader_(leader) {}
  virtual ~path_policy() = default;
  path_policy(const path_policy&) = delete;
  path_policy& operator=(const path_policy&) = delete;

  /// A load step begins.
  virtual void begin_step() {}

  /// Write d* [pairs] to the state. Throws no_factor.
  virtual response respond() = 0;

  /// Put the call to the kernel, which toggles statuses; returns s_min.
  virtual double ask() { return now_.ask(leader_, now_.d_star, 0); }

  /// Replace the kernel's s_min, and its toggles, where the driver knows better. False when a rigid motion
  /// meets no face: a mechanism.
  virtual bool accept(double& s_min) = 0;

  /// May the path go on after the events of this increment, or do they leave a mechanism?
  [[nodiscard]] virtual bool goes_on() const = 0;

  /// The step's load is applied; `number` increments were made.
  virtual void end_step(int /*number*/) {}

  /// u [dofs] under the load applied so far. Throws no_factor.
  virtual void displace(std::span<double> u) = 0;

  /// Reciprocal condition of the stiffness that holds the structure now; equilibrated.
  [[nodiscard]] virtual double reciprocal_condition() { return now_.engine.reciprocal_condition(); }

  /// Can the structure be solved for as it stands?
  [[nodiscard]] virtual bool can_be_held() { return now_.held(); }

  /// The same pairs toggle for ever, or nothing stops the structure, and rounding alone may be the reason: go
  /// on from a state a little further along the load, as an increment of this number. False when there is no
  /// such means, or no such state.
  virtual bool go_on_ahead(int /*number*/) { return false; }

  /// Is there an equilibrium at the end of the step? Nothing where that is not certain.
  [[nodiscard]] virtual std::optional<bool> can_stand() const { return std::nullopt; }

  /// The path cannot reach the end of the step: follow what is left of it without rounding, and tell the
  /// observers. Nothing when there is no such means.
  virtual std::optional<path_end> follow_exactly() { return std::nullopt; }

  /// The path cannot reach the end of `step`: put the state at its equilibrium by other means, and tell the
  /// observers. False when there is no such means, or no equilibrium.
  virtual bool fall_back(int /*step*/) { return false; }

 protected:
  /// Is what would be left of the step's load after s_min no more than the error of an event's load: 1e-9 of
  /// it, or eps / rcond up to 1e-6? Unloading to nothing opens the last pairs exactly at full load; computed,
  /// that may come a rounding too early.
  [[nodiscard]] bool reaches_full_load(double s_min) const {
    constexpr double never_less = 1e-9;
    constexpr double never_more = 1e-6;
    const double share_left = now_.residual.share * (1.0 - s_min);
    if (share_left > never_more) return false;
    if (share_left <= never_less) return true;
    return share_left <= std::numeric_limits<double>::epsilon() / now_.engine.reciprocal_condition();
  }

  /// Undo the kernel's toggles and apply all of R*: as the listing does with an event exactly at s = 1.
  void leave_undone(double& s_min) {
    now_.take_back_toggles();
    s_min = 1.0;
  }

  path_state& now_;
  kernel& leader_;
};

/// The 1989 driver's policy for a leader whose rule is the listing's, or else the stabilized one, which the
/// corrected rule takes, with the means that `limits` has. All must outlive it.
[[nodiscard]] std::unique_ptr<path_policy> make_policy(path_state& now, kernel& leader,
                                                       cycle_detector& cycles, const path_limits& limits);

}  // namespace contct::path
