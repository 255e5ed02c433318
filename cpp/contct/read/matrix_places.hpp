// The dofs of a matrix on nodes whose places are known: for pictures.
#pragma once

#include <string>
#include <string_view>

#include "contct/structure/problem.hpp"

namespace contct::read {

/// The direction of a label's last part: x, y, z or 1, 2, 3 are 1 to 3, rx, ry, rz or 4, 5, 6 are 4 to 6, and
/// r, the turn of a plane structure, is 6; 0 for anything else.
[[nodiscard]] int direction_of(std::string_view name);

/// Find each dof's node by its label "NAME.DIRECTION"; of two labels for one place the second has none. Says
/// what is not drawn. False where no label has a node; `places` is then empty but for `said`.
[[nodiscard]] bool place_dofs(const assembled& a, placed_nodes& places);

/// Edges for a structure of which only the matrix is known: between nodes that it couples. None where there
/// are more than this many for each node, as in a solid or a plate, whose couplings are no members. A space
/// frame has 3 at most, a plane one 2.
inline constexpr std::size_t most_couplings_of_a_node = 3;
void add_coupling_edges(const assembled& a, placed_nodes& places);

/// Without the nodes that have neither a dof nor an edge.
void drop_idle_nodes(placed_nodes& places);

/// *NODE and *ELEMENT of types C3D4, C3D6, C3D8, C3D10, C3D15 and C3D20, with letters behind them (C3D8I):
/// nodes by their numbers, and the elements' edges, which go through midside nodes. Keywords and types in any
/// case. Elements of other types have no edges, *INCLUDE is not followed, and all else is ignored; `said`
/// says what is left out. Throws input_error. Linear in the text, but for sorting the edges.
[[nodiscard]] placed_nodes parse_inp_mesh(std::string_view text, std::string_view file);

/// Of `[matrix]`: the nodes of a file of coordinates. Of `[calculix]`: the mesh in an input file. No places
/// where no label has its node in them. Throw input_error.
[[nodiscard]] placed_nodes places_from_coordinates(const std::string& path, const assembled& a);
[[nodiscard]] placed_nodes places_from_inp(const std::string& path, const assembled& a);

}  // namespace contct::read
