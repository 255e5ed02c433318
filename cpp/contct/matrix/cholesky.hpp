// LAPACK's band Cholesky: dpbtrf, dpbtrs, and the condition estimate of dpbcon.
#pragma once

#include <functional>
#include <span>
#include <string>

#include "contct/matrix/band_matrix.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

namespace contct::matrix {

/// Replace `matrix` by its Cholesky factor L, A = L L^T (dpbtrf, lower). Returns false when a
/// pivot is not positive. Rounding can give the matrix of a mechanism a factor, too.
[[nodiscard]] bool factor(band_matrix& matrix);

/// Solve A x = b in place, with the factor of A (dpbtrs).
void solve_with(const band_matrix& factor_of_a, std::span<double> b);

/// Reciprocal condition number, in the 1-norm, of `matrix` scaled to a unit diagonal: 1 / (norm
/// of A times norm of its inverse), estimated as dpbcon does, in linear time. The scaling makes
/// it independent of units.
/// Overwrites `matrix`. 0 when the scaled matrix has no factor.
[[nodiscard]] double reciprocal_condition(band_matrix& matrix);

/// Solves A x = b in place.
using in_place_solver = std::function<void(std::span<double>)>;

/// The same of `k` with `diagonal` [rows] in place of its own; `solve` solves with that matrix, unscaled.
[[nodiscard]] double reciprocal_condition(const stiffness_matrix& k, std::span<const double> diagonal,
                                          const in_place_solver& solve);

/// Whole decimal digits that a solution keeps at this reciprocal condition: -log10(eps / rcond),
/// never negative, at most 15.
[[nodiscard]] int digits_left(double rcond);

}  // namespace contct::matrix
