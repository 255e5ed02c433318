#include "contct/structure/beam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

#include "contct/structure/gauss.hpp"

namespace contct {
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

double value_of(std::span<const double> polynomial, double x) {
  double sum = 0.0;
  for (std::size_t i = polynomial.size(); i-- > 0;) sum = sum * x + polynomial[i];
  return sum;
}

/// Work of a distributed load on the four shape functions of one element.
element_vector consistent_load(std::span<const double> polynomial, double left, double h) {
  if (polynomial.size() == 1) {
    const double q = polynomial[0];
    return {q * h / 2, q * h * h / 12, q * h / 2, -q * h * h / 12};
  }
  element_vector f{};
  const int degree = static_cast<int>(polynomial.size()) - 1 + 3;
  for (const auto& [t, weight] : gauss_points(degree / 2 + 1)) {  // t from 0 to 1
    const double q = value_of(polynomial, left + t * h) * weight * h;
    f[0] += q * (1 - t) * (1 - t) * (1 + 2 * t);
    f[1] += q * h * t * (1 - t) * (1 - t);
    f[2] += q * t * t * (3 - 2 * t);
    f[3] -= q * h * t * t * (1 - t);
  }
  return f;
}

/// Call visit(element, load on it) for every element that the distributed loads touch.
template <class Visit>
void for_each_loaded_element(const beam& b, const load& l, Visit visit) {
  for (const distributed_load& d : l.distributed) {
    const auto one = [&](int e) {
      visit(e, consistent_load(d.polynomial, b.x[static_cast<std::size_t>(e)], b.length_of(e)));
    };
    if (d.elements.empty()) {
      for (int e = 0; e < b.elements(); ++e) one(e);
    } else {
      for (const int e : d.elements) one(e);
    }
  }
}

void assemble_elements(const beam& b, band_matrix& k) {
  for (int e = 0; e < b.elements(); ++e) {
    const std::array<double, 10> entries =
        stiffness_of_element(b.EI[static_cast<std::size_t>(e)], b.length_of(e));
    std::size_t next = 0;
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column <= row; ++column, ++next) {
        if (!std::isfinite(entries[next])) {
          throw std::invalid_argument("the stiffness of element " + std::to_string(e + 1) +
                                      " is not a finite number");
        }
        k.add(2 * e + row, 2 * e + column, entries[next]);
      }
    }
  }
}

/// A fixed dof keeps its place: its row and column become those of the identity.
void fix(band_matrix& k, int dof) {
  for (int i = std::max(0, dof - k.subdiagonals()); i <= std::min(k.order() - 1, dof + k.subdiagonals());
       ++i) {
    k.at(std::max(i, dof), std::min(i, dof)) = i == dof ? 1.0 : 0.0;
  }
}

/// What the beam's two rigid motions, up and turn, do at a dof of a node.
rigid_row rigid_row_at(const beam& b, int node, int dof) {
  const double half = (b.x.back() - b.x.front()) / 2;
  const double from_middle = (b.x[static_cast<std::size_t>(node)] - b.x.front()) / half - 1;
  return dof == 0 ? rigid_row{1, from_middle, 0} : rigid_row{0, 1, 0};
}

}  // namespace

linear_structure build(const beam& b, std::span<const support> supports, std::vector<contact_pair> pairs) {
  linear_structure s;
  s.dofs_per_node = beam::dofs_per_node;
  s.stiffness = band_matrix(b.dofs(), 3);
  s.fixed.assign(static_cast<std::size_t>(b.dofs()), 0);
  assemble_elements(b, s.stiffness);
  for (const support& p : supports) {
    const int dof = 2 * p.node + p.dof;
    if (p.fixed) {
      s.fixed[static_cast<std::size_t>(dof)] = 1;
    } else {
      s.stiffness.add(dof, dof, p.spring);
    }
  }
  for (int dof = 0; dof < b.dofs(); ++dof) {
    if (s.fixed[static_cast<std::size_t>(dof)] != 0) fix(s.stiffness, dof);
  }
  s.pairs = std::move(pairs);
  s.rigid_motions = 2;
  for (const support& p : supports) s.held_by_supports.push_back(rigid_row_at(b, p.node, p.dof));
  for (const contact_pair& p : s.pairs) s.held_by_pairs.push_back(rigid_row_at(b, p.node, 0));
  return s;
}

void add_consistent_loads(const beam& b, const load& l, std::span<double> f) {
  for (const point_load& p : l.points) f[static_cast<std::size_t>(2 * p.node + p.dof)] += p.value;
  for_each_loaded_element(b, l, [&](int e, const element_vector& q) {
    for (std::size_t i = 0; i < 4; ++i) f[2 * static_cast<std::size_t>(e) + i] += q[i];
  });
}

std::vector<element_forces> forces_in_elements(const beam& b, const load& l, std::span<const double> u) {
  std::vector<element_forces> forces(static_cast<std::size_t>(b.elements()));
  for (std::size_t e = 0; e < forces.size(); ++e) {
    // Rotations against the chord, so that a large rigid motion does not drown the bending.
    const double h = b.length_of(static_cast<int>(e));
    const double chord = (u[2 * e + 2] - u[2 * e]) / h;
    const double left = u[2 * e + 1] - chord;
    const double right = u[2 * e + 3] - chord;
    const double stiffness = 2 * b.EI[e] / h;
    const double m1 = stiffness * (2 * left + right);
    const double m2 = stiffness * (left + 2 * right);
    const double v = (m1 + m2) / h;
    forces[e] = {{v, v}, {-m1, m2}};
  }
  for_each_loaded_element(b, l, [&](int e, const element_vector& q) {
    element_forces& f = forces[static_cast<std::size_t>(e)];
    f.shear[0] -= q[0];
    f.moment[0] += q[1];
    f.shear[1] += q[2];
    f.moment[1] -= q[3];
  });
  return forces;
}

std::vector<double> reactions(const beam& b, const load& l, std::span<const support> supports,
                              std::span<const element_forces> forces, std::span<const double> u) {
  std::vector<double> points(static_cast<std::size_t>(b.dofs()), 0.0);
  for (const point_load& p : l.points) points[static_cast<std::size_t>(2 * p.node + p.dof)] += p.value;
  std::vector<double> values;
  std::set<int> reacted;
  for (const support& s : supports) {
    const auto dof = static_cast<std::size_t>(2 * s.node + s.dof);
    if (!s.fixed) {
      values.push_back(-s.spring * u[dof]);
      continue;
    }
    double reaction = 0.0;
    if (reacted.insert(static_cast<int>(dof)).second) {
      reaction = -points[dof];
      const auto n = static_cast<std::size_t>(s.node);
      if (s.node < b.elements()) reaction += s.dof == 0 ? forces[n].shear[0] : -forces[n].moment[0];
      if (s.node > 0) reaction += s.dof == 0 ? -forces[n - 1].shear[1] : forces[n - 1].moment[1];
    }
    values.push_back(reaction);
  }
  return values;
}

std::vector<double> tributary_lengths(const beam& b) {
  std::vector<double> lengths(b.x.size(), 0.0);
  for (int e = 0; e < b.elements(); ++e) {
    lengths[static_cast<std::size_t>(e)] += b.length_of(e) / 2;
    lengths[static_cast<std::size_t>(e) + 1] += b.length_of(e) / 2;
  }
  return lengths;
}

}  // namespace contct
