// A found case as a trace, as a Catch2 test case, and as a FORTRAN main program.
#pragma once

#include <string>

#include "contct/lab/shrink.hpp"
#include "contct/trace/trace.hpp"

namespace contct::lab {

/// The calls with the leader's answers. `h` says whose they are.
[[nodiscard]] std::string trace_of(const found_case& c, trace_header h);

/// A TEST_CASE that asks the follower and expects the leader's answer.
[[nodiscard]] std::string catch_test_of(const found_case& c);

/// A main program in fixed-form FORTRAN 77 that calls CONTCT and prints what it gives; the expected
/// values stand in its comments. Whoever has a FORTRAN compiler can run it.
[[nodiscard]] std::string fortran_main_of(const found_case& c);

}  // namespace contct::lab
