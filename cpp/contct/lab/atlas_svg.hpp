// The atlas as a picture.
#pragma once

#include <string>

#include "contct/lab/atlas.hpp"

namespace contct::lab {

/// Share of wrong answers with its 95 % band, by the unit of length and by EPSMUL: above for structures
/// held by supports, below for free ones. One self-contained SVG; every cell is a point with its numbers.
[[nodiscard]] std::string atlas_svg(const atlas& a);

}  // namespace contct::lab
