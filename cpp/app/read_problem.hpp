// A problem read and made ready, with a word to whoever waits for it.
#pragma once

#include <string>

#include "app/activity_indicator.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"

namespace contct {

[[nodiscard]] inline problem read_as_one_waits(const std::string& file, bool quiet) {
  const activity_indicator here(file == "-" ? "reading the problem" : "reading " + file, quiet);
  return read_problem(file);
}

[[nodiscard]] inline linear_structure build_as_one_waits(const problem& p, bool quiet) {
  const activity_indicator here("building the structure", quiet);
  return structure_of(p);
}

}  // namespace contct
