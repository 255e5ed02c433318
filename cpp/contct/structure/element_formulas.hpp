// Stiffness matrices, loads and end forces of single elements. `Number` is double, double_double or rational.
// Tests compare these formulas with independent ones in tests/results/write_exact.py.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "contct/number/double_double.hpp"
#include "contct/structure/structure.hpp"

namespace contct {

/// The magnitude that the rounding errors of a double_double are relative to. 0 for rational numbers, which
/// have no rounding errors, and for doubles, for which no size is needed.
template <class Number>
[[nodiscard]] double size_of(const Number& /*x*/) {
  return 0.0;
}
template <>
[[nodiscard]] inline double size_of(const double_double& x) {
  return std::abs(x.hi);
}

}  // namespace contct

namespace contct::formulas {

struct corner {
  int xi, eta;
};
inline constexpr std::array<corner, 4> corners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// The second derivatives of the twelve shape functions by xi and eta, which are -1 and 1 at the edges of an
/// element. With u = xi xi_k, v = eta eta_k, half the width a and half the height b, the shape functions of
/// the dofs w, wx and wy at the corner (xi_k, eta_k) are
///     w       (1 + u)(1 + v)(2 + u + v - u^2 - v^2) / 8
///     a wx    xi_k (1 + u)^2 (u - 1)(1 + v) / 8
///     b wy    eta_k (1 + v)^2 (v - 1)(1 + u) / 8
template <class Number>
struct shape_curvatures {
  std::array<Number, 12> xx{}, yy{}, xy{};
};

template <class Number>
shape_curvatures<Number> curvatures_at(const Number& xi, const Number& eta) {
  shape_curvatures<Number> c;
  for (std::size_t k = 0; k < 4; ++k) {
    const int xi_k = corners[k].xi;
    const int eta_k = corners[k].eta;
    const Number u = xi * xi_k;
    const Number v = eta * eta_k;
    const std::size_t w = 3 * k;
    c.xx[w] = -3 * u * (1 + v) / 4;
    c.yy[w] = -3 * v * (1 + u) / 4;
    c.xy[w] = xi_k * eta_k * (4 - 3 * u * u - 3 * v * v) / 8;
    c.xx[w + 1] = xi_k * (3 * u + 1) * (1 + v) / 4;
    c.xy[w + 1] = eta_k * (3 * u - 1) * (u + 1) / 8;
    c.yy[w + 2] = eta_k * (3 * v + 1) * (1 + u) / 4;
    c.xy[w + 2] = xi_k * (3 * v - 1) * (v + 1) / 8;
  }
  return c;
}

/// curvatures_at the four corners; computed only once.
template <class Number>
const std::array<shape_curvatures<Number>, 4>& corner_curvatures() {
  const auto at = [](const corner& c) { return curvatures_at<Number>(Number(c.xi), Number(c.eta)); };
  static const std::array all = {at(corners[0]), at(corners[1]), at(corners[2]), at(corners[3])};
  return all;
}

/// [i][k] the integrals over xi and eta from -1 to 1 of products of the second derivatives of shape functions
/// i and k: xx xx, yy yy, (xx yy + yy xx) / 2 and xy xy.
template <class Number>
struct bending_integrals {
  std::array<std::array<Number, 12>, 12> xx_xx{}, yy_yy{}, xx_yy{}, xy_xy{};
};

/// An integration point between -1 and 1 and its weight; the weights add up to 2.
template <class Number>
struct weighted_place {
  Number at, weight;
};

/// Boole's rule, whose points and weights are rational. It is exact for degree 5, and the integrands have
/// degree 4 in xi and in eta. For doubles: Gauss's three points.
template <class Number>
std::vector<weighted_place<Number>> places_of_integration() {
  std::vector<weighted_place<Number>> all;
  if constexpr (std::is_same_v<Number, double>) {
    for (const auto& [t, weight] : gauss_points(3)) all.push_back({2 * t - 1, 2 * weight});
  } else {
    const std::array<int, 5> weights = {7, 32, 12, 32, 7};
    for (int i = 0; i < 5; ++i) all.push_back({Number(i - 2) / 2, Number(weights[i]) / 45});
  }
  return all;
}

template <class Number>
bending_integrals<Number> integrate() {
  bending_integrals<Number> sum;
  for (const auto& s : places_of_integration<Number>()) {
    for (const auto& t : places_of_integration<Number>()) {
      const auto c = curvatures_at<Number>(s.at, t.at);
      const Number area = s.weight * t.weight;
      for (std::size_t i = 0; i < 12; ++i) {
        for (std::size_t k = 0; k < 12; ++k) {
          sum.xx_xx[i][k] += area * c.xx[i] * c.xx[k];
          sum.yy_yy[i][k] += area * c.yy[i] * c.yy[k];
          sum.xx_yy[i][k] += area * (c.xx[i] * c.yy[k] + c.yy[i] * c.xx[k]) / 2;
          sum.xy_xy[i][k] += area * c.xy[i] * c.xy[k];
        }
      }
    }
  }
  return sum;
}

/// The coefficients, in t, of q(left + t h), where `polynomial` has those of q(x). By Horner's rule.
template <class Number>
std::vector<Number> in_element(std::span<const Number> polynomial, const Number& left, const Number& h) {
  std::vector<Number> q;
  for (std::size_t i = polynomial.size(); i-- > 0;) {  // q = q (left + t h) + a_i
    q.push_back(Number(0));
    for (std::size_t k = q.size(); k-- > 1;) q[k] = q[k] * left + q[k - 1] * h;
    q[0] = q[0] * left + polynomial[i];
  }
  return q;
}

// An element with shear flexibility has phi = 12 EI / (GA h^2), the share of shear in its deflection. With
// phi = 0 each formula is that of the Hermite element, in which no operation rounds otherwise.

/// Stiffness of a beam's element of length h; dofs: w, theta at the left end, then at the right end.
template <class Number>
std::array<std::array<Number, 4>, 4> beam_stiffness(const Number& EI, const Number& h, const Number& phi) {
  const Number c = EI / h / h / h / (1 + phi);
  const Number k = 12 * c;
  const Number m = 6 * c * h;
  const Number near = (4 + phi) * c * h * h;
  const Number far = (2 - phi) * c * h * h;
  return {{{k, m, -k, m}, {m, near, -m, far}, {-k, -m, k, -m}, {m, far, -m, near}}};
}

/// Shear at the left and right end, then moment at the left and right end, of an element without load.
/// Rotations are taken relative to the chord: otherwise a large rigid-body motion would cancel digits.
template <class Number>
std::array<Number, 4> beam_end_forces(const Number& EI, const Number& h, const Number& phi,
                                      std::span<const Number, 4> u) {
  const Number chord = (u[2] - u[0]) / h;
  const Number left = u[1] - chord;
  const Number right = u[3] - chord;
  const Number stiffness = 2 * EI / h / (1 + phi);
  const Number near = 2 + phi / 2;
  const Number far = 1 - phi / 2;
  const Number m1 = stiffness * (near * left + far * right);
  const Number m2 = stiffness * (far * left + near * right);
  const Number v = (m1 + m2) / h;
  return {v, v, -m1, m2};
}

// A released element has a hinge at its right end, so that its moment is 0 there. The rotation of this end is
// condensed out: -(6 / h (w1 - w2) + (2 - phi) theta1) / (4 + phi), plus the rotation by loads on the
// element.

/// The factors of condensation: the load on the right rotation times these factors is subtracted from the
/// loads on the other three dofs.
template <class Number>
std::array<Number, 3> released_shares(const Number& h, const Number& phi) {
  const Number along = Number(6) / (4 + phi) / h;
  return {along, (2 - phi) / (4 + phi), -along};
}

/// beam_stiffness of a released element.
template <class Number>
std::array<std::array<Number, 4>, 4> released_stiffness(const Number& EI, const Number& h,
                                                        const Number& phi) {
  const Number k = 12 * EI / (4 + phi) / h / h / h;
  const Number m = k * h;
  const Number none(0);
  return {{{k, m, -k, none}, {m, m * h, -m, none}, {-k, -m, k, none}, {none, none, none, none}}};
}

/// beam_end_forces of a released element.
template <class Number>
std::array<Number, 4> released_end_forces(const Number& EI, const Number& h, const Number& phi,
                                          std::span<const Number, 4> u) {
  const Number moment = 12 * EI / (4 + phi) / h * (u[1] - (u[2] - u[0]) / h);
  return {moment / h, moment / h, -moment, Number(0)};
}

/// Work of the load a0 + a1 x + .. on the shape functions of the element from `left` to left + h. The load is
/// evaluated at Gauss points: its coefficients in t = (x - left) / h would lose digits far from x = 0.
inline std::array<double, 4> beam_load_between(std::span<const double> polynomial, double left, double h) {
  if (polynomial.size() == 1) {
    const double q = polynomial[0];
    return {q * h / 2, q * h * h / 12, q * h / 2, -q * h * h / 12};
  }
  std::array<double, 4> f{};
  const int degree = static_cast<int>(polynomial.size()) - 1 + 3;
  for (const auto& [t, weight] : gauss_points(degree / 2 + 1)) {  // t from 0 to 1
    const double q = polynomial_at(polynomial, left + t * h) * weight * h;
    f[0] += q * (1 - t) * (1 - t) * (1 + 2 * t);
    f[1] += q * h * t * (1 - t) * (1 - t);
    f[2] += q * t * t * (3 - 2 * t);
    f[3] -= q * h * t * t * (1 - t);
  }
  return f;
}

// A plate's element is computed in xi = x / a and eta = y / b, where x and y count from its middle, and in
// the dofs w, a wx, b wy, which are all lengths. Units and aspect ratio enter last.

/// The factors that convert the dofs w, wx, wy to w, a wx, b wy.
template <class Number>
std::array<Number, 12> plate_scales(const Number& a, const Number& b) {
  const Number one(1);
  return {one, a, b, one, a, b, one, a, b, one, a, b};
}

/// Stiffness in the dofs w, a wx, b wy, from the strain energy per area
///     D [w_xx^2 + w_yy^2 + 2 nu w_xx w_yy + 2 (1 - nu) w_xy^2] / 2
/// with w_xx = w_xixi / a^2 and so on. The element's area is 4 a b.
template <class Number>
std::array<std::array<Number, 12>, 12> scaled_plate_stiffness(const Number& a, const Number& b,
                                                              const Number& D, const Number& nu) {
  static const bending_integrals<Number> integral = integrate<Number>();
  const Number slenderness = b / a;
  const Number over_area = D / a / b;
  const Number xx = over_area * slenderness * slenderness;
  const Number yy = over_area / slenderness / slenderness;
  const Number both = over_area * 2 * nu;
  const Number twist = over_area * 2 * (1 - nu);
  std::array<std::array<Number, 12>, 12> k{};
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 12; ++j)
      k[i][j] = xx * integral.xx_xx[i][j] + yy * integral.yy_yy[i][j] + both * integral.xx_yy[i][j] +
                twist * integral.xy_xy[i][j];
  return k;
}

