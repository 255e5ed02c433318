// Other programs on the benchmark's problems: a table.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bench::peers {

/// The problems of the table, and of a solid, which CalculiX makes, the number of bricks along its height.
[[nodiscard]] std::vector<std::string> usual_problems();

/// The programs, by the names that `run` takes; the first is ours.
[[nodiscard]] std::vector<std::string> names();

/// Run these programs on every problem, each in a process of its own, and print the table. Returns its rows.
/// Throws std::runtime_error where our own end is not certified.
[[nodiscard]] nlohmann::ordered_json run(const std::vector<std::string>& programs,
                                         const std::vector<std::string>& problems, int rounds);

}  // namespace bench::peers
