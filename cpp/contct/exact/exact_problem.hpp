// A problem in rational numbers.
#pragma once

#include <vector>

#include "contct/exact/lifted_solver.hpp"
#include "contct/model/equations.hpp"
#include "contct/number/rational.hpp"

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

}  // namespace contct
