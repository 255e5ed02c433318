// A divergence of a hunt, put to fresh kernels until it is small.
#pragma once

#include <optional>
#include <string>

#include "contct/kernel/kernel.hpp"
#include "contct/lab/case_files.hpp"

namespace contct {

/// Put `calls` to the leader and to a fresh follower. The finding in the last call, when there is one
/// of that `field` ("" takes any), with the leader's answers.
[[nodiscard]] std::optional<found_case> reproduce(kernel& leader, const std::string& follower,
                                                  const call_sequence& calls, const std::string& field);

/// `calls` shrunk while they diverge in the same field. Nothing when they do not diverge at all.
[[nodiscard]] std::optional<found_case> shrunk_case(kernel& leader, const std::string& follower,
                                                    const call_sequence& calls, const std::string& field,
                                                    int most_tries = 4000);

}  // namespace contct
