// One state of a structure, drawn.
#pragma once

#include "contct/write/finished_run.hpp"
#include "contct/write/page_sampling.hpp"
#include "contct/write/svg_parts.hpp"

namespace contct::svg {

/// A beam from the side; deflections and faces magnified alike, as the heading says.
[[nodiscard]] drawn draw_beam(const problem& p, const beam& b, const frame& f, const shown_parts& shown);

/// A plate from above: a colour for each rectangle between the lines that are drawn.
[[nodiscard]] drawn draw_plate(const problem& p, const plate& of, const frame& f, const shown_parts& shown);

/// A structure from elsewhere in the view that shows most: its edges as they were, faint, and displaced, with
/// pairs and supports at their nodes.
[[nodiscard]] drawn draw_mesh(const problem& p, const placed_nodes& places, const frame& f,
                              const shown_parts& shown);

/// A structure whose places are not known: its pairs as a table, the dof that moves most first.
[[nodiscard]] drawn draw_table(const problem& p, const frame& f, const shown_parts& shown);

}  // namespace contct::svg
