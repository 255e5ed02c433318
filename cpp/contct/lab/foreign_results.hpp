// Judges another program's results of the reference problems by the exact numbers.
#pragma once

#include <string>
#include <vector>

#include "contct/lab/verify.hpp"

namespace contct {

struct foreign_number {
  expected_number expected;
  double given = 0.0;  ///< the other program's number; a state as in expected_number::value
  double error = 0.0;  ///< see judge_results
  bool passed = false;
};

struct foreign_case {
  std::string name;  ///< the problem file's name without its ending
  std::vector<foreign_number> numbers = {};
  std::vector<std::string> not_given = {};  ///< "step 1, w, node 2"
  std::vector<std::string> failures = {};   ///< lines
  double largest_error = 0.0;
};

/// A judged file of the format "contct-answers-1", which reference/benchmarks.md describes.
struct foreign_results {
  std::string program, version;
  double tolerance = 0.0;
  std::vector<foreign_case> cases = {};
  std::vector<std::string> not_given = {};  ///< names of problems without results
  std::size_t judged = 0, failed = 0;       ///< counts of numbers
};

/// Reads and judges the file at `path`. Counts and states must be equal; other errors must be within the
/// file's tolerance. The error of a share of a step is absolute. Any other error is relative to the largest
/// exact number of its kind in the table's problem. Refuses duplicates, and entries that the table lacks.
/// Throws input_error.
[[nodiscard]] foreign_results judge_results(const std::string& path,
                                            const std::vector<verification_case>& table);

}  // namespace contct
