// What a fuzz run, or a shard of one, came to.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "contct/lab/call_campaign.hpp"

namespace contct {

/// The rungs of equality, highest first.
enum class equality_level {
  bits,         ///< every answer equal to the bit, text included
  ulps,         ///< the same events, numbers within a few ULP
  events,       ///< the same pairs toggled in every call
  certificate,  ///< other events, but its own paths certified wherever the leader's are
  none,
};
[[nodiscard]] std::string_view name_of(equality_level r);

/// Which calls and problems: numbers I, I + N, ... of shard I/N.
struct fuzz_request {
  std::vector<std::string> kernels = {"fortran", "cpp"};  ///< the first leads
  std::int64_t calls = 200'000;
  std::int64_t problems = 400;
  std::uint64_t seed = 1989;
  int shard = 1, shards = 1;
};

/// One follower's result.
struct fuzz_follower {
  std::string name;
  tally compared;
  equality_level highest = equality_level::bits;
  std::uint64_t most_ulps = 0;
  std::vector<std::string> mismatch_reports;  ///< the first divergence, in lines
};

struct fuzz_result {
  fuzz_request request;
  std::int64_t calls = 0;  ///< of the hunt on calls, and of all paths
  std::int64_t problems = 0;
  branch_counts branches;
  event_counts events;
  std::vector<fuzz_follower> followers;
  double seconds = 0.0;
  std::vector<int> merged_shards;  ///< of a merged result

  [[nodiscard]] tally compared() const;
};

/// What a run must have compared before its silence means anything: empty when it has, else what is missing.
/// Below 1000 calls only that anything was compared.
[[nodiscard]] std::string floors_missed(const fuzz_result& r);

}  // namespace contct
