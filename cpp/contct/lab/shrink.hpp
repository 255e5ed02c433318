// Makes a mismatch small: fewer calls, fewer pairs, fewer nodes, rounder numbers.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contct/compare/compare.hpp"
#include "contct/kernel/call_inputs.hpp"
#include "contct/kernel/kernel.hpp"

namespace contct::lab {

/// Calls in order; the answers to the last one differ. More than one where a kernel keeps something from call
/// to call.
using call_sequence = std::vector<call_inputs<double>>;

/// Does the last call of a sequence still differ, in the same way, when the whole is put to fresh kernels?
using still_differs = std::function<bool(const call_sequence&)>;

/// Make `calls` smaller while it still differs: first fewer calls, then fewer pairs, then nodes numbered
/// from 1 with one dof each, then rounder numbers. The result differs, too, whenever `calls` does.
/// `most_tries` bounds the work.
[[nodiscard]] call_sequence shrink(call_sequence calls, const still_differs& differs, int most_tries = 4000);

/// A mismatch with the calls that show it.
struct found_case {
  mismatch_report what;  ///< of the last call
  int real_bytes = 8;
  call_sequence calls;
  std::vector<call_outputs> leader;  ///< the leader's answers [calls]
};

/// Put `calls` to the leader and to a fresh follower. The mismatch in the last call, when there is one
/// in that `field` ("" takes any), with the leader's answers.
[[nodiscard]] std::optional<found_case> reproduce(kernel& leader, const std::string& follower,
                                                  const call_sequence& calls, const std::string& field);

/// `calls` shrunk while they differ in the same field. Nothing when they do not differ at all.
[[nodiscard]] std::optional<found_case> shrunk_case(kernel& leader, const std::string& follower,
                                                    const call_sequence& calls, const std::string& field,
                                                    int most_tries = 4000);

}  // namespace contct::lab
