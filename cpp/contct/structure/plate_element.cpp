#include "contct/structure/plate_element.hpp"

#include <cstddef>

#include "contct/structure/gauss.hpp"

namespace contct::structure {
namespace {

// Everything here is in xi = x / a, eta = y / b, from -1 to 1, and in the dofs w, a wx, b wy, which are
// all lengths: units and aspect ratio enter last.

struct corner {
  double xi;
  double eta;
};
constexpr std::array<corner, 4> corners = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

/// Second derivatives of the twelve shape functions by xi and eta.
struct shape_curvatures {
  element_vector12 xx, yy, xy;
};

/// The shape functions of the corner at (xi_k, eta_k), with u = xi xi_k and v = eta eta_k, are
///     w       (1 + u)(1 + v)(2 + u + v - u^2 - v^2) / 8
///     a wx    xi_k (1 + u)^2 (u - 1)(1 + v) / 8
///     b wy    eta_k (1 + v)^2 (v - 1)(1 + u) / 8
shape_curvatures curvatures_of_shapes(double xi, double eta) {
  shape_curvatures c{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [xi_k, eta_k] = corners[k];
    const double u = xi * xi_k;
    const double v = eta * eta_k;
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

/// The four integrals over the square of which every element's stiffness is made.
struct bending_integrals {
  element_matrix12 xx_xx{};  // of w_xx w_xx
  element_matrix12 yy_yy{};
  element_matrix12 xx_yy{};  // of w_xx w_yy + w_yy w_xx, halved
  element_matrix12 xy_xy{};
};

bending_integrals integrate() {
  bending_integrals sum;
  for (const auto& [s, ds] : gauss_points(3)) {  // degree 4 in each direction; s and t from 0 to 1
    for (const auto& [t, dt] : gauss_points(3)) {
      const shape_curvatures c = curvatures_of_shapes(2 * s - 1, 2 * t - 1);
      const double area = 4 * ds * dt;
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

/// Stiffness in the dofs w, a wx, b wy: the strain energy's
///     D [w_xx^2 + w_yy^2 + 2 nu w_xx w_yy + 2 (1 - nu) w_xy^2] / 2
/// with w_xx = w_xixi / a^2 and so on, over the area 4 a b.
element_matrix12 scaled_stiffness(const plate_element& e) {
  static const bending_integrals integral = integrate();
  const double slenderness = e.b / e.a;
  const double D = e.D / e.a / e.b;
  const double xx = D * slenderness * slenderness;
  const double yy = D / slenderness / slenderness;
  const double both = D * 2 * e.nu;
  const double twist = D * 2 * (1 - e.nu);
  element_matrix12 k{};
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) {
      k[i][j] = xx * integral.xx_xx[i][j] + yy * integral.yy_yy[i][j] + both * integral.xx_yy[i][j] +
                twist * integral.xy_xy[i][j];
    }
  }
  return k;
}

/// From the dofs w, wx, wy to w, a wx, b wy.
element_vector12 scales_of(const plate_element& e) {
  return {1, e.a, e.b, 1, e.a, e.b, 1, e.a, e.b, 1, e.a, e.b};
}

/// `u` in the scaled dofs, less the plane through corners 0, 1 and 3: a large rigid motion would
/// cancel the digits of the bending.
element_vector12 deformation(const plate_element& e, const element_vector12& u) {
  const double along_x = u[3] - u[0];
  const double along_y = u[9] - u[0];
  element_vector12 v{};
  v[6] = (u[6] - u[3]) - along_y;
  for (std::size_t k = 0; k < 12; k += 3) {
    v[k + 1] = e.a * u[k + 1] - along_x / 2;
    v[k + 2] = e.b * u[k + 2] - along_y / 2;
  }
  return v;
}

}  // namespace

element_matrix12 stiffness_of(const plate_element& e) {
  element_matrix12 k = scaled_stiffness(e);
  const element_vector12 scale = scales_of(e);
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) k[i][j] = k[i][j] * scale[i] * scale[j];
  }
  return k;
}

element_vector12 unit_pressure_on(const plate_element& e) {
  element_vector12 f{};
  for (std::size_t k = 0; k < 4; ++k) {
    f[3 * k] = e.a * e.b;
    f[3 * k + 1] = -corners[k].xi * e.a * e.a * e.b / 3;
    f[3 * k + 2] = -corners[k].eta * e.b * e.b * e.a / 3;
  }
  return f;
}

element_vector12 forces_at(const plate_element& e, const element_vector12& u) {
  const element_matrix12 k = scaled_stiffness(e);
  const element_vector12 scale = scales_of(e);
  const element_vector12 v = deformation(e, u);
  element_vector12 f{};
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) f[i] += k[i][j] * v[j];
    f[i] *= scale[i];
  }
  return f;
}

std::array<curvature, 4> curvatures_at_corners(const plate_element& e, const element_vector12& u) {
  const element_vector12 v = deformation(e, u);
  std::array<curvature, 4> at{};
  for (std::size_t k = 0; k < 4; ++k) {
    const shape_curvatures c = curvatures_of_shapes(corners[k].xi, corners[k].eta);
    for (std::size_t i = 0; i < 12; ++i) {
      at[k].xx += c.xx[i] * v[i];
      at[k].yy += c.yy[i] * v[i];
      at[k].xy += c.xy[i] * v[i];
    }
    at[k].xx /= e.a * e.a;
    at[k].yy /= e.b * e.b;
    at[k].xy /= e.a * e.b;
  }
  return at;
}

}  // namespace contct::structure
