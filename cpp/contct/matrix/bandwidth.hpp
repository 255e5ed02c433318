// The order of rows that makes a matrix a narrow band.
#pragma once

#include <vector>

#include "contct/matrix/sparse_matrix.hpp"

namespace contct::matrix {

/// Reverse Cuthill and McKee, by Boost.Graph: the row of each dof, from 0; empty where the order that `a` has
/// is as good. Linear in the entries, but for sorting neighbours by their degree.
[[nodiscard]] std::vector<int> rows_for_small_band(const sparse_matrix& a);

}  // namespace contct::matrix
