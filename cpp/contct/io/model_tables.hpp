// The structure itself in a problem file: [beam] or [plate].
#pragma once

#include "contct/io/toml_reader.hpp"
#include "contct/structure/model.hpp"

namespace contct {

/// Read the one table of the document `top` that describes a structure; refuses a document with none
/// of them, or with several.
[[nodiscard]] model read_model(const table_reader& top);

}  // namespace contct
