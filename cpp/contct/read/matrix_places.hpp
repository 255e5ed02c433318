// The dofs of a matrix on nodes whose places are known.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contct/structure/assembled.hpp"

namespace contct::read {

/// The direction of a label's last part: x, y, z or 1, 2, 3 are 1 to 3, rx, ry, rz or 4, 5, 6 are 4 to 6, and
/// r, the turn of a plane structure, is 6; 0 for anything else.
[[nodiscard]] int direction_of(std::string_view name);

/// "name x y" or "name x y z" a line, all lines alike, each name once; a field that begins with # and what
/// follows it are a comment. Without z it is 0. Throws input_error.
[[nodiscard]] std::vector<placed_node> parse_coordinates(std::string_view text, std::string_view file);

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

/// Of `[matrix]`: the nodes of a file of coordinates. Of `[calculix]`: the mesh in an input file. No places
/// where no label has its node in them. Throw input_error.
[[nodiscard]] placed_nodes places_from_coordinates(const std::string& path, const assembled& a);
[[nodiscard]] placed_nodes places_from_inp(const std::string& path, const assembled& a);

}  // namespace contct::read
