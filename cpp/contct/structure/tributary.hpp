// Which part of a line belongs to which of its points.
#pragma once

#include <vector>

namespace contct {

/// Half of each interval beside a point; `x` increases.
[[nodiscard]] inline std::vector<double> tributary_lengths(const std::vector<double>& x) {
  std::vector<double> lengths(x.size(), 0.0);
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double half = (x[i + 1] - x[i]) / 2;
    lengths[i] += half;
    lengths[i + 1] += half;
  }
  return lengths;
}

}  // namespace contct
