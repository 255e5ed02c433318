// A run as one HTML page that needs nothing else.
#pragma once

#include <string>
#include <string_view>

#include "contct/io/finished_run.hpp"

namespace contct {

/// The page of a run. `edition` is an HTML fragment that goes into the place which the template leaves for
/// it (report/report.html): its author answers for its markup; nothing is shown where it is empty.
[[nodiscard]] std::string run_page(const finished_run& r, std::string_view edition = {});

}  // namespace contct
