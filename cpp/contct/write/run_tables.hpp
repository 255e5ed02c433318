// The tables of what a run came to.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "contct/write/step_results.hpp"

namespace contct::write {

/// At most so many steps in all tables, and beside each other in one.
inline constexpr std::size_t most_table_steps = 24, steps_beside = 6;

/// Of every step's end, in the form of page_table: the largest values with their places; the pairs' forces;
/// the reactions.
[[nodiscard]] nlohmann::ordered_json result_tables(const finished_run& r, const std::vector<int>& deflecting,
                                                   std::vector<std::string>& omissions);

/// The least and the largest of everything on the path, in the same form.
[[nodiscard]] nlohmann::ordered_json envelope_tables(const finished_run& r,
                                                     std::vector<std::string>& omissions);

}  // namespace contct::write
