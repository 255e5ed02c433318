// A fuzz run as JSON, format "contct-fuzz-1", the results of shards added up, and a found case as files.
#pragma once

#include <string>
#include <vector>

#include "contct/lab/fuzz.hpp"
#include "contct/trace/trace.hpp"

namespace contct::lab {

[[nodiscard]] std::string fuzz_json(fuzz_result r);

/// Read the results of all shards of one run and add them up. Throws input_error when one is no such file,
/// when they are not of one run, or when a shard is missing or given twice.
[[nodiscard]] fuzz_result merged_fuzz(const std::vector<std::string>& files);

/// The calls of a case with the leader's answers, as a trace. `h` says whose they are.
[[nodiscard]] std::string trace_of(const found_case& c, trace_header h);

/// A TEST_CASE that asks the follower and expects the leader's answer.
[[nodiscard]] std::string catch_test_of(const found_case& c);

/// A main program in fixed-form FORTRAN 77 that calls CONTCT and prints what it gives; the expected
/// values stand in its comments. Whoever has a FORTRAN compiler can run it.
[[nodiscard]] std::string fortran_main_of(const found_case& c);

}  // namespace contct::lab
