// Puts recorded calls to a kernel, and compares its answers with the recorded ones.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "contct/compare/compare.hpp"
#include "contct/trace/trace.hpp"

namespace contct::compare {

/// The result of a replay.
struct replay_report {
  std::int64_t calls = 0;
  tally compared;
  branch_counts branches;
  std::optional<mismatch_report> first;  ///< the first difference
};

/// Can a kernel with these facts be compared with the trace? Not with another precision or rule.
[[nodiscard]] bool comparable(const trace_header& h, const kernel_facts& k);

/// Put every call that `calls` still has to `k`, in order, and compare to the bit; the text too, where
/// both have it, by what it means where one of them is f2c. `progress` gets the number of calls done, after
/// each. Throws input_error where the trace is malformed.
[[nodiscard]] replay_report replay(const trace_header& h, trace_reader& calls, kernel& k,
                                   const std::function<void(std::int64_t)>& progress = nullptr);

}  // namespace contct::compare