/// Stiffness of the Adini-Clough-Melosh rectangle (Melosh 1961, 1963; Adini and Clough 1961) of half width a
/// and half height b; dofs: w, wx, wy at each corner, counter-clockwise from the lower left.
template <class Number>
std::array<std::array<Number, 12>, 12> plate_stiffness(const Number& a, const Number& b, const Number& D,
                                                       const Number& nu) {
  auto k = scaled_plate_stiffness(a, b, D, nu);
  const auto scale = plate_scales(a, b);
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 12; ++j) k[i][j] = k[i][j] * scale[i] * scale[j];
  return k;
}

/// Converts the displacements `u` to the dofs w, a wx, b wy, and subtracts the plane through the deflections
/// of corners 0, 1 and 3: otherwise a large rigid-body motion would cancel the digits of the bending.
template <class Number>
std::array<Number, 12> plate_deformation(const Number& a, const Number& b, const std::array<Number, 12>& u) {
  const Number along_x = u[3] - u[0];
  const Number along_y = u[9] - u[0];
  std::array<Number, 12> v{};
  v[6] = (u[6] - u[3]) - along_y;
  for (std::size_t k = 0; k < 12; k += 3) {
    v[k + 1] = a * u[k + 1] - along_x / 2;
    v[k + 2] = b * u[k + 2] - along_y / 2;
  }
  return v;
}

