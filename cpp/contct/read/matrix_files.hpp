// Files that hold a stiffness matrix or a load vector: Matrix Market, and what CalculiX writes.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "contct/matrix/sparse_matrix.hpp"

namespace contct::read {

/// No such file may be larger, in MiB.
inline constexpr std::size_t largest_matrix_file = 16384;

/// "%%MatrixMarket matrix coordinate real symmetric": the lower triangle, from 1, each place once. The words
/// of the header in any case; comments behind it, and blank lines. Linear in the text; the declared entry
/// count is not used to allocate memory. The matrix has no entries that are 0. Throws input_error for
/// anything else, a negative diagonal, and a row that has entries but no diagonal.
[[nodiscard]] sparse_matrix parse_symmetric(std::string_view text, std::string_view file);

/// JOB.sti of *FREQUENCY, SOLVER=MATRIXSTORAGE: "row column value" a line, from 1, the upper triangle, each
/// place once, zeros included. The number of rows is not in it, but in JOB.dof. Throws input_error likewise.
[[nodiscard]] sparse_matrix parse_calculix_stiffness(std::string_view text, std::string_view file, int rows);

/// "%%MatrixMarket matrix array real general" with one column of `rows` numbers, or "coordinate" with those
/// that are not 0. Throws input_error.
[[nodiscard]] std::vector<double> parse_vector(std::string_view text, std::string_view file, int rows);

}  // namespace contct::read
