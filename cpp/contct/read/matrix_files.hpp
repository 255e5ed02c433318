// Files that hold a stiffness matrix or a load vector, in the formats of Matrix Market and CalculiX; files
// with the labels of its dofs; and, for pictures, files with their positions.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "contct/model/problem.hpp"

namespace contct {

/// No such file may be larger, in MiB.
inline constexpr std::size_t largest_matrix_file = 16384;

/// "%%MatrixMarket matrix coordinate real symmetric": the lower triangle, from 1, each place once. The words
/// of the header in any case; comments after it, and blank lines. Linear in the text, except for sorting; the
/// declared entry count is not used to allocate memory. The matrix has no entries that are 0. Throws
/// input_error for anything else, a negative diagonal, and a row that has entries but no diagonal.
/// `warnings`: one is appended if numbers are not the shortest decimals of their doubles.
[[nodiscard]] sparse_matrix parse_symmetric(std::string_view text, std::string_view file,
                                            std::vector<std::string>* warnings = nullptr);

/// JOB.sti of *FREQUENCY, SOLVER=MATRIXSTORAGE: "row column value" a line, from 1, the upper triangle, each
/// place once, zeros included; D may stand for E. The number of rows is not in it, but in JOB.dof. Throws
/// input_error likewise.
[[nodiscard]] sparse_matrix parse_calculix_stiffness(std::string_view text, std::string_view file, int rows,
                                                     std::vector<std::string>* warnings = nullptr);

/// "%%MatrixMarket matrix array real general" with one column of `rows` numbers, or "coordinate" with those
/// that are not 0. Throws input_error. `warnings` likewise.
[[nodiscard]] std::vector<double> parse_vector(std::string_view text, std::string_view file, int rows,
                                               std::vector<std::string>* warnings = nullptr);

/// One label a line, in the matrix's order: any text without blanks, each once. Throws input_error.
[[nodiscard]] std::vector<std::string> parse_labels(std::string_view text, std::string_view file);

/// "name x y" or "name x y z" a line, all lines alike, each name once; a field that begins with # and what
/// follows it are a comment. Without z it is 0. Throws input_error.
[[nodiscard]] std::vector<placed_node> parse_coordinates(std::string_view text, std::string_view file);

/// Places by a file of coordinates (see parse_coordinates): each dof's node is found by its label,
/// "NAME.DIRECTION", and nodes that the matrix couples have an edge if these are few, as in frames. No nodes
/// if no label has one; `notes` name the parts that are not drawn. Throws input_error.
[[nodiscard]] placed_nodes places_by_coordinates(std::string_view text, std::string_view file,
                                                 const assembled& a);

/// The same by *NODE and *ELEMENT in an input file of CalculiX: nodes by their numbers, with the edges of the
/// types C3D4, C3D6, C3D8, C3D10, C3D15 and C3D20, with letters behind them (C3D8I), which go through midside
/// nodes; nodes without dof and edge are left out. Keywords and types in any case. Elements of other types
/// have no edges, *INCLUDE is not followed, and all else is ignored. Linear in the text, but for sorting.
[[nodiscard]] placed_nodes places_by_mesh(std::string_view text, std::string_view file, const assembled& a);

}  // namespace contct
