// The stiffness that CalculiX writes: *FREQUENCY, SOLVER=MATRIXSTORAGE.
#pragma once

#include <string>
#include <string_view>

#include "contct/matrix/sparse_matrix.hpp"

namespace contct {

/// JOB.sti: "row column value" a line, from 1, the upper triangle, each place once, zeros included; it does
/// not say how many rows it has, JOB.dof does. Throws input_error. Linear in the text.
[[nodiscard]] sparse_matrix parse_calculix_stiffness(std::string_view text, std::string_view file, int rows);

/// The same from a file.
[[nodiscard]] sparse_matrix read_calculix_stiffness(const std::string& path, int rows);

}  // namespace contct
