// Parses files of Matrix Market and CalculiX with a stiffness matrix or a load vector, files with labels of
// dofs, and, for pictures, files with positions of dofs.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct {

/// The largest size of a file with a matrix, a vector or labels, in MiB.
inline constexpr std::size_t largest_matrix_file = 16384;

/// Parses "%%MatrixMarket matrix coordinate real symmetric": the lower triangle, rows and columns from 1,
/// each entry at most once. The header may be in any case; comments may follow it; blank lines are skipped.
/// Omits entries that are 0. Linear in the text, except for sorting; the declared number of entries is not
/// used to allocate memory. Throws input_error for any other text, for a negative diagonal entry, and for a
/// row with entries but without a diagonal entry. Appends one warning to `warnings` if numbers are not the
/// shortest decimals of their doubles.
[[nodiscard]] sparse_matrix parse_symmetric(std::string_view text, std::string_view file,
                                            std::vector<std::string>* warnings = nullptr);

/// Parses JOB.sti of *FREQUENCY, SOLVER=MATRIXSTORAGE: a line "row column value" for each entry of the upper
/// triangle, rows and columns from 1, zeros included; D may replace E. `rows` comes from JOB.dof, because
/// JOB.sti does not contain it. Throws input_error and warns as parse_symmetric does.
[[nodiscard]] sparse_matrix parse_calculix_stiffness(std::string_view text, std::string_view file, int rows,
                                                     std::vector<std::string>* warnings = nullptr);

/// Parses "%%MatrixMarket matrix array real general" with one column of `rows` numbers; or the same with
/// "coordinate" and the entries that are not 0. Throws input_error. `warnings`: as for parse_symmetric.
[[nodiscard]] std::vector<double> parse_vector(std::string_view text, std::string_view file, int rows,
                                               std::vector<std::string>* warnings = nullptr);

/// Parses labels of dofs, one a line, in the order of the rows of the matrix. Throws input_error for a label
/// that contains blanks or occurs twice.
[[nodiscard]] std::vector<std::string> parse_labels(std::string_view text, std::string_view file);

/// Parses a node a line, "name x y" in all lines or "name x y z" in all lines; a missing z is 0. A field that
/// begins with # starts a comment. Throws input_error for any other text and for a repeated name.
[[nodiscard]] std::vector<placed_node> parse_coordinates(std::string_view text, std::string_view file);

/// Finds positions of dofs in a file of coordinates (see parse_coordinates). The label of a dof,
/// "NAME.DIRECTION", names its node. Two nodes that the matrix couples have an edge, unless there are more
/// than 3 edges for each node. The result has no nodes if no label names a node; its `notes` list the parts
/// that are not drawn. Throws input_error.
[[nodiscard]] placed_nodes places_by_coordinates(std::string_view text, std::string_view file,
                                                 const assembled& a);

/// As places_by_coordinates, but for *NODE and *ELEMENT in an input file of CalculiX, where nodes have
/// numbers. Elements of the types C3D4, C3D6, C3D8, C3D10, C3D15 and C3D20, also with letters after the
/// number (C3D8I), have edges, which go through midside nodes. Elements of other types have none. Nodes with
/// neither a dof nor an edge are omitted. Keywords and types may be in any case; *INCLUDE is not followed;
/// all other text is ignored. Linear in the text, except for sorting.
[[nodiscard]] placed_nodes places_by_mesh(std::string_view text, std::string_view file, const assembled& a);

}  // namespace contct
