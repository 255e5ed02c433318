// A factor in 32 digits.
#include "contct/certify/long_factor.hpp"

#include <cmath>

#include "catch.hpp"

using namespace contct::certify;
using contct::numeric::double_double;

namespace {

/// Two stiff springs in line and a soft one to the ground, 1 to 2^-90: in doubles the soft one is lost.
long_band springs_in_line(double soft) {
  long_band a(3, 1);
  a.at(0, 0) = 1.0;
  a.at(1, 0) = -1.0;
  a.at(1, 1) = 2.0;
  a.at(2, 1) = -1.0;
  a.at(2, 2) = double_double(1.0) + soft;
  return a;
}

}  // namespace

TEST_CASE("what is 2^-90 from singular is factored and solved for, and what is as far beyond is not") {
  long_band l = springs_in_line(0x1p-90);
  REQUIRE(factor(l));
  std::vector<double_double> x = {1.0, 0.0, 0.0};
  solve_with(l, x);
  CHECK(x[2].hi == Approx(0x1p90).epsilon(1e-4));
  CHECK((x[0] - x[1]).hi == Approx(1.0).epsilon(1e-3));

  long_band indefinite = springs_in_line(-0x1p-90);
  CHECK_FALSE(factor(indefinite));
}

TEST_CASE("the error of a factor is bounded from above, to its rounding") {
  const long_band a = springs_in_line(0x1p-60);
  long_band l = a;
  REQUIRE(factor(l));
  const double error = largest_row_of_error(a, l, 0.0);
  CHECK(error > 0.0);
  CHECK(error < 0x1p-88);
  CHECK(largest_row_of_error(a, l, 0x1p-80) >= 3 * 0x1p-80);

  l.at(2, 1) += 0x1p-70;  // an entry that is off
  CHECK(largest_row_of_error(a, l, 0.0) > 0x1p-71);
  l.at(2, 1) = std::nan("");
  CHECK(std::isinf(largest_row_of_error(a, l, 0.0)));
}

TEST_CASE("rows of a wide band lose nothing at its edges") {
  const int n = 40;
  for (const int b : {0, 1, 5, 39}) {
    long_band a(n, b);
    for (int i = 0; i < n; ++i)
      for (int j = a.first(i); j <= i; ++j) a.at(i, j) = i == j ? 1.0 : 0.5 / (b + 1) / (1 + i - j);
    long_band l = a;
    REQUIRE(factor(l));
    CAPTURE(b);
    CHECK(largest_row_of_error(a, l, 0.0) < (2 * b + 2) * (b + 8) * 0x1p-97);
    std::vector<double_double> x(n);
    for (int i = 0; i < n; ++i) x[i] = i + 1;
    const std::vector<double_double> given = x;
    solve_with(l, x);
    for (int i = 0; i < n; ++i) {
      double_double back;
      for (int j = 0; j < n; ++j) {
        const int row = std::max(i, j);
        const int column = std::min(i, j);
        if (row - column <= b) back += a.at(row, column) * x[j];
      }
      CHECK(std::abs((back - given[i]).hi) < 0x1p-90);
    }
  }
  CHECK(can_be_factored_long(100'000, 3));
  CHECK_FALSE(can_be_factored_long(10'000, 100));
}
