// What pairs of every kind have in common.
#pragma once

#include <string_view>

#include "contct/read/toml_reader.hpp"
#include "contct/structure/problem.hpp"

namespace contct::read {

/// surface, face and state of a pair or a bed. `default_surface` is 0 where the surface must be named.
[[nodiscard]] contact_pair read_face(const table_reader& t, int default_surface);

/// Append the pair of the table [[contact]] at `node`, from 0. `fixed_dof` names its dof where a support
/// fixes it, for a warning; otherwise it is empty.
void read_pair(const table_reader& t, int node, std::string_view fixed_dof, problem& p);

}  // namespace contct::read
