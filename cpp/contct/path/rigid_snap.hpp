// A structure that nothing holds moves rigidly, at constant load, to the next face.
#pragma once

#include <span>

#include "contct/structure/structure.hpp"

namespace contct::path {

/// Write to `d_star` [pairs] a rigid motion that the residual load drives and that
/// supports and closed pairs leave free: the limit, up to its size, of the response of the structure on a
/// ground that gets ever softer. It is long enough to reach every separated pair on its way. `increment`
/// is the step's load increment [dofs], `d` the deflection now and `status` ISEP [pairs]. False, and
/// nothing written, when the load does no work on any free motion.
[[nodiscard]] bool rigid_snap(const linear_structure& s, std::span<const int> status,
                              std::span<const double> increment, std::span<const double> d,
                              std::span<double> d_star);

}  // namespace contct::path
