// Follows the exact path of a problem, and compares the paths of kernels with the exact path.
#pragma once

#include <string>
#include <vector>

#include "contct/exact/path.hpp"
#include "contct/results/free_run.hpp"
#include "contct/structure/problem.hpp"

namespace contct {

/// The comparison of a kernel's path with the exact path.
struct kernel_digits {
  std::string name;
  bool same_events = true;
  std::string first_difference;  ///< difference of events or ends, in words; empty if there is none
  /// Correct digits, from 0 to 16, of the displacement, the share of an event and the contact force with the
  /// largest error. Displacements and forces are compared at the ends of steps that both paths reached,
  /// shares for equal events. Errors of displacements and forces are relative to the largest number of the
  /// kind on the exact path; for slopes, to at least the largest deflection divided by the length of the
  /// structure.
  double digits = 16.0, event_digits = 16.0, force_digits = 16.0;
  /// The number of ends of steps that were compared; if 0, digits and force_digits have no meaning.
  std::size_t steps = 0;
};

/// Compares the path of a kernel. `tie`: events whose shares differ by less than `tie` may come in any order.
[[nodiscard]] kernel_digits digits_on(const recorded_path& path, const std::string& kernel, const problem& p,
                                      const exact_path& exactly, double tie);

/// The results of an exact path. The problem must outlive them.
struct exact_run {
  const problem& what;
  exact_problem exactly;
  exact_path path;
  std::vector<kernel_digits> kernels;  ///< in the order of their names
};

/// Follows the exact path of `p` by `rule`, "corrected" or "1989", then that of each kernel, in a free run.
/// `file`: the path of the problem file as given. `tell` is called before every increment of the exact path,
/// `shown` observes the kernels; both may be null. Throws std::invalid_argument, naming the file, if the
/// problem is too large, a matrix is not positive semidefinite, or numbers become too long.
[[nodiscard]] exact_run run_exactly(const problem& p, const std::string& file, const std::string& rule,
                                    const std::vector<std::string>& kernels,
                                    const exact_progress& tell = nullptr, observer* shown = nullptr);

}  // namespace contct
