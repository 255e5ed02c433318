// The run as a table on the terminal, an increment a row.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "contct/session/run_result.hpp"
#include "contct/session/step_results.hpp"
#include "contct/text/terminal.hpp"

namespace contct {

/// A share in at most nine columns, with as many digits as fit. What is less than 1 is never shown as 1,
/// which means the whole load: "1-3e-09".
[[nodiscard]] std::string share_words(double x);

/// Prints the run at the terminal.
struct run_table {
  std::string text;                 ///< lines
  std::vector<std::string> legend;  ///< what its columns and words mean, to stand below it
};
/// `detail`: every event, and all numbers of each step's end.
[[nodiscard]] run_table table_of(const run_result& r, const terminal& t, bool detail);

/// More combinations than this have a row each, instead of one for each increment.
inline constexpr std::size_t most_combinations_in_full = 12;
/// Rows of combinations, below a head.
[[nodiscard]] std::string combination_rows(const run_result& r, const terminal& t);
/// The least and largest of all, a line each, with the names of combinations.
[[nodiscard]] std::string envelope_text(const problem& p, const envelope& e);

/// Of each quantity, by its place among the ranges: the number of a step, and its range.
using extremes_of_steps = std::map<std::size_t, std::vector<std::pair<int, value_range>>>;
/// A table for each quantity, a step a row.
[[nodiscard]] std::string extremes_text(const problem& p, const terminal& t,
                                        const extremes_of_steps& extremes);

/// The quantity whose extremes stand for the bending of the structure; null where nothing bends.
[[nodiscard]] const value_range* bending(const std::vector<value_range>& ranges);

}  // namespace contct
