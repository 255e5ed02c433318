// Numbers, lines and polynomials of a file in rational numbers.
#pragma once

#include <span>
#include <vector>

#include "contct/numeric/rational.hpp"
#include "contct/structure/line.hpp"

namespace contct::structure {

template <>
[[nodiscard]] inline numeric::rational number_of(double x) {
  return numeric::decimal_of(x);
}

template <>
[[nodiscard]] inline std::vector<numeric::rational> coefficients_of(const distributed_load& d) {
  std::vector<numeric::rational> sum(d.polynomial.size());
  const auto add = [&sum](std::span<const double> part) {
    for (std::size_t i = 0; i < part.size(); ++i) sum[i] += numeric::decimal_of(part[i]);
  };
  if (d.parts.empty()) add(d.polynomial);
  for (const std::vector<double>& part : d.parts) add(part);
  return sum;
}

template <>
[[nodiscard]] inline numeric::rational stiffness_of(const plate& p) {
  if (p.E == 0) return numeric::decimal_of(p.D);
  const numeric::rational nu = numeric::decimal_of(p.nu);
  const numeric::rational t = numeric::decimal_of(p.thickness);
  return numeric::decimal_of(p.E) * t * t * t / (12 * (1 - nu * nu));
}

}  // namespace contct::structure
