// The envelope of a path along a beam: how small and how large each quantity gets at each place, and in which
// state.
#pragma once

#include <string_view>
#include <vector>

#include "contct/session/step_results.hpp"

namespace contct {

/// Empty for plates and matrices, and where no state is known.
struct envelope_curves {
  struct curve {
    std::string_view name;                    ///< "w", "moment" or "shear"
    std::vector<envelope::range<double>> at;  ///< [places]
  };
  /// Nodes, and places at equal distances in each element where there are fewer than 480 elements. A node
  /// between two elements is there twice, as the end of one and the start of the other: the shear may jump.
  std::vector<double> x;
  std::vector<curve> curves;
};

/// Over the same states as envelope_of.
[[nodiscard]] envelope_curves curves_of(const run_result& r);

}  // namespace contct
