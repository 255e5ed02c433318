// The exact path of a problem as it was read, refused where it would take more than a machine has.
#pragma once

#include <string>

#include "contct/exact/exact_problem.hpp"
#include "contct/exact/kernel_digits.hpp"
#include "contct/exact/path.hpp"
#include "contct/model/problem.hpp"
#include "contct/model/structure.hpp"
#include "contct/path/observer.hpp"
#include "contct/path/path.hpp"

namespace contct {

/// The problem in rational numbers. Throws std::invalid_argument, naming
/// `file`, for one that is too large, or whose matrix is not positive semidefinite.
[[nodiscard]] exact_problem exactly_read(const problem& p, const std::string& file);

/// Its path by `rule`, "corrected" or "1989". Throws std::invalid_argument, naming `file`, where numbers
/// become too long.
[[nodiscard]] exact_path follow_exactly(const exact_problem& p, const std::string& rule,
                                        const std::string& file, const exact_progress& tell = nullptr);

/// How many digits of the path of the kernel `name` are right; `shown` observes it, and may be null.
[[nodiscard]] kernel_digits digits_of_kernel(const std::string& name, const problem& p,
                                             const linear_structure& s, const exact_path& exactly,
                                             observer* shown = nullptr);

}  // namespace contct
