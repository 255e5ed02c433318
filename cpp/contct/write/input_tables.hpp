// The tables of what was given to a run.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct::write {

/// Structure, supports, pairs, beds, loads and settlements as the problem has them, in the form of
/// page_table.
[[nodiscard]] nlohmann::ordered_json input_tables(const problem& p, std::vector<std::string>& omissions);

}  // namespace contct::write
