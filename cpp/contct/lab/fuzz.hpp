// A whole fuzz run: the hunt on calls, the hunt on problems, rungs, and divergences shrunk.
#pragma once

#include <functional>
#include <vector>

#include "contct/lab/case_files.hpp"
#include "contct/lab/fuzz_result.hpp"

namespace contct {

/// What a run hands back besides its figures.
struct fuzz_run {
  fuzz_result result;
  std::vector<found_case> cases;  ///< one for each follower that diverged, shrunk
};

/// Progress: work done out of all, in calls or problems.
using fuzz_progress = std::function<void(std::int64_t done, std::int64_t all, const char* what)>;

/// Put the calls and problems of `r` to its kernels. Throws std::invalid_argument for kernels that do not go
/// together.
[[nodiscard]] fuzz_run run_fuzz(const fuzz_request& r, const fuzz_progress& progress = nullptr);

}  // namespace contct
