// What pairs of every kind have in common.
#pragma once

#include "contct/read/toml_reader.hpp"
#include "contct/structure/structure.hpp"

namespace contct {

/// surface, face and state of a pair or a bed. `default_surface` is 0 where the surface must be named.
[[nodiscard]] contact_pair read_face(const table_reader& t, int default_surface);

}  // namespace contct
