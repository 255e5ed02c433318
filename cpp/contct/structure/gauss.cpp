#include "contct/structure/gauss.hpp"

#include <cmath>
#include <numbers>

namespace contct::structure {

std::vector<gauss_point> gauss_points(int n) {
  std::vector<gauss_point> points;
  for (int i = 0; i < n; ++i) {
    // Newton from Tricomi's approximation of the i-th root of the Legendre polynomial P_n.
    double z = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double slope = 1.0;
    for (int step = 0; step < 20; ++step) {
      double p = 1.0;
      double previous = 0.0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * z * p - (k - 1) * previous) / k;
        previous = p;
        p = next;
      }
      slope = n * (z * p - previous) / (z * z - 1);
      const double correction = p / slope;
      z -= correction;
      if (std::abs(correction) < 1e-16) break;
    }
    points.push_back({(1 - z) / 2, 1 / ((1 - z * z) * slope * slope)});
  }
  return points;
}

}  // namespace contct::structure
