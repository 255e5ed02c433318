// A problem in rational numbers, with its paths under the corrected and the 1989 rule.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "contct/exact/lifted_solver.hpp"
#include "contct/kernel/call.hpp"
#include "contct/number/rational.hpp"
#include "contct/path/path.hpp"
#include "contct/structure/equations.hpp"

namespace contct {

/// The largest number of dofs of an exact problem. The length of its numbers grows with the number of dofs.
inline constexpr int most_exact_dofs = 50'000;

using exact_pair = pair_in<rational>;

using exact_step = loads_in<rational>;

struct exact_problem : equations<rational> {
  std::vector<int> place;  ///< row of each dof in a narrow band [dofs]
  std::vector<exact_step> steps;
  /// M, the diagonal stiffness of an elastic ground, positive on all rigid-body motions that the supports
  /// leave; see follow_corrected_path. M acts on w at the ends and hinges of beams and at the corners of
  /// plates, and on all dofs of a matrix.
  std::vector<added_spring> ground;

  /// The most bits of a numerator or denominator on the path; beyond, too_long is thrown.
  std::size_t longest = lifted_solver::most_bits;
};

/// Converts a problem exactly. Every number is the shortest decimal of its double. Coordinates of equal
/// parts, the stiffness (modulus times tributary length or area) and faces of a bed, and the D of a plate
/// from E, nu and thickness are computed exactly.
[[nodiscard]] exact_problem exact_problem_of(const problem& p);

[[nodiscard]] int subdiagonals(const exact_problem& p);

/// The events at one share of a step.
struct exact_increment {
  rational fraction;
  std::vector<event> events;  ///< in order of pairs; empty at the end of a step
  bool snaps = false;         ///< a rigid-body motion to the next face follows, at constant load
};

/// The final state of a step, or of the path.
struct exact_step_end {
  std::vector<exact_increment> increments;
  rational fraction;             ///< share of the step's load that was reached
  rational_vector displacement;  ///< [dofs]
  std::vector<int> isep;         ///< the status of each pair [pairs]
  rational_vector gap, force;    ///< see gap_of and force_of [pairs]
  rational_vector reactions;     ///< forces of the supports on the structure [supports]
  path_status status = path_status::solved;
};

/// The proof that the full load of a step has no equilibrium: a motion that K and the pairs in contact do not
/// resist, that no other pair stops, and on which the load does work.
struct mechanism_proof {
  rational_vector motion;  ///< its largest number is 1 or -1 [dofs]
  rational work;           ///< work of the step's full load on the motion; positive
};

struct exact_path {
  /// After a step that is not solved, the path continues only if the next step starts from zero.
  std::vector<exact_step_end> steps;
  std::optional<mechanism_proof> mechanism;  ///< of the first mechanism; corrected path only

  /// The status of the first step that is not solved.
  [[nodiscard]] path_status status() const {
    const auto is_solved = [](const exact_step_end& s) { return s.status == path_status::solved; };
    const auto failed = std::ranges::find_if_not(steps, is_solved);
    return failed == steps.end() ? path_status::solved : failed->status;
  }
};

/// Called before every increment, with the step and the increment, from 1, and the share of the step reached.
using exact_progress = std::function<void(int step, int increment, const rational& fraction)>;

/// Follows the equilibria u(t) under the loads, event by event (reference/corrected-rule.md). Events exactly
/// at the full load of a step belong to the next step. If equilibria are not unique, the path is the limit of
/// the equilibria on an elastic ground of stiffness epsilon M as epsilon tends to 0. Throws too_long, and
/// std::runtime_error if K is indefinite or the status of a pair cannot be decided.
[[nodiscard]] exact_path follow_corrected_path(const exact_problem& p, const exact_progress& tell = {});

/// Follows the 1989 path: the statements of the listing in exact arithmetic, with its constants as printed,
/// in the 1989 driver, where springs add up their forces increment by increment. Throws too_long, and
/// std::runtime_error if K is indefinite.
[[nodiscard]] exact_path follow_1989_path(const exact_problem& p, const exact_progress& tell = {});

struct listing_pair {
  rational c;       ///< position of its face
  rational d;       ///< D at the pair
  rational d_star;  ///< d* at the pair
  int isep;         ///< its status
  int surface;      ///< face_above or face_below
};

struct listing_answer {
  rational_vector s;         ///< SS [pairs]
  rational s_min = 1;        ///< SMIN
  std::vector<int> toggled;  ///< pairs from 0, in ascending order
};

/// One call of CONTCT without rounding, with EPSGAP, DELTA and EPSMUL as printed.
[[nodiscard]] listing_answer answer_exactly(std::span<const listing_pair> pairs);

}  // namespace contct
