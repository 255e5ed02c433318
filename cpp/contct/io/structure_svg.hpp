// One state of a structure, drawn.
#pragma once

#include "contct/io/finished_run.hpp"
#include "contct/io/svg_parts.hpp"
#include "contct/io/thinning.hpp"

namespace contct::svg {

/// A beam from the side; deflections and faces magnified alike, as the heading says.
[[nodiscard]] drawn draw_beam(const problem& p, const beam& b, const frame& f, const shown_parts& shown);

/// A plate from above: a colour for each rectangle between the lines that are drawn.
[[nodiscard]] drawn draw_plate(const problem& p, const plate& of, const frame& f, const shown_parts& shown);

}  // namespace contct::svg
