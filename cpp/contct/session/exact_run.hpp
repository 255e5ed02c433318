// The exact path of a problem as it was read, with kernels beside it; refused where it would take more than a
// machine has.
#pragma once

#include <string>
#include <vector>

#include "contct/exact/kernel_digits.hpp"
#include "contct/exact/path.hpp"
#include "contct/model/problem.hpp"
#include "contct/path/observer.hpp"

namespace contct {

struct exact_request {
  std::string file = {};                  ///< the problem's, as it was named
  std::string rule = "corrected";         ///< or "1989"
  std::vector<std::string> kernels = {};  ///< compared with it, each in free run
};

/// All that is written of an exact path. The problem must outlive it.
struct exact_run {
  const problem& what;
  exact_problem exactly;
  exact_path path;
  std::vector<kernel_digits> kernels;  ///< as `wanted` names them
};

/// `tell` hears of the exact path's increments, and `shown` observes those of the kernels; both may be null.
/// Throws std::invalid_argument, naming the file, for a problem that is too large, for a matrix that is not
/// positive semidefinite, and where numbers become too long.
[[nodiscard]] exact_run run_exactly(const problem& p, const exact_request& wanted,
                                    const exact_progress& tell = nullptr, observer* shown = nullptr);

}  // namespace contct