/// The nodal forces that hold a plate's element at the displacements `u`.
template <class Number>
std::array<Number, 12> plate_forces(const Number& a, const Number& b, const Number& D, const Number& nu,
                                    const std::array<Number, 12>& u) {
  const auto k = scaled_plate_stiffness(a, b, D, nu);
  const auto scale = plate_scales(a, b);
  const auto v = plate_deformation(a, b, u);
  std::array<Number, 12> f{};
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) f[i] += k[i][j] * v[j];
    f[i] *= scale[i];
  }
  return f;
}

template <class Number>
struct curvature {
  Number xx{}, yy{}, xy{};
};

/// w_xx, w_yy and w_xy at the four corners for `v`, a plate_deformation.
template <class Number>
std::array<curvature<Number>, 4> curvatures_at_corners(const Number& a, const Number& b,
                                                       const std::array<Number, 12>& v) {
  std::array<curvature<Number>, 4> at{};
  for (std::size_t k = 0; k < 4; ++k) {
    const shape_curvatures<Number>& c = corner_curvatures<Number>()[k];
    const auto add = [](Number& sum, const Number& share, const Number& x) {
      if (!(share == Number(0))) sum += share * x;  // most are 0
    };
    for (std::size_t i = 0; i < 12; ++i) {
      add(at[k].xx, c.xx[i], v[i]);
      add(at[k].yy, c.yy[i], v[i]);
      add(at[k].xy, c.xy[i], v[i]);
    }
    at[k].xx = at[k].xx / (a * a);
    at[k].yy = at[k].yy / (b * b);
    at[k].xy = at[k].xy / (a * b);
  }
  return at;
}

