// PETSc's binary file of a sparse matrix, as MatView writes it and MatLoad reads it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/rooms.hpp"

namespace contct::read {

/// The first four bytes: 1211216, which stands for a matrix, most significant byte first as all that follows.
inline constexpr std::uint32_t petsc_matrix_id = 1211216;

/// Is this such a file? Its name does not matter. True for PETSc's 64-bit integers too, so that
/// parse_petsc_matrix can refuse them by name.
[[nodiscard]] bool is_petsc_matrix(std::string_view bytes);

/// The file has 32-bit integers, 4 for the header (petsc_matrix_id, rows, columns, entries), then the number
/// of entries in each row, then the column of each entry, from 0; then the entries' values, 64-bit doubles.
/// Both triangles are there, and equal to the bit; a place that is not named is 0. Columns may come in any
/// order. Every row has an entry on its diagonal. The values are taken as they are: no last digits are in
/// doubt. The answer has the lower triangle by columns, without entries that are 0. Linear in the bytes, but
/// for a search in each column; nothing is allocated before the file has as many bytes as its header
/// declares. Throws input_error; bytes count from 0 in messages, rows and columns from 1.
[[nodiscard]] matrix::sparse_matrix parse_petsc_matrix(std::string_view bytes, std::string_view file);

/// A stiffness matrix in a file of either kind, told apart by the first four bytes: as parse_petsc_matrix,
/// without warnings, or as parse_symmetric. Any other file that begins with a zero byte is
/// refused by these bytes: PETSc's vectors do.
[[nodiscard]] matrix::sparse_matrix parse_stiffness(std::string_view bytes, std::string_view file,
                                                    std::vector<std::string>* warnings = nullptr);

}  // namespace contct::read
