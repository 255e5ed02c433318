// Matrix Market files: a stiffness matrix, and load vectors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contct/matrix/sparse_matrix.hpp"

namespace contct {

/// "%%MatrixMarket matrix coordinate real symmetric": the lower triangle, from 1, each place once. The words
/// of the header in any case; comments behind it, and blank lines. Throws input_error: nothing is
/// half-accepted. Linear in the text; what the file claims to hold is not believed before it is there.
[[nodiscard]] sparse_matrix parse_symmetric(std::string_view text, std::string_view file);

/// "%%MatrixMarket matrix array real general" with one column of `rows` numbers, or "coordinate" with those
/// that are not 0. Throws input_error.
[[nodiscard]] std::vector<double> parse_vector(std::string_view text, std::string_view file, int rows);

/// The same from files.
[[nodiscard]] sparse_matrix read_symmetric(const std::string& path);
[[nodiscard]] std::vector<double> read_vector(const std::string& path, int rows);

/// No file of ours may be larger, in MiB.
inline constexpr std::size_t largest_matrix_file = 16384;

}  // namespace contct
