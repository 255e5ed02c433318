#include "contct/exact/elements.hpp"

#include "contct/structure/element_formulas.hpp"

namespace contct::exact {

namespace formulas = structure::formulas;

std::array<std::array<rational, 4>, 4> beam_stiffness(const rational& EI, const rational& h) {
  return formulas::beam_stiffness(EI, h);
}

std::array<rational, 4> beam_load(std::span<const rational> polynomial, const rational& left,
                                  const rational& h) {
  return formulas::beam_load<rational>(formulas::in_element(polynomial, left, h), h);
}

std::array<vector12, 12> plate_stiffness(const rational& a, const rational& b, const rational& D,
                                         const rational& nu) {
  return formulas::plate_stiffness(a, b, D, nu);
}

vector12 plate_unit_load(const rational& a, const rational& b) {
  return formulas::plate_unit_load(a, b);
}

}  // namespace contct::exact
