// Judges another program's results of the reference problems by the exact numbers.
#pragma once

#include <string>
#include <vector>

#include "contct/lab/verify.hpp"

namespace contct {

struct foreign_number {
  expected_number expected;
  double given = 0.0;  ///< the other program's number; for a state -1 in contact, +1 separated
  double error = 0.0;  ///< see judge_results
  bool passed = false;
};

struct foreign_case {
  std::string name;  ///< the problem file's name without its ending
  std::vector<foreign_number> numbers = {};
  std::vector<std::string> not_given = {};  ///< numbers without a result: "step 1, w, node 2"
  std::vector<std::string> failures = {};   ///< a line for each number that did not pass
  double largest_error = 0.0;
};

/// A judged file of the format "contct-answers-1", which reference/benchmarks.md describes.
struct foreign_results {
  std::string program, version;
  double tolerance = 0.0;
  std::vector<foreign_case> cases = {};
  std::vector<std::string> not_given = {};  ///< names of problems without results
  std::size_t judged = 0, failed = 0;       ///< numbers that were judged; numbers that did not pass
};

/// Reads and judges the file at `path`. Counts and states must be equal to the exact numbers; all other
/// numbers may have errors up to the file's tolerance. The error of a share of a step is absolute. Any other
/// error is relative to the largest exact number of its kind in the table's problem. Throws input_error if
/// the file is malformed, gives a number twice, or gives a number that the table lacks.
[[nodiscard]] foreign_results judge_results(const std::string& path,
                                            const std::vector<verification_case>& table);

}  // namespace contct
