// Where the dofs of a matrix are: for pictures.
#pragma once

#include <string_view>

#include "contct/model/problem.hpp"

namespace contct {

/// Places by a file of coordinates (see parse_coordinates): each dof's node is found by its label,
/// "NAME.DIRECTION", and nodes that the matrix couples have an edge where these are few, as in frames. No
/// nodes where no label has one; `said` says what is not drawn. Throws input_error.
[[nodiscard]] placed_nodes places_by_coordinates(std::string_view text, std::string_view file,
                                                 const assembled& a);

/// The same by *NODE and *ELEMENT in an input file of CalculiX: nodes by their numbers, with the edges of the
/// types C3D4, C3D6, C3D8, C3D10, C3D15 and C3D20, with letters behind them (C3D8I), which go through midside
/// nodes; nodes without dof and edge are left out. Keywords and types in any case. Elements of other types
/// have no edges, *INCLUDE is not followed, and all else is ignored. Linear in the text, but for sorting.
[[nodiscard]] placed_nodes places_by_mesh(std::string_view text, std::string_view file, const assembled& a);

}  // namespace contct
