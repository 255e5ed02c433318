// The numbers that another program has for the reference problems, judged by the exact ones.
#pragma once

#include <string>
#include <vector>

#include "contct/lab/verify.hpp"

namespace contct {

/// A number of another program, with the exact one.
struct foreign_number {
  expected_number expected;
  double given = 0.0;  ///< of a state as in `expected`
  double error = 0.0;  ///< see judge_results
  bool passed = false;
};

struct foreign_case {
  std::string name;  ///< the problem file's, without its ending
  std::vector<foreign_number> numbers = {};
  std::vector<expected_number> not_given = {};
  std::size_t failed = 0;
  double largest_error = 0.0;
};

/// A file of format "contct-answers-1": reference/benchmarks.md.
struct foreign_results {
  std::string program, version;
  double tolerance = 0.0;
  std::vector<foreign_case> cases = {};
  std::vector<std::string> not_given = {};  ///< names of problems
  std::size_t judged = 0, failed = 0;       ///< numbers
};

/// Read and judge the file at `path`. Counts and states must be equal, and shares of a step lie within the
/// file's tolerance; the error of any other number is relative to the largest exact one of its kind that the
/// table has for the problem. Entries that the table does not have are refused, and so are duplicates. Throws
/// input_error.
[[nodiscard]] foreign_results judge_results(const std::string& path,
                                            const std::vector<verification_case>& table);

}  // namespace contct
