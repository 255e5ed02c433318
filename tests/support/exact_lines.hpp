// Deflection, moment and shear along a beam's elements in exact arithmetic.
#pragma once

#include <algorithm>
#include <array>

#include "contct/exact/path.hpp"
#include "contct/model/element_formulas.hpp"

namespace contct {

inline rational value_at(const rational_vector& p, const rational& t) {
  rational sum;
  for (std::size_t i = p.size(); i-- > 0;) sum = sum * t + p[i];
  return sum;
}

/// Returns the load on an element as a polynomial in the distance from its left end.
inline rational_vector exact_load(const load& l, int e, const rational& left, const rational& h) {
  rational_vector sum(1);
  for (const distributed_load& d : l.distributed) {
    if (!d.elements.empty() && std::ranges::find(d.elements, e) == d.elements.end()) continue;
    sum.resize(std::max(sum.size(), d.polynomial.size()));
    for (std::size_t i = 0; i < d.polynomial.size(); ++i) sum[i] += decimal_of(d.polynomial[i]);
  }
  return formulas::in_element<rational>(sum, left, h);
}

/// Returns the work of the load q(t) = q0 + q1 t + .. on the shape functions of an element of length h.
inline std::array<rational, 4> exact_work(const rational_vector& q, const rational& h) {
  std::array<rational, 4> f;
  for (std::size_t m = 0; m < q.size(); ++m) {
    // Integrals of t^m times 1 - 3 t^2 + 2 t^3, t - 2 t^2 + t^3, 3 t^2 - 2 t^3 and t^3 - t^2.
    const auto power = [m](int n) { return rational(1, static_cast<int>(m) + n + 1); };
    f[0] += q[m] * h * (power(0) - 3 * power(2) + 2 * power(3));
    f[1] += q[m] * h * h * (power(1) - 2 * power(2) + power(3));
    f[2] += q[m] * h * (3 * power(2) - 2 * power(3));
    f[3] += q[m] * h * h * (power(3) - power(2));
  }
  return f;
}

/// Returns w, moment and shear of an element as polynomials in t from 0 to 1, under the displacements u.
inline std::array<rational_vector, 3> exact_line(const beam& b, const load& l, int e,
                                                 const rational_vector& u) {
  const std::size_t at = std::size_t{1} * e;
  const rational left = decimal_of(b.x[at]);
  const rational h = decimal_of(b.x[at + 1]) - left;
  const auto EI = stiffness_of<rational>(b, e);
  const rational_vector q = exact_load(l, e, left, h);
  const bool released = b.has_hinge(e + 1);
  const auto k = released ? formulas::released_stiffness(EI, h) : formulas::beam_stiffness(EI, h);
  auto work = exact_work(q, h);
  if (released) {  // condenses the rotation at the hinge
    work[0] -= 3 * work[3] / (2 * h);
    work[1] -= work[3] / 2;
  }
  rational force[2] = {-work[0], -work[1]};
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 4; ++j) force[i] += k[i][j] * u[2 * at + j];
  rational_vector shear = {force[0]};
  for (std::size_t j = 0; j < q.size(); ++j) shear.emplace_back(q[j] * h / static_cast<int>(j + 1));
  rational_vector moment = {-force[1]};
  for (std::size_t j = 0; j < shear.size(); ++j) moment.emplace_back(shear[j] * h / static_cast<int>(j + 1));
  rational_vector w = {u[2 * at], u[2 * at + 1] * h};
  for (std::size_t j = 0; j < moment.size(); ++j)
    w.emplace_back(moment[j] * h * h / EI / static_cast<int>((j + 1) * (j + 2)));
  return {w, moment, shear};
}

}  // namespace contct
