// The matrices of single elements in rational numbers.
#pragma once

#include <array>
#include <span>

#include "contct/exact/lifted_solver.hpp"

namespace contct::exact {

/// Stiffness of a Hermite element of length h: w, theta at the left end; w, theta at the right.
[[nodiscard]] std::array<std::array<rational, 4>, 4> beam_stiffness(const rational& EI, const rational& h);

/// Work of the load q(x) = a0 + a1 x + .. on the shape functions of the element from `left` to left + h.
[[nodiscard]] std::array<rational, 4> beam_load(std::span<const rational> polynomial, const rational& left,
                                                const rational& h);

using vector12 = std::array<rational, 12>;

/// The Adini-Clough-Melosh rectangle of half width a and half height b: w, wx, wy at each corner,
/// counter-clockwise from the lower left.
[[nodiscard]] std::array<vector12, 12> plate_stiffness(const rational& a, const rational& b,
                                                       const rational& D, const rational& nu);

/// Work of a unit pressure on its shape functions.
[[nodiscard]] vector12 plate_unit_load(const rational& a, const rational& b);

}  // namespace contct::exact
