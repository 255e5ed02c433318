// The atlas for programs: CSV and JSON.
#pragma once

#include <string>

#include "contct/lab/atlas.hpp"

namespace contct {

/// A line a cell, and one of names before them.
[[nodiscard]] std::string atlas_csv(const atlas& a);

/// Format "contct-atlas-1": what was asked for, and the same numbers.
[[nodiscard]] std::string atlas_json(const atlas& a);

}  // namespace contct
