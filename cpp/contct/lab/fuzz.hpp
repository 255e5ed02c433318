// A fuzz run: calls and whole problems put to kernels, how equal these are, and mismatches shrunk.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "contct/lab/call_campaign.hpp"
#include "contct/lab/shrink.hpp"

namespace contct::lab {

/// The levels of equality, highest first.
enum class equality_level {
  bits,         ///< every answer equal to the bit, text included
  ulps,         ///< the same events, numbers within a few ULP
  events,       ///< the same pairs toggled in every call
  certificate,  ///< other events, but its own paths certified wherever the leader's are
  none,
};
inline constexpr int equality_levels = 5;
[[nodiscard]] std::string_view name_of(equality_level l);

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
  std::vector<std::string> mismatch_reports;  ///< the first mismatch, in lines
};

/// What came of a run or of a shard of one. Its calls are those of the call campaign and of all paths.
struct fuzz_result : campaign_counts {
  fuzz_request request;
  std::int64_t problems = 0;
  std::vector<fuzz_follower> followers;
  double seconds = 0.0;
  std::vector<int> merged_shards;  ///< of a merged result

  [[nodiscard]] tally compared() const;
};

/// What a run must have compared before "no mismatch" means anything: empty when it has, else what is
/// missing. Below 1000 calls only that anything was compared.
[[nodiscard]] std::string floors_missed(const fuzz_result& r);

/// A result, and the cases that were found.
struct fuzz_run {
  fuzz_result result;
  std::vector<found_case> cases;  ///< one for each follower that differed, shrunk
};

/// Progress: work done out of all, in calls or problems.
using fuzz_progress = std::function<void(std::int64_t done, std::int64_t all, const char* what)>;

/// Put the calls and problems of `r` to its kernels. Throws std::invalid_argument for kernels that cannot be
/// compared.
[[nodiscard]] fuzz_run run_fuzz(const fuzz_request& r, const fuzz_progress& progress = nullptr);

}  // namespace contct::lab
