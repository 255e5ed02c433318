// The tables of a run's page: what was given, and what it came to at the ends of steps.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "contct/write/step_results.hpp"

namespace contct::write {

/// At most so many rows in a table; steps in all tables, and beside each other in one.
inline constexpr std::size_t most_rows = 40, most_table_steps = 24, steps_beside = 6;

/// Structure, supports, pairs, beds, loads and settlements as the problem has them. A table is
/// { "title", "head", "rows" }; a cell is a number, a text, null, or a list of [number, where it is]. What a
/// table leaves out is said in its title and added to `omissions`.
[[nodiscard]] nlohmann::ordered_json input_tables(const problem& p, std::vector<std::string>& omissions);

/// Of every step's end, in tables of the same form: the largest values with their places; the pairs' forces;
/// the reactions.
[[nodiscard]] nlohmann::ordered_json result_tables(const finished_run& r, const std::vector<int>& deflecting,
                                                   std::vector<std::string>& omissions);

/// The least and the largest of everything on the path, in tables of the same form.
[[nodiscard]] nlohmann::ordered_json envelope_tables(const finished_run& r,
                                                     std::vector<std::string>& omissions);

}  // namespace contct::write
