// A divergence for others to look at: as a trace, as a Catch2 test case, as a FORTRAN main program.
#pragma once

#include <string>
#include <vector>

#include "contct/compare/mismatch_report.hpp"
#include "contct/lab/shrink.hpp"
#include "contct/trace/trace.hpp"

namespace contct {

/// A shrunk divergence: the calls, and what the leader and the follower answered to each of them.
struct found_case {
  mismatch_report what;  ///< of the last call
  int real_bytes = 8;
  call_sequence calls;
  std::vector<call_outputs> leader;
};

/// The calls with the leader's answers. `h` says whose they are.
[[nodiscard]] std::string trace_of(const found_case& c, trace_header h);

/// A TEST_CASE that asks the follower and expects the leader's answer.
[[nodiscard]] std::string catch_test_of(const found_case& c);

/// A main program in fixed-form FORTRAN 77 that calls CONTCT and prints what it gives; the expected
/// values stand in its comments. Whoever has a FORTRAN compiler can run it.
[[nodiscard]] std::string fortran_main_of(const found_case& c);

}  // namespace contct
