// A stiffness matrix as a file, for other programs and for contct itself: Matrix Market, and PETSc's binary.
#pragma once

#include <cstdint>
#include <limits>

#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/rooms.hpp"
#include "contct/text/output_file.hpp"

namespace contct::write {

/// "%%MatrixMarket matrix coordinate real symmetric": the lower triangle by columns, each number the shortest
/// decimal that reads as its double. Every row has its diagonal, 0 too; other zeros are left out. Returns how
/// many entries there are.
std::int64_t write_matrix_market(const sparse_matrix& a, output_file& out);

/// PETSc's binary (see read/petsc_matrix.hpp): all entries by rows, columns ascending; zeros as above. Throws
/// std::length_error where there are more than `most` entries, which its 32-bit integers cannot count;
/// nothing is written then. Returns how many there are.
std::int64_t write_petsc_matrix(const sparse_matrix& a, output_file& out,
                                std::int64_t most = std::numeric_limits<std::int32_t>::max() - 1);

}  // namespace contct::write
