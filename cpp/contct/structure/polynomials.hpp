// Faces and loads that are polynomials in x along a beam, evaluated near each node and element: far from
// x = 0 their terms may cancel in every digit of a double.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "contct/structure/true_plate.hpp"

namespace contct::structure {

class exact_line;

/// The values of a polynomial in x at nodes of a beam, each rounded once.
[[nodiscard]] std::vector<numeric::double_double> values_at(const beam& b, std::span<const double> polynomial,
                                                            std::span<const int> nodes);

/// The coefficients of a distributed load, summed over its parts in the file, each rounded once.
[[nodiscard]] std::vector<numeric::double_double> long_polynomial_of(const distributed_load& d);

/// A distributed load on an element: a polynomial in t = (x - left) / h, from 0 to 1, constant first.
struct load_on_element {
  std::vector<numeric::double_double> q;
  double size = 0.0;  ///< each of q is off by at most 2^-89 of it
};

/// Distributed loads on a beam, about its elements.
class loads_on_elements {
 public:
  explicit loads_on_elements(const beam& b);

  [[nodiscard]] const long_line& line() const { return line_; }
  /// Visit every element, from 0, for every load that acts on it.
  void for_each(const load& l, const std::function<void(int, const load_on_element&)>& visit) const;

 private:
  long_line line_;
  std::shared_ptr<const exact_line> exactly_;
};

}  // namespace contct::structure
