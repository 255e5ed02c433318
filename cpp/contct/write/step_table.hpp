// What a step ended with, on the terminal: the largest of each quantity, and every number on request.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "contct/text/terminal.hpp"
#include "contct/write/step_results.hpp"

namespace contct::write {

/// The largest of each quantity on a path so far, by name: what is nothing but rounding of it is printed as
/// 0.
using sizes_so_far = std::map<std::string, double, std::less<>>;

/// The largest deflection, moment, contact force and reaction with their places, a line each, of at most
/// `width` columns where that is 60 or more.
[[nodiscard]] std::vector<std::string> largest_lines(const problem& p, const step_results& r, int width,
                                                     sizes_so_far& sizes);

/// Tables of all pairs, reactions and ends of elements, 80 columns wide.
[[nodiscard]] std::string detail_tables(const problem& p, const step_state& s, const step_results& r);

}  // namespace contct::write
