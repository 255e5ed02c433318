// How far a sparse factor is from what it was made of.
#pragma once

#include <span>

#include "contct/matrix/stiffness_matrix.hpp"

namespace contct::certify {

/// An upper bound on the largest row sum of |A - L L'|, so on the norm of A - L L'; A symmetric, L lower
/// triangular, both by columns in the same order. Rounding of the sums is in the bound.
[[nodiscard]] double largest_row_of_error_in(const matrix::sparse_columns& a,
                                             const matrix::sparse_columns& l);

/// A with row i at `places[i]`.
[[nodiscard]] matrix::sparse_columns reordered(const matrix::sparse_columns& a, std::span<const int> places);

}  // namespace contct::certify
