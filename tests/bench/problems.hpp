// The benchmark's problems, by formula, so that anyone can rebuild them.
#pragma once

#include <string>
#include <vector>

#include "contct/model/problem.hpp"

namespace bench {

/// "rail-50", "mat-100", "grid-50": the family and its size. Throws std::invalid_argument for others.
[[nodiscard]] contct::problem make_problem(const std::string& name);

/// The problems of the benchmark, smallest first.
[[nodiscard]] std::vector<std::string> usual_problems();

}  // namespace bench
