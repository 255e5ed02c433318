// Is a load carried? Forces that only push add up to it, or they do not: decided without rounding.
#pragma once

#include <span>
#include <vector>

#include "contct/numeric/rational.hpp"

namespace contct::numeric {

/// Is `sum` [n] the sum of `parts`, each n numbers, with shares of which none is negative? The simplex
/// method, by Bland's rule (1977) where it stalls, which does not cycle, on n equations. The parts may be
/// many, and n is small.
[[nodiscard]] bool is_in_cone(const std::vector<rational>& sum, std::span<const std::vector<rational>> parts);

}  // namespace contct::numeric
