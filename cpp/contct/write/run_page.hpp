// A run as one HTML page that needs nothing else.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "contct/write/finished_run.hpp"

namespace contct::write {

/// The page of a run. The parallel edition of the two kernels is in it, folded.
[[nodiscard]] std::string run_page(const finished_run& r);

/// Everything the page shows, of a large problem the parts that choose_parts finds; numbers with all their
/// digits.
[[nodiscard]] nlohmann::ordered_json page_data(const finished_run& r);

}  // namespace contct::write
