// The atlas for people at a terminal.
#pragma once

#include <string>

#include "contct/lab/atlas.hpp"
#include "contct/text/terminal.hpp"

namespace contct {

/// All cells as a table of 80 columns, and what its columns mean.
[[nodiscard]] std::string atlas_table(const atlas& a, const terminal& t);

}  // namespace contct
