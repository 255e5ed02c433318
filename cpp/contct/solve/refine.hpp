// A solution corrected by what it leaves over, until that no longer helps.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace contct {

/// `correction_of(u, c)` solves for what u leaves of its right-hand side; `scale(i)` is the root of the
/// stiffness at entry i, so that entries of different units can be compared.
template <class Scale, class CorrectionOf>
void refine(std::span<double> u, Scale scale, CorrectionOf correction_of) {
  constexpr int most_passes = 6;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  std::vector<double> correction(u.size());
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most_passes; ++pass) {
    correction_of(std::span<const double>(u), std::span<double>(correction));
    double largest = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i) {
      largest = std::max(largest, scale(i) * std::abs(correction[i]));
      size = std::max(size, scale(i) * std::abs(u[i]));
    }
    if (!(largest < before / 2)) return;
    for (std::size_t i = 0; i < u.size(); ++i) u[i] += correction[i];
    if (largest <= eps / 2 * size) return;
    before = largest;
  }
}

}  // namespace contct
