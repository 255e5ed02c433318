// Element matrices without rounding.
#include <cmath>

#include "catch.hpp"
#include "contct/exact/lifted_solver.hpp"
#include "contct/structure/element_formulas.hpp"

using namespace contct::exact;
using namespace contct::structure::formulas;

namespace {

/// Work of the load q(x) on the element from `left` to left + h.
std::array<rational, 4> load_on(const vector& q, const rational& left, const rational& h) {
  return beam_load<rational>(in_element<rational>(q, left, h), h);
}

}  // namespace

TEST_CASE("a beam's element resists neither of its rigid motions, and bends as EI / h says") {
  const rational h(3, 7);
  const auto k = beam_stiffness(rational(5, 2), h);
  const std::array<std::array<rational, 4>, 3> motions = {{{1, 0, 1, 0}, {0, 1, h, 1}, {0, 1, 0, -1}}};
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<rational, 3> forces;
    for (std::size_t m = 0; m < 3; ++m)
      for (std::size_t j = 0; j < 4; ++j) forces[m] += k[i][j] * motions[m][j];
    CHECK(forces[0] == 0);
    CHECK(forces[1] == 0);
    const rational moment = 2 * rational(5, 2) / h;  // constant curvature -2 / h
    CHECK(forces[2] == (i == 1 ? moment : i == 3 ? rational(-moment) : rational(0)));
  }
}

TEST_CASE("a polynomial load does the work of its resultant on rigid motions, and exact work on a cubic") {
  const rational left(1, 3);
  const rational h(1, 2);
  const std::vector<rational> q = {2, -3, 5};
  const auto f = load_on(q, left, h);
  // The integral of x^n from left to left + h.
  const auto integral = [&](int n) {
    rational top = 1;
    rational bottom = 1;
    for (int i = 0; i <= n; ++i) {
      top *= left + h;
      bottom *= left;
    }
    return rational((top - bottom) / (n + 1));
  };
  const auto work = [&](int power) {  // of q on x^power
    return rational(2 * integral(power) - 3 * integral(power + 1) + 5 * integral(power + 2));
  };
  const rational right = left + h;
  CHECK(f[0] + f[2] == work(0));
  CHECK(f[0] * left + f[1] + f[2] * right + f[3] == work(1));
  CHECK(f[0] * left * left * left + f[1] * 3 * left * left + f[2] * right * right * right +
            f[3] * 3 * right * right ==
        work(3));
}

TEST_CASE("a uniform load has the consistent vector of the textbook") {
  const std::vector<rational> q = {12};
  CHECK(load_on(q, 5, 2) == std::array<rational, 4>{12, 4, 12, -4});
}

TEST_CASE("a plate's element is the one in doubles, without its rounding") {
  const auto exactly = plate_stiffness(rational(1, 4), rational(3, 8), rational(7, 2), rational(3, 10));
  const auto in_doubles = plate_stiffness(0.25, 0.375, 3.5, 0.3);
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < 12; ++j) {
      CHECK(exactly[i][j] == exactly[j][i]);
      CHECK(std::abs(rounded(exactly[i][j]) - in_doubles[i][j]) < 1e-11);
    }
  }
  const auto load = plate_unit_load(rational(1, 4), rational(3, 8));
  const auto load_in_doubles = plate_unit_load(0.25, 0.375);
  for (std::size_t i = 0; i < 12; ++i) CHECK(std::abs(rounded(load[i]) - load_in_doubles[i]) < 1e-15);
}

TEST_CASE("a plate's element resists none of its rigid motions") {
  const rational a(1, 3);
  const rational b(2, 5);
  const auto k = plate_stiffness(a, b, rational(1), rational(1, 5));
  for (std::size_t i = 0; i < 12; ++i) {
    rational up;
    rational about_y;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const int side = corner == 0 || corner == 3 ? -1 : 1;
      up += k[i][3 * corner];
      about_y += k[i][3 * corner] * side * a + k[i][3 * corner + 1];
    }
    CHECK(up == 0);
    CHECK(about_y == 0);
  }
}
