// A problem as the files that say it, so that what a program drew can be run again.
#pragma once

#include <string>

#include "contct/model/problem.hpp"

namespace contct::referee {

/// The text of a problem file, and of the matrix beside it.
struct problem_text {
  std::string toml;
  std::string matrix;  ///< of the file "K.mtx"; empty for beams and plates
};

/// Every number as the shortest decimal that reads as its double, which `contct exact` takes for what is
/// meant. Pairs of a bed are written one by one.
[[nodiscard]] problem_text text_of(const problem& p);

}  // namespace contct::referee
