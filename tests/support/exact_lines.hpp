// Deflection, moment and shear along a beam's elements in exact arithmetic.
#pragma once

#include <algorithm>
#include <array>

#include "contct/exact/path.hpp"
#include "contct/structure/element_formulas.hpp"
#include "contct/structure/elements.hpp"

namespace contct {

/// Returns w, moment and shear of an element as polynomials in t from 0 to 1, under the displacements u.
inline std::array<rational_vector, 3> exact_line(const beam& b, const load& l, int e,
                                                 const rational_vector& u) {
  const std::size_t at = std::size_t{1} * e;
  const rational left = decimal_of(b.x[at]);
  const rational h = decimal_of(b.x[at + 1]) - left;
  const auto EI = stiffness_of<rational>(b, e);
  rational_vector q(1);
  for (const distributed_load& d : l.distributed) {
    if (!d.elements.empty() && std::ranges::find(d.elements, e) == d.elements.end()) continue;
    q.resize(std::max(q.size(), d.polynomial.size()));
    for (std::size_t i = 0; i < d.polynomial.size(); ++i) q[i] += decimal_of(d.polynomial[i]);
  }
  q = formulas::in_element<rational>(q, left, h);
  const auto integral = [&h](const rational& start, const rational_vector& p) {
    rational_vector all = {start};
    for (std::size_t j = 0; j < p.size(); ++j) all.emplace_back(p[j] * h / static_cast<int>(j + 1));
    return all;
  };
  const auto ends = elements_of<rational>(b).end_forces(l, u)[at];
  const rational_vector shear = integral(ends[0], q);
  const rational_vector moment = integral(ends[2], shear);
  rational_vector slope = integral(0, moment);
  for (rational& s : slope) s /= EI;
  slope[0] = u[2 * at + 1];
  return {integral(u[2 * at], slope), moment, shear};
}

}  // namespace contct
