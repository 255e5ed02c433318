// Gauss-Legendre quadrature on [0, 1].
#pragma once

#include <vector>

#include "contct/rooms.hpp"

namespace contct::structure {

struct gauss_point {
  double t;       ///< place, between 0 and 1
  double weight;  ///< the weights add up to 1
};

/// `n` points, exact for polynomials up to degree 2 n - 1. n >= 1.
[[nodiscard]] std::vector<gauss_point> gauss_points(int n);

}  // namespace contct::structure
