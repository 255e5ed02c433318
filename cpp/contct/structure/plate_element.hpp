// The Adini-Clough-Melosh rectangle: twelve dofs, after Melosh (1961, 1963) and Adini and Clough (1961).
#pragma once

#include <array>

#include "contct/rooms.hpp"

namespace contct::structure {

/// One number for each dof of an element: w, wx, wy at each corner, counter-clockwise from the lower left.
using element_vector12 = std::array<double, 12>;
using element_matrix12 = std::array<element_vector12, 12>;

/// An element of half width a (along x) and half height b.
struct plate_element {
  double a, b, D, nu;
};

/// The stiffness matrix, exactly integrated, in the plate's dofs.
[[nodiscard]] element_matrix12 stiffness_of(const plate_element& e);

/// Work of a unit pressure on the twelve shape functions.
[[nodiscard]] element_vector12 unit_pressure_on(const plate_element& e);

/// What the element's nodes need to be held at `u` [12]. Free of the element's rigid motion.
[[nodiscard]] element_vector12 forces_at(const plate_element& e, const element_vector12& u);

/// w_xx, w_yy, w_xy.
struct curvature {
  double xx, yy, xy;
};

/// Curvatures at the four corners under `u`. Free of the element's rigid motion.
[[nodiscard]] std::array<curvature, 4> curvatures_at_corners(const plate_element& e,
                                                             const element_vector12& u);

}  // namespace contct::structure
