// Straight beams of Hermite elements: two dofs a node, w (up) and theta = dw/dx.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "contct/structure/load.hpp"
#include "contct/structure/structure.hpp"

namespace contct::structure {

/// The geometry and stiffness of a beam.
struct beam {
  std::vector<double> x;   ///< node coordinates, strictly increasing [nodes]
  std::vector<double> EI;  ///< bending stiffness of each element, positive [nodes - 1]

  static constexpr int dofs_per_node = 2;
  static constexpr std::array<const char*, 2> dof_names = {"w", "theta"};
  [[nodiscard]] int nodes() const { return static_cast<int>(x.size()); }
  [[nodiscard]] int elements() const { return nodes() - 1; }
  [[nodiscard]] int dofs() const { return nodes() * dofs_per_node; }
  [[nodiscard]] double length_of(std::size_t element) const { return x[element + 1] - x[element]; }
};

/// What an engineer reads off an element, at its left and right ends.
/// Moment M = EI w'': positive when the beam sags. Shear V = dM/dx = EI w''': the upward force
/// that the part of the beam on the left of a cut exerts on the part on the right.
struct element_forces {
  double shear[2];
  double moment[2];
};

/// Assemble the beam on its supports. Throws std::invalid_argument when an entry of the stiffness
/// matrix is not a finite number, naming the element (from 1).
[[nodiscard]] linear_structure build(const beam& b, std::span<const support> supports,
                                     std::vector<contact_pair> pairs);

/// Add the consistent load vector of `l` to `f` [dofs].
void add_consistent_loads(const beam& b, const load& l, std::span<double> f);

/// Shear and moment at the ends of every element, under displacement `u` [dofs] and load `l`.
[[nodiscard]] std::vector<element_forces> forces_in_elements(const beam& b, const load& l,
                                                             std::span<const double> u);

/// The force (or moment) on the structure by each support: see reactions_of.
[[nodiscard]] std::vector<double> reactions(const beam& b, const load& l, std::span<const support> supports,
                                            std::span<const double> u);

/// Tributary length of each node [nodes].
[[nodiscard]] std::vector<double> tributary_shares(const beam& b);

}  // namespace contct::structure
