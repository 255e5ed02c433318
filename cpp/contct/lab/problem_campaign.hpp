// Random structures whose paths a leader follows, with all kernels in lockstep.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contct/lab/call_campaign.hpp"

namespace contct::lab {

/// What came of one problem.
struct problem_in_lockstep : campaign_counts {
  std::vector<follower_result> each;  ///< [followers]
};

/// Follow problem `number` of `seed` with `leader`, and put every call to `followers`.
[[nodiscard]] problem_in_lockstep follow_in_lockstep(std::uint64_t seed, std::uint64_t number,
                                                     const std::string& leader,
                                                     const std::vector<std::string>& followers);

/// Does the follower's own path of that problem end as well as the leader's: certified, or truly without
/// equilibrium? True where the leader's does not.
[[nodiscard]] bool certified_as_leader(std::uint64_t seed, std::uint64_t number, const std::string& leader,
                                       const std::string& follower);

}  // namespace contct::lab
