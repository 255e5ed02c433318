// The path of a problem in exact arithmetic: the true one, and the one that the 1989 rule takes.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "contct/exact/exact_problem.hpp"
#include "contct/kernel/call.hpp"
#include "contct/path/path.hpp"

namespace contct {

/// What happened at one share of a step's load.
struct exact_increment {
  rational fraction;
  std::vector<event> events;  ///< in order of pairs; none at the end of a step
  bool snaps = false;         ///< a rigid motion to the next face, at constant load, came after them
};

/// Where a step ended, or where the path stopped.
struct exact_step_end {
  std::vector<exact_increment> increments;
  rational fraction;             ///< of the step's load
  rational_vector displacement;  ///< [dofs]
  std::vector<char> closed;      ///< [pairs]
  rational_vector gap, force;    ///< as gap_of and force_of say [pairs]
  rational_vector reactions;     ///< forces on the structure by the supports, in their order
};

/// Why there is no equilibrium under the full load of a step: K and the pairs in contact leave this motion
/// free, no other pair stands in its way, and the load does work on it.
struct mechanism_proof {
  rational_vector motion;  ///< its largest number 1 or -1 [dofs]
  rational work;           ///< of the step's full load, positive
};

struct exact_path {
  path_status status = path_status::solved;
  std::vector<exact_step_end> steps;         ///< the last one may have stopped before its full load
  std::optional<mechanism_proof> mechanism;  ///< of the true path
};

/// Told before every increment: the step and the increment, from 1, and the share reached.
using exact_progress = std::function<void(int step, int increment, const rational& fraction)>;

/// The curve of equilibria u(t) under the loads, event by event (reference/corrected-rule.md). Events exactly
/// at the full load of a step are left to the next one. Where equilibria are not unique, the path is the
/// limit of those on a ground that gets ever softer. Throws too_long.
[[nodiscard]] exact_path follow_corrected_path(const exact_problem& p, const exact_progress& tell = {});

/// What the listing's statements decide, with its constants as the decimals that are printed, in the 1989
/// driver: springs gather their forces increment by increment. Throws too_long.
[[nodiscard]] exact_path follow_1989_path(const exact_problem& p, const exact_progress& tell = {});

}  // namespace contct
