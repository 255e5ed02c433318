// Solves with a band Cholesky factor that LAPACK's dpbtrs has no room for: right-hand sides that begin late,
// and eight of them in one pass over the factor.
#pragma once

#include <span>

#include "contct/matrix/band_matrix.hpp"
#include "contct/matrix/several_right_hand_sides.hpp"

namespace contct {

/// Solve L L^T x = b in place, for b that is 0 before row `first` (from 0), with L in `factor_of_a` as dpbtrf
/// leaves it. A solve is as fast as the factor comes from memory; a right-hand side of one unit vector
/// needs half of it less on the way down.
void solve_from(const band_matrix& factor_of_a, int first, std::span<double> b);

/// The same for `many` right-hand sides, b[row * many + i]: the factor is read once for all.
void solve_many_from(const band_matrix& factor_of_a, int first, std::span<double> b);

}  // namespace contct
