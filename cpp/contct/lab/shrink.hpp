// A divergence made small: fewer calls, fewer pairs, fewer nodes, rounder numbers.
#pragma once

#include <functional>
#include <vector>

#include "contct/kernel/call_inputs.hpp"

namespace contct {

/// Calls in order, the last of which diverges. More than one where a kernel keeps something from call to
/// call.
using call_sequence = std::vector<call_inputs<double>>;

/// Does the last call of a sequence still diverge, in the same way, when the whole is put to fresh kernels?
using still_diverges = std::function<bool(const call_sequence&)>;

/// Make `calls` smaller while it still diverges: first fewer calls, then fewer pairs, then nodes numbered
/// from 1 with one dof each, then rounder numbers. The result diverges, too, whenever `calls` does.
/// `most_tries` bounds the work.
[[nodiscard]] call_sequence shrink(call_sequence calls, const still_diverges& diverges,
                                   int most_tries = 4000);

}  // namespace contct
