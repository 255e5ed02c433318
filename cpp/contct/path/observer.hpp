// What one may see of a path while it is followed.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

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
  /// D at each pair [pairs], where the path went on ahead to a state that no call led to; empty otherwise.
  std::span<const double> ahead = {};
};

/// Numbers of the end of a step that are more accurate than what its displacements, rounded to doubles, give.
struct end_numbers {
  std::vector<double> pair_forces;     ///< as force_of has them [pairs]
  std::vector<double> reactions;       ///< as reactions(p, ..) has them [supports]
  std::vector<double> element_values;  ///< as element_results has them
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
  bool from_exact_path =
      false;  ///< doubles could not follow the path: from some share on it is the exact one
  const end_numbers* numbers = nullptr;  ///< null: there are none
};

/// Watches a path. The path does not depend on what an observer does.
class observer {
 public:
  virtual ~observer() = default;
  virtual void called(const answered_call& /*c*/) {}
  virtual void incremented(const increment& /*i*/) {}
  virtual void step_ended(const step_state& /*s*/) {}
};

/// Betters the displacements [dofs] and statuses [pairs] of the end of a step, from 1, which reached its
/// load. Nothing: they are as they were.
using state_refiner =
    std::function<std::optional<end_numbers>(int step, std::span<double> displacement, std::span<int> isep)>;

/// Tell the end of a step; where it reached its load, as `refine` betters it.
void tell_end(step_state end, const state_refiner& refine, std::span<observer* const> observers);

}  // namespace contct::path
