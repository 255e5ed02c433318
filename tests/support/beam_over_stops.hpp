// A cantilever with a pair at each node, for tests of engines.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "contct/model/problem.hpp"
#include "contct/solve/factored_stiffness.hpp"

namespace contct {

/// Returns a cantilever whose pairs are separated, with springs from softer to stiffer than the beam.
inline linear_structure cantilever_over_stops(int elements) {
  beam b;
  for (int i = 0; i <= elements; ++i) b.x.push_back(0.5 * i);
  b.EI.assign(elements, 1e4);
  std::vector<contact_pair> pairs;
  for (int i = 1; i <= elements; ++i) pairs.push_back({i, -1, -0.01, std::pow(10.0, 2 + i % 4), false});
  return build(b, std::vector<support>{{0, 0, true}, {0, 1, true}}, pairs);
}

/// Returns the response at the pairs, computed with a new factor.
inline std::vector<double> response_by_factor(const linear_structure& s, const std::vector<char>& closed,
                                              std::vector<double> load) {
  factored_stiffness k(s);
  k.factor(closed);
  k.solve(load);
  std::vector<double> at_pairs(s.pairs.size());
  gather_at_pairs(s, load, at_pairs);
  return at_pairs;
}

/// Returns the largest difference between two vectors relative to the largest entry.
inline double relative_difference(std::span<const double> a, std::span<const double> b) {
  double size = 0.0;
  double off = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    size = std::max(size, std::abs(a[i]));
    off = std::max(off, std::abs(a[i] - b[i]));
  }
  return off / size;
}

}  // namespace contct
