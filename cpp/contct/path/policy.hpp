// The decisions on a path that the paper's loop leaves open.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "contct/kernel/kernel.hpp"
#include "contct/path/path_state.hpp"

namespace contct {

/// How the structure responds to the residual load.
enum class response {
  elastic,  ///< K w* = R*: the whole residual load would move it by d*
  rigid,    ///< a rigid-body motion at constant load: R* stays
  none,     ///< nothing holds it
};

/// For how many answers in a row with SMIN = 0 the corrected kernel's choice among `nc` pairs is taken,
/// before the pair of least index toggles.
[[nodiscard]] constexpr int quick_answers_at_rest(std::size_t nc) {
  return 20 + 4 * static_cast<int>(nc);
}

/// The decisions of one path: the 1989 driver's, which solves, and takes the kernel's word, except for events
/// within rounding of full load. The loop calls these verbs in this order.
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
  virtual response respond();

  /// Make the call of the kernel, which toggles statuses, and override its answer where several calls must be
  /// considered. Returns s_min; nothing if a rigid-body motion meets no face: a mechanism.
  virtual std::optional<double> decide();

  /// May the path go on after the events of this increment, or do they leave a mechanism?
  [[nodiscard]] virtual bool goes_on() const { return now_.held(); }

  /// Write u [dofs] under the load applied so far. False if the structure cannot be held for a solve.
  /// Throws no_factor.
  virtual bool displace(std::span<double> u);

  /// Reciprocal condition of the stiffness that holds the structure now; equilibrated.
  [[nodiscard]] virtual double reciprocal_condition() { return now_.engine.reciprocal_condition(); }

 protected:
  /// Is the rest of the step's load after s_min at most the error of an event's load: 1e-9 of it, or eps /
  /// rcond up to 1e-6? Unloading to zero separates the last pairs exactly at full load; by rounding, the
  /// computed event may come too early.
  [[nodiscard]] bool reaches_full_load(double s_min) const;

  /// Undo the kernel's toggles and apply all of R*: as the listing does with an event exactly at s = 1.
  /// Returns this s.
  double leave_undone() {
    now_.status = now_.sprung;
    now_.find_events();
    return 1.0;
  }

  path_state& now_;
  kernel& leader_;
};

/// The 1989 driver's policy for a leader whose rule is the listing's, otherwise that of the corrected rule.
/// Both must outlive it.
[[nodiscard]] std::unique_ptr<path_policy> make_policy(path_state& now, kernel& leader);

}  // namespace contct
