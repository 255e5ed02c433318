// A run in one picture: the final state, and how load and deflection went.
#pragma once

#include <string>

#include "contct/write/finished_run.hpp"

namespace contct {

/// One self-contained SVG. A beam is drawn from the side with its deflection magnified, a plate from above;
/// under it the sum of the loads over the deflection of the node that deflects most.
[[nodiscard]] std::string run_svg(const finished_run& r);

}  // namespace contct
