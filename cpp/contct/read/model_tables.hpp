// The structure itself in a problem file: [beam], [plate], [matrix] or [calculix].
#pragma once

#include <string>

#include "contct/read/toml_reader.hpp"
#include "contct/structure/problem.hpp"

namespace contct::read {

/// Read the one table of the document `top` that describes a structure; refuses a document with none
/// of them, or with several. Other files that it names are in `folder`.
[[nodiscard]] model read_model(const table_reader& top, const std::string& folder,
                               literals keep = literals::dropped);

/// A file that a problem file names: relative to the folder of the latter.
[[nodiscard]] std::string beside(const std::string& folder, const std::string& name);

}  // namespace contct::read
