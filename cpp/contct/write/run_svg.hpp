// A run in one picture: the final state, and how load and deflection went.
#pragma once

#include <string>

#include "contct/write/finished_run.hpp"
#include "contct/write/svg_parts.hpp"

namespace contct::write {

/// One self-contained SVG. A beam is drawn from the side with its deflection magnified, a plate from above, a
/// structure from elsewhere in the view that shows most, or as a table where no places are known; under it
/// the sum of the loads over the deflection of the node that deflects most.
[[nodiscard]] std::string run_svg(const finished_run& r);

/// Pair `pair` (from 0) of a frame at a point, of size `r`, told in its tooltip: open is a ring, closed a
/// square, at its face a diamond.
[[nodiscard]] std::string mark_of_pair(const problem& p, const frame& f, int pair, const svg::spot& at,
                                       double r);

}  // namespace contct::write
