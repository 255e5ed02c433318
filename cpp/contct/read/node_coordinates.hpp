// Where nodes stand: a text file, a node a line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contct/structure/placed_nodes.hpp"

namespace contct {

/// "name x y" or "name x y z" a line, all lines alike, each name once; what is behind a field that begins
/// with # is a comment. Without z it is 0. Throws input_error.
[[nodiscard]] std::vector<placed_node> parse_coordinates(std::string_view text, std::string_view file);

/// The same from a file.
[[nodiscard]] std::vector<placed_node> read_coordinates(const std::string& path);

/// No file of coordinates or of a mesh may be larger, in MiB: a million nodes take some 50.
inline constexpr std::size_t largest_mesh_file = 256;

}  // namespace contct
