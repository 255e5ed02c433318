#include "contct/proof/line_part.hpp"

#include "contct/structure/element_formulas.hpp"

namespace contct {

using poly = line_polynomial<double>;

poly rounded(std::span<const double_double> p) {
  poly r;
  for (const double_double& c : p) r.push_back(c.hi);
  return r;
}

hermite_part::hermite_part(const double_double& h, const double_double& from, const double_double& share,
                           std::size_t powers)
    : of_h(h), at(from), along(share) {
  const std::array<long_vector, 4> hermite = {
      {{1.0, 0.0, -3.0, 2.0}, {0.0, h, h * -2.0, h}, {0.0, 0.0, 3.0, -2.0}, {0.0, 0.0, -h, h}}};
  long_vector inverse;
  for (std::size_t i = 0; i < powers + 4; ++i)
    inverse.push_back(double_double(1.0) / (static_cast<int>(i) + 1));
  for (std::size_t i = 0; i < 4; ++i) {
    shapes[i] = formulas::in_element<double_double>(hermite[i], from, share);
    moments[i].resize(powers);
    for (std::size_t m = 0; m < powers; ++m)
      for (std::size_t k = 0; k < 4; ++k) moments[i][m] += shapes[i][k] * inverse[m + k];
  }
  for (std::size_t i = 0; i < 4; ++i) stiffness[i] = products(shapes[i]);
}

double hermite_part::product(std::size_t function, const poly& p) const {
  double sum = 0.0;
  for (std::size_t m = 0; m < p.size(); ++m) sum += p[m] * moments[function][m].hi;
  return sum;
}

poly line_part::depth(const bed_along& b) const {
  poly d = sum_of(w, rounded(b.face), -1.0);
  for (double& c : d) c *= b.surface;
  return d;
}

poly line_part::late() const {
  return sum_of(beyond, before, -1.0);
}

double line_part::modulus() const {
  double sum = 0.0;
  for (const bed_along& b : beds) sum += b.modulus.hi;
  return sum;
}

double line_element::modulus() const {
  double most = 0.0;
  for (const line_part& part : parts) most = std::max(most, part.modulus());
  return most;
}

}  // namespace contct
