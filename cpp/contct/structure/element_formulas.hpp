// The matrices of single elements in numbers of any kind that knows + - * /: rational, or of two doubles.
// What rounds in doubles alone has formulas of its own (beam.cpp, plate.cpp), so that each can judge the
// other.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::structure::formulas {

struct corner {
  int xi, eta;
};
inline constexpr std::array<corner, 4> corners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Second derivatives of the twelve shape functions by xi and eta (structure/plate.cpp has their formulas).
template <class Number>
struct shape_curvatures {
  std::array<Number, 12> xx, yy, xy;
};

/// At xi and eta, from -1 to 1.
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

/// Integrals over the square from -1 to 1 of w_xx w_xx, w_yy w_yy, (w_xx w_yy + w_yy w_xx) / 2 and w_xy w_xy.
template <class Number>
struct bending_integrals {
  std::array<std::array<Number, 12>, 12> xx_xx, yy_yy, xx_yy, xy_xy;
};

/// By Boole's rule, whose places and weights are rational: exact for degree 5, and these are of degree 4.
template <class Number>
bending_integrals<Number> integrate() {
  const std::array<int, 5> weights = {7, 32, 12, 32, 7};  // each / 45
  bending_integrals<Number> sum;
  for (int s = 0; s < 5; ++s) {
    for (int t = 0; t < 5; ++t) {
      const auto c = curvatures_at<Number>(Number(s - 2) / 2, Number(t - 2) / 2);
      const int weight = weights[static_cast<std::size_t>(s)] * weights[static_cast<std::size_t>(t)];
      const Number area = Number(weight) / (45 * 45);
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

/// q(left + t h) as a polynomial in t, by Horner's rule.
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

/// Stiffness of a Hermite element of length h: w, theta at the left end; w, theta at the right.
template <class Number>
std::array<std::array<Number, 4>, 4> beam_stiffness(const Number& EI, const Number& h) {
  const Number c = EI / (h * h * h);
  const Number k = 12 * c;
  const Number m = 6 * c * h;
  const Number near = 4 * c * h * h;
  const Number far = near / 2;
  return {{{k, m, -k, m}, {m, near, -m, far}, {-k, -m, k, -m}, {m, far, -m, near}}};
}

/// Work of the load q(t) = q0 + q1 t + .. on the shape functions of an element of length h.
template <class Number>
std::array<Number, 4> beam_load(std::span<const Number> q, const Number& h) {
  std::array<Number, 4> f{};
  for (std::size_t m = 0; m < q.size(); ++m) {
    // The integral of t^m times 1 - 3 t^2 + 2 t^3, t - 2 t^2 + t^3, 3 t^2 - 2 t^3 and t^3 - t^2.
    const auto power = [m](int n) { return Number(1) / Number(static_cast<int>(m) + n + 1); };
    f[0] += q[m] * h * (power(0) - 3 * power(2) + 2 * power(3));
    f[1] += q[m] * h * h * (power(1) - 2 * power(2) + power(3));
    f[2] += q[m] * h * (3 * power(2) - 2 * power(3));
    f[3] += q[m] * h * h * (power(3) - power(2));
  }
  return f;
}

/// The Adini-Clough-Melosh rectangle of half width a and half height b: w, wx, wy at each corner,
/// counter-clockwise from the lower left.
template <class Number>
std::array<std::array<Number, 12>, 12> plate_stiffness(const Number& a, const Number& b, const Number& D,
                                                       const Number& nu) {
  static const bending_integrals<Number> integral = integrate<Number>();
  const Number xx = D * b / (a * a * a);
  const Number yy = D * a / (b * b * b);
  const Number both = 2 * D * nu / (a * b);
  const Number twist = 2 * D * (1 - nu) / (a * b);
  std::array<std::array<Number, 12>, 12> k;
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) {
      const auto scale = [&](std::size_t dof) { return dof % 3 == 0 ? Number(1) : dof % 3 == 1 ? a : b; };
      k[i][j] = (xx * integral.xx_xx[i][j] + yy * integral.yy_yy[i][j] + both * integral.xx_yy[i][j] +
                 twist * integral.xy_xy[i][j]) *
                scale(i) * scale(j);
    }
  }
  return k;
}

/// Work of a unit pressure on its shape functions.
template <class Number>
std::array<Number, 12> plate_unit_load(const Number& a, const Number& b) {
  std::array<Number, 12> f;
  for (std::size_t k = 0; k < 4; ++k) {
    f[3 * k] = a * b;
    f[3 * k + 1] = -corners[k].xi * a * a * b / 3;
    f[3 * k + 2] = -corners[k].eta * b * b * a / 3;
  }
  return f;
}

}  // namespace contct::structure::formulas
