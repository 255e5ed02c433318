#include "contct/structure/plate.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "contct/structure/plate_element.hpp"

namespace contct::structure {
namespace {

plate_element element_of(const plate& p, int element) {
  return {p.width_of(element) / 2, p.height_of(element) / 2, p.D, p.nu};
}

/// The twelve dofs of an element.
std::array<int, 12> dofs_of(const plate& p, int element) {
  std::array<int, 12> dofs{};
  std::size_t next = 0;
  for (const int node : p.corners_of(element)) {
    for (int d = 0; d < 3; ++d) dofs[next++] = 3 * node + d;
  }
  return dofs;
}

element_vector12 displacement_of(const plate& p, int element, std::span<const double> u) {
  const std::array<int, 12> dofs = dofs_of(p, element);
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
  for (int j = 0; j < p.rows(); ++j) {
    for (int i = 0; i < p.columns(); ++i) {
      for (int d = 0; d < 3; ++d) rows.push_back(3 * (i * p.rows() + j) + d);
    }
  }
  return rows;
}

void assemble_elements(const plate& p, linear_structure& s) {
  for (int e = 0; e < p.elements(); ++e) {
    const element_matrix12 k = stiffness_of(element_of(p, e));
    const std::array<int, 12> dofs = dofs_of(p, e);
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
  for (int row = std::max(j - 1, 0); row <= std::min(j, p.rows() - 2); ++row) {
    for (int column = std::max(i - 1, 0); column <= std::min(i, p.columns() - 2); ++column) {
      around.push_back(row * (p.columns() - 1) + column);
    }
  }
  return around;
}

/// What the elements around a dof need there, beyond the pressure on them.
double need_at(const plate& p, std::span<const double> pressure, std::span<const double> u, int node,
               int dof) {
  double need = 0.0;
  for (const int e : elements_around(p, node)) {
    const std::array<int, 4> corners = p.corners_of(e);
    const auto corner = std::find(corners.begin(), corners.end(), node) - corners.begin();
    const std::size_t own = 3 * corner + dof;
    const plate_element element = element_of(p, e);
    need += forces_at(element, displacement_of(p, e, u))[own];
    need -= pressure[e] * unit_pressure_on(element)[own];
  }
  return need;
}

}  // namespace

std::array<int, 4> plate::corners_of(int element) const {
  const int i = element % (columns() - 1);
  const int j = element / (columns() - 1);
  return {node_at(i, j), node_at(i + 1, j), node_at(i + 1, j + 1), node_at(i, j + 1)};
}

double plate::width_of(int element) const {
  const int i = element % (columns() - 1);
  return x[i + 1] - x[i];
}

double plate::height_of(int element) const {
  const int j = element / (columns() - 1);
  return y[j + 1] - y[j];
}

linear_structure build(const plate& p, std::span<const support> supports, std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = plate::dofs_per_node;
  s.stiffness = band_matrix(p.dofs(), 3 * (std::min(p.columns(), p.rows()) + 1) + 2);
  s.rows = rows_along_shorter_side(p);
  assemble_elements(p, s);
  s.rigid_motions = 3;
  s.rigid_rows = rigid_rows_of(p);
  put_on_supports(s, supports, std::move(pairs));
  return s;
}

void add_consistent_loads(const plate& p, const load& l, std::span<double> f) {
  add_point_loads(l, plate::dofs_per_node, f);
  const std::vector<double> pressure = pressures(p, l);
  for (int e = 0; e < p.elements(); ++e) {
    const element_vector12 unit = unit_pressure_on(element_of(p, e));
    const std::array<int, 12> dofs = dofs_of(p, e);
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
  for (const double height : along_y) {
    for (const double width : along_x) areas.push_back(width * height);
  }
  return areas;
}

}  // namespace contct::structure
