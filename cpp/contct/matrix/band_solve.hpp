// Solves with a band Cholesky factor that LAPACK's dpbtrs does not offer: right-hand sides that begin with
// zeros, and a block of them in one pass over the factor.
#pragma once

#include <span>

#include "contct/matrix/band_matrix.hpp"

namespace contct::matrix {

/// Solve L L^T x = b in place, for b that is 0 before row `first` (from 0), with L in `factor_of_a` as dpbtrf
/// leaves it. The time goes into reading the factor; the unit vector of a row needs half of it on average in
/// the forward substitution.
void solve_from(const band_matrix& factor_of_a, std::size_t first, std::span<double> b);

/// The same for a block of right-hand sides, b[row * block_width + i]: see several_right_hand_sides.hpp.
void solve_block_from(const band_matrix& factor_of_a, std::size_t first, std::span<double> b);

}  // namespace contct::matrix
