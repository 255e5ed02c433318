// The interface for observing a path while it is followed.
#pragma once

#include <span>
#include <vector>

#include "contct/kernel/call.hpp"

namespace contct {

/// One increment of a step.
struct increment {
  int step;                        ///< from 1
  int number;                      ///< within the step, from 1
  double s;                        ///< s_min
  double fraction;                 ///< share of the step's load consumed by now
  std::span<const event> events;   ///< in order of pairs
  bool snaps = false;              ///< a rigid-body motion to the next face, at constant load
  std::span<const double> d = {};  ///< D at each pair after it [pairs]
  std::span<const int> isep = {};  ///< ISEP after its events [pairs]
  /// The force on the structure that each spring has gathered under the 1989 rule; 0 under any other [pairs].
  std::span<const double> pair_force = {};
};

/// Numbers of the end of a step that are more accurate than what its displacements, rounded to doubles, give.
struct end_numbers {
  std::vector<double> pair_forces;     ///< as force_of has them [pairs]
  std::vector<double> reactions;       ///< as reactions(p, ..) has them [supports]
  std::vector<double> element_values;  ///< as element_results has them
};

/// The final state of a step, or of the path.
struct step_state {
  int step;                              ///< from 1
  double fraction;                       ///< share of the step's load consumed
  std::span<const double> displacement;  ///< D at every dof [dofs]
  std::span<const int> isep;             ///< status of each pair [pairs]
  double rcond;                          ///< of the equilibrated stiffness; 0 when it has no factor
  bool from_fallback = false;            ///< the path was lost, or its end not proved: it is one of these
  bool from_reference = false;           ///< the reference solution's own
  bool from_exact_path = false;          ///< the end of the exact path's step
  const end_numbers* numbers = nullptr;  ///< null: there are none
};

/// Watches a path. The path does not depend on what an observer does.
class observer {
 public:
  virtual ~observer() = default;
  virtual void called(const answered_call& /*c*/) {}  // of the leading kernel
  virtual void incremented(const increment& /*i*/) {}
  virtual void step_ended(const step_state& /*s*/) {}
};

}  // namespace contct
