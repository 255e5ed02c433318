// The elements of a bed_line, and their parts, along which loads, beds and faces are polynomials.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "contct/proof/long_system.hpp"
#include "contct/proof/polynomial_bounds.hpp"
#include "contct/structure/placed_loads.hpp"

namespace contct {

/// a + share b.
template <class Polynomial, class Number>
Polynomial sum_of(const Polynomial& a, const Polynomial& b, const Number& share) {
  Polynomial sum = a;
  sum.resize(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < b.size(); ++i) sum[i] += b[i] * share;
  return sum;
}

[[nodiscard]] line_polynomial<double> rounded(std::span<const double_double> p);

/// A bed along a part of an element.
struct bed_along {
  std::size_t bed;  ///< from 0
  int surface;
  double_double modulus;
  long_vector face;                      ///< a polynomial
  std::array<double_double, 4> of_face;  ///< hermite_part::products of the face
  stretch pressed = {};                  ///< the whole part if P has the pressure of the bed, otherwise empty
  stretch certain = {};                  ///< in the set A: where the bed certainly presses
};

/// Hermite's functions of an element of length h, as polynomials in s, from 0 to 1 along a part of the
/// element, and integrals over s of their products.
struct hermite_part {
  hermite_part(const double_double& h, const double_double& from, const double_double& share,
               std::size_t powers);

  /// The integral of each function times the polynomial p.
  template <class Polynomial>
  [[nodiscard]] std::array<double_double, 4> products(const Polynomial& p) const {
    std::array<double_double, 4> all;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t m = 0; m < p.size(); ++m) all[i] += p[m] * moments[i][m];
    return all;
  }
  /// The same of one function, rounded.
  [[nodiscard]] double product(std::size_t function, const line_polynomial<double>& p) const;

  double_double of_h, at, along;
  std::array<long_vector, 4> shapes, moments;  ///< moments[i][m]: the integral of function i times s^m
  std::array<std::array<double_double, 4>, 4> stiffness;  ///< the integrals of products of two functions
};

/// A part of an element along which load, beds and faces are polynomials in s, from 0 to 1.
// NOLINTNEXTLINE(bugprone-exception-escape): moving numbers throws nothing
struct line_part {
  element_piece load;
  double_double from, share;  ///< its left end and its length, as shares of the element's length
  std::shared_ptr<const hermite_part> hermite;
  std::vector<bed_along> beds = {};
  line_polynomial<double> before = {};                      ///< b of the pass before, from which P is made
  line_polynomial<double> pressure = {};                    ///< P, upward, rounded
  line_polynomial<double> beyond = {};                      ///< b, rounded
  line_polynomial<double> w = {}, moment = {}, shear = {};  ///< of w1, rounded
  double slack = 0.0;       ///< a bound on the rounding of w, of w_I and of faces
  double slack_of_b = 0.0;  ///< the same of b, and of faces in 32 digits
  double off = 0.0;         ///< a bound on |r|

  /// n (w1 - c) of a bed.
  [[nodiscard]] line_polynomial<double> depth(const bed_along& b) const;
  /// b - `before`.
  [[nodiscard]] line_polynomial<double> late() const;
  /// The sum of the moduli of all beds.
  [[nodiscard]] double modulus() const;
};

struct line_element {
  std::array<int, 4> dofs;
  double_double h, EI;
  std::array<double_double, 4> work;  ///< of the loads on Hermite's functions
  std::vector<line_part> parts = {};
  double slack = 0.0;  ///< a bound on the rounding of moments and, divided by h, of shears

  /// The largest sum of moduli of a part.
  [[nodiscard]] double modulus() const;
};

}  // namespace contct
