// The residual, solutions corrected by it, and vectors by dofs, by rows and by pairs.
#pragma once

#include <span>
#include <vector>

#include "contct/matrix/cholesky.hpp"
#include "contct/structure/structure.hpp"

namespace contct::solve {

/// The springs of the pairs that are `closed` [pairs], by rows; none where the dof is fixed.
[[nodiscard]] std::vector<spring_at> springs_of(const linear_structure& s, std::span<const char> closed);

/// A load by dofs in the order of the rows of K; 0 at fixed dofs.
[[nodiscard]] std::vector<double> in_rows(const linear_structure& s, std::span<const double> load);

/// Displacements [dofs] where the pairs act, to `at_pairs` [pairs].
void gather_at_pairs(const linear_structure& s, std::span<const double> u, std::span<double> at_pairs);

/// A load [dofs] with the pairs' forces [pairs] added where they act.
[[nodiscard]] std::vector<double> with_pair_forces(const linear_structure& s, std::span<const double> load,
                                                   std::span<const double> pair_forces);

/// b - (K + springs) x, all by rows. Every product and sum in long double.
[[nodiscard]] std::vector<double> residual(const stiffness_matrix& k, std::span<const spring_at> springs,
                                           std::span<const double> b, std::span<const double> x);

/// Solve (K + springs) u = load, all by dofs, and correct u by solving with its residual until that no longer
/// helps. `k`: K of `s`, however it is stored. `solve`: with a factor of K + springs, by rows.
void solve_refined(const linear_structure& s, const stiffness_matrix& k, std::span<const spring_at> springs,
                   const in_place_solver& solve, std::span<const double> load, std::span<double> u);

}  // namespace contct::solve
