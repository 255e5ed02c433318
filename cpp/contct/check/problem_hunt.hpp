// The hunt on whole problems: random structures followed by the leader, all kernels in lockstep.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "contct/conform/branches.hpp"
#include "contct/conform/finding.hpp"
#include "contct/conform/hunt.hpp"
#include "contct/conform/shrink.hpp"

namespace contct {

/// What came of one problem for one follower.
struct followed_problem {
  tally compared;
  nearness near;
  std::optional<finding> first;  ///< the first divergence
  call_sequence calls_up_to_it;
};

/// What came of one problem.
struct hunted_problem {
  std::int64_t calls = 0;
  branch_counts branches;
  event_counts events;
  std::vector<followed_problem> each;  ///< [followers]
};

/// Follow problem `number` of `seed` with `leader`, and put every call to `followers`.
[[nodiscard]] hunted_problem hunt_problem(std::uint64_t seed, std::uint64_t number, const std::string& leader,
                                          const std::vector<std::string>& followers);

/// Does the follower's own path of that problem end as well as the leader's: certified, or truly without
/// equilibrium? True where the leader's does not.
[[nodiscard]] bool certified_as_leader(std::uint64_t seed, std::uint64_t number, const std::string& leader,
                                       const std::string& follower);

}  // namespace contct
