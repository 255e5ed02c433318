// How the cost of an event grows with the size of the structure, as a picture.
#pragma once

#include <string>
#include <vector>

namespace bench {

struct growth_point {
  std::string family;  ///< rail, mat, grid
  std::string engine;
  double dofs;  ///< or another size
  double ms_per_event;
};

/// The slope of the straight line through the logarithms, by least squares: 1 is a cost proportional to the
/// size. NaN for fewer than two sizes.
[[nodiscard]] double slope_of(const std::vector<growth_point>& of_one_line);

/// A panel a family, a line an engine, both axes logarithmic, each line with its slope.
[[nodiscard]] std::string growth_svg(const std::vector<growth_point>& points, const std::string& caption);

}  // namespace bench
