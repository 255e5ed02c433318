// Rectangular Kirchhoff plates of Adini-Clough-Melosh elements: three dofs a node, the deflection w
// (up) and the slopes wx = dw/dx, wy = dw/dy.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contct/structure/load.hpp"
#include "contct/structure/structure.hpp"

namespace contct::structure {

/// A plate on a grid of lines. Everything counts from 0: grid point (i, j), at x[i] and y[j], is node
/// j * columns + i; the element with its lower left corner there is element j * (columns - 1) + i.
struct plate {
  std::vector<double> x;  ///< grid lines, strictly increasing, at least two
  std::vector<double> y;  ///< the same
  double D = 0.0;         ///< bending stiffness E t^3 / 12 (1 - nu^2), positive
  double nu = 0.0;        ///< Poisson's ratio, above -1 and at most 0.5

  static constexpr int dofs_per_node = 3;
  static constexpr std::array<const char*, 3> dof_names = {"w", "wx", "wy"};
  [[nodiscard]] int columns() const { return static_cast<int>(x.size()); }
  [[nodiscard]] int rows() const { return static_cast<int>(y.size()); }
  [[nodiscard]] int nodes() const { return columns() * rows(); }
  [[nodiscard]] int elements() const { return (columns() - 1) * (rows() - 1); }
  [[nodiscard]] int dofs() const { return nodes() * dofs_per_node; }
  [[nodiscard]] int node_at(int i, int j) const { return j * columns() + i; }
  /// An element's corners, counter-clockwise from the lower left: (i, j), (i+1, j), (i+1, j+1), (i, j+1).
  [[nodiscard]] std::array<int, 4> corners_of(int element) const;
  [[nodiscard]] double width_of(int element) const;   ///< along x
  [[nodiscard]] double height_of(int element) const;  ///< along y
};

/// D of a plate of Young's modulus E, Poisson's ratio nu and thickness t.
[[nodiscard]] inline double bending_stiffness(double E, double nu, double t) {
  return E * t * t * t / 12 / (1 - nu * nu);
}

/// Bending and twisting moments per length at an element's corners, in the order of corners_of:
///     M_x = D (w_xx + nu w_yy),  M_y = D (w_yy + nu w_xx),  M_xy = D (1 - nu) w_xy.
/// M_x bends the plate along x, as a beam's moment EI w'' does, and like it is positive when the plate
/// sags; so is M_y along y. M_xy is positive where dw/dy grows with x. Elements that meet at a node
/// each have their own value there; the differences go with the mesh.
struct corner_moments {
  std::array<double, 4> mx, my, mxy;
};

/// Assemble the plate on its supports, numbered along its shorter side (linear_structure::rows).
/// Throws std::invalid_argument when an entry of the stiffness matrix is not a finite number, naming
/// the element (from 1).
[[nodiscard]] linear_structure build(const plate& p, std::span<const support> supports,
                                     std::vector<contact_pair> pairs);

/// Add the consistent load vector of `l` to `f` [dofs]. Throws std::invalid_argument for a distributed
/// load that is not constant.
void add_consistent_loads(const plate& p, const load& l, std::span<double> f);

/// Moments at the corners of every element, under displacement `u` [dofs].
[[nodiscard]] std::vector<corner_moments> moments_in_elements(const plate& p, std::span<const double> u);

/// The force (or moment) on the structure by each support: see reactions_of.
[[nodiscard]] std::vector<double> reactions(const plate& p, const load& l, std::span<const support> supports,
                                            std::span<const double> u);

/// Tributary area of each node: a quarter of each element beside it [nodes].
[[nodiscard]] std::vector<double> tributary_shares(const plate& p);

}  // namespace contct::structure
