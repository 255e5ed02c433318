// The hunt on whole problems: random structures followed by the leader, all kernels in lockstep.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contct/compare/branches.hpp"
#include "contct/compare/mismatch_report.hpp"
#include "contct/lab/call_campaign.hpp"
#include "contct/lab/shrink.hpp"

namespace contct {

/// What came of one problem for one follower.
struct followed_problem {
  tally compared;
  nearness near;
  std::optional<mismatch_report> first;  ///< the first divergence
  call_sequence calls_up_to_it;
};

/// What came of one problem.
struct problem_in_lockstep {
  std::int64_t calls = 0;
  branch_counts branches;
  event_counts events;
  std::vector<followed_problem> each;  ///< [followers]
};

/// Follow problem `number` of `seed` with `leader`, and put every call to `followers`.
[[nodiscard]] problem_in_lockstep follow_in_lockstep(std::uint64_t seed, std::uint64_t number,
                                                     const std::string& leader,
                                                     const std::vector<std::string>& followers);

/// Does the follower's own path of that problem end as well as the leader's: certified, or truly without
/// equilibrium? True where the leader's does not.
[[nodiscard]] bool certified_as_leader(std::uint64_t seed, std::uint64_t number, const std::string& leader,
                                       const std::string& follower);

}  // namespace contct
