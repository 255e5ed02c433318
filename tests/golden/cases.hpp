// The golden set: calls with every outcome of every IF of the listing, and at every limit of its numbers.
#pragma once

#include <string>
#include <vector>

#include "contct/kernel/call.hpp"

namespace golden {

struct golden_call {
  std::string note;
  contct::call_inputs<double> in;
};

/// A trace of the golden set, written to reference/traces/NAME.trace.
struct golden_trace {
  std::string name;
  int real_bytes;
  std::vector<std::string> about;
  std::vector<golden_call> calls;
};

/// Returns the traces of calls in both precisions. tests/golden/paths.sh records the traces of whole paths,
/// whose inputs come from solves.
std::vector<golden_trace> all_traces();

/// Returns the text of a trace with the answers of the 1989 code in this build.
std::string recorded(const golden_trace& t);

}  // namespace golden
