// A run as one HTML page that needs nothing else.
#pragma once

#include <string>

#include "contct/write/finished_run.hpp"

namespace contct {

/// The page of a run. The parallel edition of the two kernels is in it, folded.
[[nodiscard]] std::string run_page(const finished_run& r);

}  // namespace contct
