// The golden set: calls that reach every outcome of every IF of the listing, and every edge of its numbers.
#pragma once

#include <string>
#include <vector>

#include "contct/kernel/call.hpp"

namespace golden {

/// A call and its purpose.
struct golden_call {
  std::string note;
  contct::call_inputs<double> in;
};

/// A trace of the golden set: reference/traces/<name>.trace.
struct golden_trace {
  std::string name;
  int real_bytes;
  std::vector<std::string> about;
  std::vector<golden_call> calls;
};

/// All of them, in both precisions. The traces of whole paths are not among these: their inputs come from
/// solves, and reference/traces/paths.sh recorded them.
std::vector<golden_trace> all_traces();

/// What such a trace looks like, answered by the 1989 code of this build.
std::string recorded(const golden_trace& t);

}  // namespace golden
