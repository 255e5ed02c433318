#include <array>
#include <utility>

#include "contct/structure/problem.hpp"

namespace contct::structure {
namespace {

using element_vector = std::array<double, 4>;  // w, theta at the left end; w, theta at the right

/// Stiffness of a Hermite element of length h, lower triangle row by row.
std::array<double, 10> stiffness_of_element(double EI, double h) {
  const double k = EI / h / h / h;
  return {12 * k,                            // w1
          6 * k * h, 4 * k * h * h,          // theta1
          -12 * k,   -6 * k * h,    12 * k,  // w2
          6 * k * h, 2 * k * h * h, -6 * k * h, 4 * k * h * h};
}

/// Work of a distributed load on the four shape functions of one element.
element_vector consistent_load(const beam& b, int element, std::span<const double> polynomial) {
  const double left = b.x[element];
  const double h = b.length_of(element);
  if (polynomial.size() == 1) {
    const double q = polynomial[0];
    return {q * h / 2, q * h * h / 12, q * h / 2, -q * h * h / 12};
  }
  element_vector f{};
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

void assemble_elements(const beam& b, band_matrix& k) {
  for (int e = 0; e < b.elements(); ++e) {
    const std::array<double, 10> entries = stiffness_of_element(b.EI[e], b.length_of(e));
    const double* next = entries.data();
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column <= row; ++column) add_to_band(k, 2 * e + row, 2 * e + column, *next++, e);
  }
}

/// What the beam's two rigid motions do at each dof: up by 1, and a turn about the middle that lifts
/// the right end by 1.
std::vector<rigid_row> rigid_rows_of(const beam& b) {
  const double half = (b.x.back() - b.x.front()) / 2;
  std::vector<rigid_row> rows;
  rows.reserve(b.dofs());
  for (const double x : b.x) {
    rows.push_back({1, (x - b.x.front()) / half - 1, 0});
    rows.push_back({0, 1 / half, 0});
  }
  return rows;
}

}  // namespace

linear_structure build(const beam& b, std::span<const support> supports, std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = beam::dofs_per_node;
  s.stiffness = band_matrix(b.dofs(), 3);
  assemble_elements(b, s.stiffness.band());
  s.rigid_motions = 2;
  s.rigid_rows = rigid_rows_of(b);
  s.truth = std::make_shared<rigid_truth>(b);
  put_on_supports(s, supports, std::move(pairs));
  return s;
}

void add_consistent_loads(const beam& b, const load& l, std::span<double> f) {
  add_point_loads(l, beam::dofs_per_node, f);
  for_each_loaded_element(l, b.elements(), [&](int e, std::span<const double> polynomial) {
    const element_vector q = consistent_load(b, e, polynomial);
    for (int i = 0; i < 4; ++i) f[2 * e + i] += q[i];
  });
}

std::vector<element_forces> forces_in_elements(const beam& b, const load& l, std::span<const double> u) {
  std::vector<element_forces> forces(b.elements());
  for (std::size_t e = 0; e < forces.size(); ++e) {
    // Rotations relative to the chord: otherwise a large rigid motion cancels the digits of the bending.
    const double h = b.length_of(e);
    const double chord = (u[2 * e + 2] - u[2 * e]) / h;
    const double left = u[2 * e + 1] - chord;
    const double right = u[2 * e + 3] - chord;
    const double stiffness = 2 * b.EI[e] / h;
    const double m1 = stiffness * (2 * left + right);
    const double m2 = stiffness * (left + 2 * right);
    const double v = (m1 + m2) / h;
    forces[e] = {{v, v}, {-m1, m2}};
  }
  for_each_loaded_element(l, b.elements(), [&](int e, std::span<const double> polynomial) {
    const element_vector q = consistent_load(b, e, polynomial);
    element_forces& f = forces[e];
    f.shear[0] -= q[0];
    f.moment[0] += q[1];
    f.shear[1] += q[2];
    f.moment[1] -= q[3];
  });
  return forces;
}

std::vector<double> reactions(const beam& b, const load& l, std::span<const support> supports,
                              std::span<const double> u) {
  const std::vector<element_forces> forces = forces_in_elements(b, l, u);
  return reactions_of(supports, l, u, beam::dofs_per_node, [&](int node, int dof) {
    double need = 0.0;
    if (node < b.elements()) need += dof == 0 ? forces[node].shear[0] : -forces[node].moment[0];
    if (node > 0) need += dof == 0 ? -forces[node - 1].shear[1] : forces[node - 1].moment[1];
    return need;
  });
}

}  // namespace contct::structure
