// What is left of a load, without rounding.
#include "contct/exact/exact_residual.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct::exact;
using contct::numeric::double_double;

namespace {

double_double rounded_to_32_digits(const rational& x) {
  const double high = rounded(x);
  return {high, rounded(rational(x - binary_value(high)))};
}

}  // namespace

TEST_CASE(
    "at the exact end of a step nothing is left but the rounding of u, and at a fixed dof the reaction") {
  const contct::structure::problem p =
      contct::read::read_problem(CONTCT_REFEREE_PROBLEMS "/graded-mesh.toml");
  const exact_path path = follow_true_path(exact_problem_of(p));
  const auto residual = exact_residual_of(p);
  int checked = 0;
  for (int step = 1; step <= 2; ++step) {
    std::vector<double_double> u;
    for (const rational& x : path.steps[static_cast<std::size_t>(step) - 1].displacement)
      u.push_back(rounded_to_32_digits(x));
    const auto needed = residual(step, u);
    REQUIRE(needed);
    REQUIRE(needed->size() == u.size());
    const vector& reactions = path.steps[static_cast<std::size_t>(step) - 1].reactions;
    CHECK((*needed)[0].hi == Approx(rounded(reactions[0])).epsilon(1e-12));
    for (std::size_t dof = 2; dof < u.size(); ++dof, ++checked)
      CHECK(std::abs((*needed)[dof].hi) < 1e-12);  // 12 EI / h^3 is 1e17 here, times 2^-106
  }
  CHECK(checked == 20);
}

TEST_CASE("a displacement is seen to its 32nd digit, and so is the side of a face that it is on") {
  const contct::structure::problem p =
      contct::read::read_problem(CONTCT_REFEREE_PROBLEMS "/stiff-pair-at-its-face.toml");
  const auto residual = exact_residual_of(p);
  const rational face = decimal_of(-7.6e-12);
  const rational h = decimal_of(8e-11);
  const rational bends = 12 * decimal_of(7e-4) / (h * h * h);
  const double_double near = rounded_to_32_digits(face);
  for (const double off : {-0x1p-138, 0x1p-138}) {  // some tenths of its last digit
    std::vector<double_double> u(6, 0.0);
    u[4] = {near.hi, near.lo + off};
    const rational at = binary_value(u[4].hi) + binary_value(u[4].lo);
    const rational pressed = at < face ? rational(decimal_of(7.8e44) * (at - face)) : rational(0);
    const double expected = rounded(rational(bends * at + pressed));
    CHECK((*residual(1, u))[4].hi == expected);
    CHECK((at < face) == (off < 0));
  }
}

TEST_CASE("a residual beyond doubles is infinite, and there is none of displacements that are no numbers") {
  const contct::structure::problem p =
      contct::read::read_problem(CONTCT_REFEREE_PROBLEMS "/stiff-pair-at-its-face.toml");
  const auto residual = exact_residual_of(p);
  std::vector<double_double> u(6, 0.0);
  u[4] = 1e300;
  const auto needed = residual(1, u);
  REQUIRE(needed);
  CHECK(std::isinf((*needed)[4].hi));
  CHECK((*needed)[4].lo == 0.0);
  for (const double odd : {HUGE_VAL, std::nan("")}) {
    u[4] = odd;
    CHECK_FALSE(residual(1, u));
  }
}