/// Work of a unit pressure on the element's shape functions.
template <class Number>
std::array<Number, 12> plate_unit_load(const Number& a, const Number& b) {
  std::array<Number, 12> f{};
  for (std::size_t k = 0; k < 4; ++k) {
    f[3 * k] = a * b;
    f[3 * k + 1] = -corners[k].xi * a * a * b / 3;
    f[3 * k + 2] = -corners[k].eta * b * b * a / 3;
  }
  return f;
}

/// The integrals over xi, from `from` to `to`, of the factors in the shape functions: 2 + 3 u - u^3, 1 + u,
/// u^3 - u and u^3 + u^2 - u - 1 with u = xi xi_k.
template <class Number>
std::array<Number, 4> shape_integrals(int xi_k, const Number& from, const Number& to) {
  std::array<Number, 5> power{};  // [n] integral of u^(n - 1)
  Number low(1);
  Number high(1);
  for (int n = 1; n < 5; ++n) {
    low = low * from * xi_k;
    high = high * to * xi_k;
    power[n] = (high - low) * xi_k / n;
  }
  return {2 * power[1] + 3 * power[2] - power[4], power[1] + power[2], power[4] - power[2],
          power[4] + power[3] - power[2] - power[1]};
}

/// The integrals of the derivatives of the same factors.
template <class Number>
std::array<Number, 4> shape_differences(int xi_k, const Number& from, const Number& to) {
  const auto at = [](const Number& u) {
    return std::array<Number, 4>{u * (3 - u * u), u, u * (u * u - 1), u * (u * u + u - 1)};
  };
  std::array<Number, 4> change = at(to * xi_k);
  const std::array<Number, 4> before = at(from * xi_k);
  for (std::size_t i = 0; i < change.size(); ++i) change[i] -= before[i];
  return change;
}

/// Work, on the element's shape functions, on the part from xi[0] to xi[1] and eta[0] to eta[1], all within
/// -1 and 1: of a unit pressure for `slope` 0; of a unit moment per area on wx for 1, on wy for 2.
template <class Number>
std::array<Number, 12> plate_unit_load_on(const Number& a, const Number& b, const std::array<Number, 2>& xi,
                                          const std::array<Number, 2>& eta, int slope = 0) {
  const auto factors = [](bool derived, int corner, const std::array<Number, 2>& part, const Number& half) {
    if (!derived) return shape_integrals(corner, part[0], part[1]);
    std::array<Number, 4> all = shape_differences(corner, part[0], part[1]);
    for (Number& f : all) f = f / half;
    return all;
  };
  std::array<Number, 12> f{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto u = factors(slope == 1, corners[k].xi, xi, a);
    const auto v = factors(slope == 2, corners[k].eta, eta, b);
    f[3 * k] = a * b * (u[0] * v[1] - u[1] * v[2]) / 8;
    f[3 * k + 1] = corners[k].xi * a * a * b * u[3] * v[1] / 8;
    f[3 * k + 2] = corners[k].eta * b * b * a * u[1] * v[3] / 8;
  }
  return f;
}

}  // namespace contct::formulas
