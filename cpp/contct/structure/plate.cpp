#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "contct/numeric/rational.hpp"
#include "contct/structure/plate_element.hpp"
#include "contct/structure/problem.hpp"
#include "contct/structure/true_plate.hpp"

namespace contct::structure {
namespace {

// Everything in an element is in xi = x / a, eta = y / b, from -1 to 1, and in the dofs w, a wx, b wy, which
// are all lengths: units and aspect ratio enter last.

struct corner {
  double xi, eta;
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
      for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t k = 0; k < 12; ++k) {
          sum.xx_xx[i][k] += area * c.xx[i] * c.xx[k];
          sum.yy_yy[i][k] += area * c.yy[i] * c.yy[k];
          sum.xx_yy[i][k] += area * (c.xx[i] * c.yy[k] + c.yy[i] * c.xx[k]) / 2;
          sum.xy_xy[i][k] += area * c.xy[i] * c.xy[k];
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
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 12; ++j)
      k[i][j] = xx * integral.xx_xx[i][j] + yy * integral.yy_yy[i][j] + both * integral.xx_yy[i][j] +
                twist * integral.xy_xy[i][j];
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

plate_element element_of(const plate& p, int element) {
  return {p.width_of(element) / 2, p.height_of(element) / 2, p.D, p.nu};
}

element_vector12 displacement_of(const plate& p, int element, std::span<const double> u) {
  const std::array<int, 12> dofs = p.dofs_of(element);
  element_vector12 own{};
  for (std::size_t i = 0; i < 12; ++i) own[i] = u[dofs[i]];
  return own;
}

/// The pressure on every element: all the distributed loads together.
std::vector<double> pressures(const plate& p, const load& l) {
  std::vector<double> q(p.elements(), 0.0);
  for_each_loaded_element(l, p.elements(), [&q](int e, std::span<const double> polynomial) {
    if (polynomial.size() != 1) throw std::invalid_argument("the pressure on a plate's element is constant");
    q[e] += polynomial[0];
  });
  return q;
}

/// Nodes numbered along the shorter side: the numbers of neighbours then lie closest to each other.
/// Empty where that is the numbering of the plate itself.
std::vector<int> rows_along_shorter_side(const plate& p) {
  if (p.columns() <= p.rows()) return {};
  std::vector<int> rows;
  rows.reserve(p.dofs());
  for (int j = 0; j < p.rows(); ++j)
    for (int i = 0; i < p.columns(); ++i)
      for (int d = 0; d < 3; ++d) rows.push_back(3 * (i * p.rows() + j) + d);
  return rows;
}

void assemble_elements(const plate& p, linear_structure& s) {
  for (int e = 0; e < p.elements(); ++e) {
    const element_matrix12 k = stiffness_of(element_of(p, e));
    const std::array<int, 12> dofs = p.dofs_of(e);
    for (std::size_t i = 0; i < 12; ++i)
      for (std::size_t j = 0; j <= i; ++j)
        add_to_band(s.stiffness.band(), s.row_of(dofs[i]), s.row_of(dofs[j]), k[i][j], e);
  }
}

/// What the plate's rigid motions do at each dof: up by 1, and turns about the middle that lift the
/// edge at the largest x, or y, by 1.
std::vector<rigid_row> rigid_rows_of(const plate& p) {
  const double half_x = (p.x.back() - p.x.front()) / 2;
  const double half_y = (p.y.back() - p.y.front()) / 2;
  std::vector<rigid_row> rows;
  rows.reserve(p.dofs());
  for (const double y : p.y) {
    for (const double x : p.x) {
      rows.push_back({1, (x - p.x.front()) / half_x - 1, (y - p.y.front()) / half_y - 1});
      rows.push_back({0, 1 / half_x, 0});
      rows.push_back({0, 0, 1 / half_y});
    }
  }
  return rows;
}

/// The elements that meet at a node, one to four.
std::vector<int> elements_around(const plate& p, int node) {
  const int i = node % p.columns();
  const int j = node / p.columns();
  std::vector<int> around;
  for (int row = std::max(j - 1, 0); row <= std::min(j, p.rows() - 2); ++row)
    for (int column = std::max(i - 1, 0); column <= std::min(i, p.columns() - 2); ++column)
      around.push_back(row * (p.columns() - 1) + column);
  return around;
}

/// What the elements around a dof need there, beyond the pressure on them.
double need_at(const plate& p, std::span<const double> pressure, std::span<const double> u, int node,
               int dof) {
  double need = 0.0;
  for (const int e : elements_around(p, node)) {
    const std::array<int, 4> nodes_of_e = p.corners_of(e);
    const auto place = std::find(nodes_of_e.begin(), nodes_of_e.end(), node) - nodes_of_e.begin();
    const std::size_t own = 3 * place + dof;
    const plate_element element = element_of(p, e);
    need += forces_at(element, displacement_of(p, e, u))[own];
    need -= pressure[e] * unit_pressure_on(element)[own];
  }
  return need;
}

}  // namespace

element_matrix12 stiffness_of(const plate_element& e) {
  element_matrix12 k = scaled_stiffness(e);
  const element_vector12 scale = scales_of(e);
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j < 12; ++j) k[i][j] = k[i][j] * scale[i] * scale[j];
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

numeric::double_double stiffness_of(const plate& p) {
  if (p.E == 0.0) return numeric::long_decimal(p.D);
  const numeric::rational nu = numeric::decimal_of(p.nu);
  const numeric::rational t = numeric::decimal_of(p.thickness);
  return numeric::long_rounded(numeric::decimal_of(p.E) * t * t * t / (12 * (1 - nu * nu)));
}

linear_structure build(const plate& p, std::span<const support> supports, std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = plate::dofs_per_node;
  s.stiffness = band_matrix(p.dofs(), 3 * (std::min(p.columns(), p.rows()) + 1) + 2);
  s.rows = rows_along_shorter_side(p);
  assemble_elements(p, s);
  s.rigid_motions = 3;
  s.rigid_rows = rigid_rows_of(p);
  s.truth = std::make_shared<rigid_truth>(p);
  put_on_supports(s, supports, std::move(pairs));
  return s;
}

void add_consistent_loads(const plate& p, const load& l, std::span<double> f) {
  add_point_loads(l, plate::dofs_per_node, f);
  const std::vector<double> pressure = pressures(p, l);
  for (int e = 0; e < p.elements(); ++e) {
    const element_vector12 unit = unit_pressure_on(element_of(p, e));
    const std::array<int, 12> dofs = p.dofs_of(e);
    for (std::size_t i = 0; i < 12; ++i) f[dofs[i]] += pressure[e] * unit[i];
  }
}

std::vector<corner_moments> moments_in_elements(const plate& p, std::span<const double> u) {
  std::vector<corner_moments> moments;
  moments.reserve(p.elements());
  for (int e = 0; e < p.elements(); ++e) {
    const auto curvatures = curvatures_at_corners(element_of(p, e), displacement_of(p, e, u));
    corner_moments m{};
    for (std::size_t k = 0; k < 4; ++k) {
      m.mx[k] = p.D * (curvatures[k].xx + p.nu * curvatures[k].yy);
      m.my[k] = p.D * (curvatures[k].yy + p.nu * curvatures[k].xx);
      m.mxy[k] = p.D * (1 - p.nu) * curvatures[k].xy;
    }
    moments.push_back(m);
  }
  return moments;
}

std::vector<double> reactions(const plate& p, const load& l, std::span<const support> supports,
                              std::span<const double> u) {
  const std::vector<double> pressure = pressures(p, l);
  return reactions_of(supports, l, u, plate::dofs_per_node,
                      [&](int node, int dof) { return need_at(p, pressure, u, node, dof); });
}

std::vector<double> tributary_shares(const plate& p) {
  const std::vector<double> along_x = tributary_lengths(p.x);
  const std::vector<double> along_y = tributary_lengths(p.y);
  std::vector<double> areas;
  areas.reserve(p.nodes());
  for (const double height : along_y)
    for (const double width : along_x) areas.push_back(width * height);
  return areas;
}

}  // namespace contct::structure
