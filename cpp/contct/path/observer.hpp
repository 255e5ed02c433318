// The interface for observers of a path.
#pragma once

#include <span>
#include <vector>

#include "contct/kernel/call.hpp"

namespace contct {

struct increment {
  int step;                       ///< from 1
  int number;                     ///< within the step, from 1
  double s;                       ///< s_min
  double fraction;                ///< share of the step's load applied so far
  std::span<const event> events;  ///< sorted by pair
  bool snaps = false;             ///< the increment is a rigid-body motion to the next face, at constant load
  std::span<const double> d = {};  ///< D at each pair after the increment [pairs]
  std::span<const int> isep = {};  ///< ISEP after the events [pairs]
  /// Under the 1989 rule, the force of each spring on the structure, summed over increments; otherwise 0
  /// [pairs].
  std::span<const double> pair_force = {};
};

/// Results at the end of a step, more accurate than results computed from the rounded displacements.
struct end_numbers {
  std::vector<double> pair_forces;     ///< see force_of [pairs]
  std::vector<double> reactions;       ///< see reactions in solve_problem.hpp [supports]
  std::vector<double> element_values;  ///< see element_results
};

/// The final state of a step, or of the path.
struct step_state {
  int step;                              ///< from 1
  double fraction;                       ///< share of the step's load applied
  std::span<const double> displacement;  ///< D at every dof [dofs]
  std::span<const int> isep;             ///< status of each pair [pairs]
  double rcond;                  ///< reciprocal condition of the equilibrated stiffness; 0 without a factor
  bool from_fallback = false;    ///< the state replaces the path's state, which is missing or not proved
  bool from_reference = false;   ///< the state is that of the reference solution
  bool from_exact_path = false;  ///< the state is that of the exact path
  const end_numbers* numbers = nullptr;  ///< null if the state was not refined
};

/// Observes a path without changing it.
class observer {
 public:
  virtual ~observer() = default;
  virtual void called(const answered_call& /*c*/) {}  // after a call of the leading kernel
  virtual void incremented(const increment& /*i*/) {}
  virtual void step_ended(const step_state& /*s*/) {}
};

}  // namespace contct
