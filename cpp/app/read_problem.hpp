// A problem read and made ready, with a word to whoever waits for it.
#pragma once

#include <string>

#include "app/waiting.hpp"
#include "contct/io/follow.hpp"
#include "contct/io/problem_file.hpp"

namespace contct {

[[nodiscard]] inline problem read_as_one_waits(const std::string& file, bool quiet) {
  const waiting here(file == "-" ? "reading the problem" : "reading " + file, quiet);
  return read_problem(file);
}

[[nodiscard]] inline linear_structure build_as_one_waits(const problem& p, bool quiet) {
  const waiting here("building the structure", quiet);
  return structure_of(p);
}

}  // namespace contct
