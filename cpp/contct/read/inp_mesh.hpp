// The mesh in an input file of CalculiX: for pictures.
#pragma once

#include <string_view>

#include "contct/structure/placed_nodes.hpp"

namespace contct::read {

/// *NODE and *ELEMENT of types C3D4, C3D6, C3D8, C3D10, C3D15 and C3D20, with letters behind them (C3D8I):
/// nodes by their numbers, and the elements' edges, which go through midside nodes. Keywords and types in any
/// case. Elements of other types have no edges, *INCLUDE is not followed, and all else is ignored; `said`
/// says what is left out. Throws input_error. Linear in the text, but for sorting the edges.
[[nodiscard]] placed_nodes parse_inp_mesh(std::string_view text, std::string_view file);

}  // namespace contct::read
