// A problem in rational numbers, its true path, and its path under the 1989 rule.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contct/exact/lifted_solver.hpp"
#include "contct/kernel/call.hpp"
#include "contct/model/equations.hpp"
#include "contct/number/rational.hpp"
#include "contct/path/path.hpp"

namespace contct {

/// More dofs than this would take more than a machine has: their numbers grow with them.
inline constexpr int most_exact_dofs = 50'000;

using exact_pair = pair_in<rational>;

using exact_step = loads_in<rational>;

struct exact_problem : equations<rational> {
  std::vector<int> place;  ///< of each dof in a narrow band
  std::vector<exact_step> steps;
  /// Weights of the squares of displacements by which rigid-body motions are measured, at dofs that hold all
  /// of them: those that the load does not drive keep what they have, and it drives others the steepest way.
  /// Of beams and plates w at the ends and hinges, or corners, as the corrected rule in doubles.
  std::vector<added_spring> ground;

  /// The longest that numbers of its path may become, in bits.
  std::size_t longest = lifted_solver::most_bits;
};

/// Every number is the shortest decimal of its double. Coordinates that the problem has as runs of equal
/// parts are exact parts. The stiffness of a bed's pair is its modulus times an exact share of the structure,
/// its face that of the exact polynomial, and a plate's D comes from E, nu and thickness exactly.
[[nodiscard]] exact_problem exact_problem_of(const problem& p);

/// Of its band.
[[nodiscard]] int subdiagonals(const exact_problem& p);

/// The events at one share of a step's load.
struct exact_increment {
  rational fraction;
  std::vector<event> events;  ///< in order of pairs; none at the end of a step
  bool snaps = false;         ///< a rigid-body motion to the next face, at constant load, came after them
};

/// The final state of a step, or of the path.
struct exact_step_end {
  std::vector<exact_increment> increments;
  rational fraction;             ///< of the step's load
  rational_vector displacement;  ///< [dofs]
  std::vector<char> closed;      ///< [pairs]
  rational_vector gap, force;    ///< as gap_of and force_of say [pairs]
  rational_vector reactions;     ///< forces on the structure by the supports, in their order
  path_status status = path_status::solved;
};

/// Why there is no equilibrium under the full load of a step: K and the pairs in contact leave this motion
/// free, no other pair stops it, and the load does work on it.
struct mechanism_proof {
  rational_vector motion;  ///< its largest number 1 or -1 [dofs]
  rational work;           ///< of the step's full load, positive
};

struct exact_path {
  path_status status = path_status::solved;  ///< of the first step that is not solved
  /// After a step that is not solved, only steps from zero and their continuations follow.
  std::vector<exact_step_end> steps;
  std::optional<mechanism_proof> mechanism;  ///< of the true path's first step that ends in one

  /// Takes in the end of one more step.
  void take(exact_step_end end) {
    if (status == path_status::solved) status = end.status;
    steps.push_back(std::move(end));
  }
};

/// Does the path continue with step `number`, from 0, after these?
[[nodiscard]] inline bool goes_on(const exact_path& path, const exact_problem& p, std::size_t number) {
  return number < p.steps.size() &&
         (path.steps.empty() || path.steps.back().status == path_status::solved || p.steps[number].from_zero);
}

/// Called before every increment: the step and the increment, from 1, and the share reached.
using exact_progress = std::function<void(int step, int increment, const rational& fraction)>;

/// The curve of equilibria u(t) under the loads, event by event (reference/corrected-rule.md). Events exactly
/// at the full load of a step are left to the next one. Where equilibria are not unique, the path is the
/// limit of those on a ground that gets ever softer. Throws too_long.
[[nodiscard]] exact_path follow_corrected_path(const exact_problem& p, const exact_progress& tell = {});

/// The path of the listing's statements in exact arithmetic, with its constants as the printed decimals, in
/// the 1989 driver: springs gather their forces increment by increment. Throws too_long.
[[nodiscard]] exact_path follow_1989_path(const exact_problem& p, const exact_progress& tell = {});

/// The inputs of CONTCT for a pair.
struct listing_pair {
  rational c;       ///< position of its face
  rational d;       ///< D there
  rational d_star;  ///< d* there
  bool closed;      ///< in contact
  int surface;      ///< face_above or face_below
};

/// The outputs of CONTCT.
struct listing_answer {
  rational_vector s;         ///< SS [pairs]
  rational s_min = 1;        ///< SMIN
  std::vector<int> toggled;  ///< pairs from 0, in their order
};

/// One call of CONTCT without rounding. EPSGAP, DELTA and EPSMUL are the decimals that are printed.
[[nodiscard]] listing_answer answer_exactly(std::span<const listing_pair> pairs);

}  // namespace contct
