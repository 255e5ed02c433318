// Follows the exact path of a problem, and compares the paths of kernels with the exact path.
#pragma once

#include <string>
#include <vector>

#include "contct/exact/path.hpp"
#include "contct/path/observer.hpp"
#include "contct/results/kernel_digits.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

struct exact_request {
  std::string file = {};                  ///< the path of the problem file as given
  std::string rule = "corrected";         ///< "corrected" or "1989"
  std::vector<std::string> kernels = {};  ///< kernels to compare with the exact path, each in a free run
};

/// The results of an exact path. The problem must outlive them.
struct exact_run {
  const problem& what;
  exact_problem exactly;
  exact_path path;
  std::vector<kernel_digits> kernels;  ///< in the order of exact_request::kernels
};

/// Follows the exact path of `p`, then that of each kernel. `tell` is called before every increment of the
/// exact path, `shown` observes the kernels; both may be null. Throws std::invalid_argument, naming the file,
/// if the problem is too large, a matrix is not positive semidefinite, or numbers become too long.
[[nodiscard]] exact_run run_exactly(const problem& p, const exact_request& wanted,
                                    const exact_progress& tell = nullptr, observer* shown = nullptr);

}  // namespace contct
