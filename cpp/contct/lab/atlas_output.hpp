// The atlas as CSV, as JSON, as a table for the terminal and as a picture.
#pragma once

#include <string>

#include "contct/lab/atlas.hpp"
#include "contct/text/terminal.hpp"

namespace contct::lab {

/// A line a cell, and one of names before them.
[[nodiscard]] std::string atlas_csv(const atlas& a);

/// Format "contct-atlas-1": what was asked for, and the same numbers.
[[nodiscard]] std::string atlas_json(const atlas& a);

/// All cells as a table of 80 columns, and what its columns mean.
[[nodiscard]] std::string atlas_table(const atlas& a, const terminal& t);

/// Share of wrong answers with its 95 % band, by the unit of length and by EPSMUL: above for structures
/// held by supports, below for free ones. One self-contained SVG; every cell is a point with its numbers.
[[nodiscard]] std::string atlas_svg(const atlas& a);

}  // namespace contct::lab
