// What a run's page has to draw from, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "contct/write/finished_run.hpp"

namespace contct {

/// Everything the page shows, thinned where the problem is large; numbers with all their digits.
[[nodiscard]] nlohmann::ordered_json page_data(const finished_run& r);

}  // namespace contct
