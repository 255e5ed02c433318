// What one may see of a path while it is followed.
#pragma once

#include <span>
#include <string_view>

#include "contct/kernel/call.hpp"

namespace contct::path {

/// One call of the leading kernel.
struct answered_call {
  const call<double>& c;             ///< inputs and outputs; c.isep is already toggled
  std::span<const int> isep_before;  ///< ISEP as it went in [pairs]
  std::string_view text;             ///< the leader's unit-26 text of this call
};

/// One increment of a step.
struct increment {
  int step;                       ///< from 1
  int number;                     ///< within the step, from 1
  double s;                       ///< s_min
  double fraction;                ///< share of the step's load consumed by now
  std::span<const event> events;  ///< in order of pairs
  bool snaps = false;             ///< a rigid motion to the next face, at constant load
};

/// Where a step ended, or where the path stopped.
struct step_state {
  int step;                              ///< from 1
  double fraction;                       ///< share of the step's load consumed
  std::span<const double> displacement;  ///< D at every dof [dofs]
  std::span<const int> isep;             ///< status of each pair [pairs]
  double rcond;                          ///< of the equilibrated stiffness; 0 when it has no factor
  bool from_fallback = false;            ///< the path could not reach it
  bool from_reference = false;  ///< it is the reference solution's own: a fallback's, or a final state's
};

/// Watches a path. The path does not depend on what an observer does.
class observer {
 public:
  virtual ~observer() = default;
  virtual void called(const answered_call& /*c*/) {}
  virtual void incremented(const increment& /*i*/) {}
  virtual void step_ended(const step_state& /*s*/) {}
};

}  // namespace contct::path
