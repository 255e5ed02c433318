// Faces and loads that are polynomials in x along a beam, evaluated near each node and element: far from
// x = 0 their terms may cancel in every digit of a double.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "contct/structure/line.hpp"

namespace contct::structure {

/// The values of a polynomial in x at nodes of a beam, each rounded once; rational ones are exact.
template <class Number>
[[nodiscard]] std::vector<Number> values_at(const beam& b, std::span<const double> polynomial,
                                            std::span<const int> nodes);
template <>
[[nodiscard]] std::vector<double> values_at(const beam& b, std::span<const double> polynomial,
                                            std::span<const int> nodes);
template <>
[[nodiscard]] std::vector<numeric::double_double> values_at(const beam& b, std::span<const double> polynomial,
                                                            std::span<const int> nodes);

/// A distributed load on an element: a polynomial in t = (x - left) / h, from 0 to 1, constant first.
template <class Number>
struct load_on_element {
  std::vector<Number> q;
  double size = 0.0;  ///< each of q is off by at most 2^-89 of it
};

/// Visit every element, from 0, for every load that acts on it.
template <class Number>
using load_visitor = std::function<void(int element, const load_on_element<Number>&)>;

/// Distributed loads on a beam whose nodes are those of `x`, about its elements. In pairs of doubles and in
/// rational numbers.
template <class Number>
void for_each_polynomial(const line<Number>& x, const load& l, const load_visitor<Number>& visit);
template <>
void for_each_polynomial(const line<numeric::double_double>& x, const load& l,
                         const load_visitor<numeric::double_double>& visit);

}  // namespace contct::structure
