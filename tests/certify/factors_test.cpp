// Tests factors in 32 digits, and upper bounds on the errors of factors.
#include "contct/certify/factors.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

/// Returns two springs of stiffness 1 in series, and a softer spring to the ground that doubles cannot hold.
long_band springs_in_line(double soft) {
  long_band a(3, 1);
  a.at(0, 0) = 1.0;
  a.at(1, 0) = -1.0;
  a.at(1, 1) = 2.0;
  a.at(2, 1) = -1.0;
  a.at(2, 2) = double_double(1.0) + soft;
  return a;
}

/// Returns the largest row sum of |A - L L'|, computed in long double.
double largest_row(const sparse_columns& a, const sparse_columns& l) {
  const int n = a.order();
  std::vector<std::vector<long double>> all(n, std::vector<long double>(n));
  std::vector<std::vector<long double>> dense(n, std::vector<long double>(n));
  for (int column = 0; column < n; ++column) {
    for (int at = a.starts[column]; at < a.starts[column + 1]; ++at)
      all[a.rows[at]][column] = all[column][a.rows[at]] = a.values[at];
    for (int at = l.starts[column]; at < l.starts[column + 1]; ++at) dense[l.rows[at]][column] = l.values[at];
  }
  long double largest = 0;
  for (int i = 0; i < n; ++i) {
    long double sum = 0;
    for (int j = 0; j < n; ++j) {
      long double entry = all[i][j];
      for (int k = 0; k < n; ++k) entry -= dense[i][k] * dense[j][k];
      sum += std::abs(entry);
    }
    largest = std::max(largest, sum);
  }
  return static_cast<double>(largest);
}

/// Returns a lower triangle L for which L L' is far from K.
sparse_columns lower_of(const band_matrix& k) {
  sparse_columns l = columns_of(k);
  for (double& x : l.values) x = std::sin(37 * x);
  return l;
}

}  // namespace

TEST_CASE(
    "a positive definite matrix 2^-90 from singular has a factor in 32 digits, and an indefinite one has "
    "none") {
  long_band l = springs_in_line(0x1p-90);
  REQUIRE(factor(l));
  std::vector<double_double> x = {1.0, 0.0, 0.0};
  solve_with(l, x);
  CHECK(x[2].hi == Approx(0x1p90).epsilon(1e-4));
  CHECK((x[0] - x[1]).hi == Approx(1.0).epsilon(1e-3));

  CHECK(suspect_in(l)[2] == double_double(0.0));

  const long_band indefinite = springs_in_line(-0x1p-90);
  long_band failed = indefinite;
  REQUIRE_FALSE(factor(failed));
  x = suspect_in(failed);  // a displacement with negative work of the springs
  double_double work;
  for (int i = 0; i < 3; ++i)
    for (int j = std::max(0, i - 1); j <= i; ++j)
      work += (i == j ? 1 : 2) * indefinite.at(i, j) * x[i] * x[j];
  CHECK(work.hi == Approx(-0x1p-90).epsilon(1e-4));
}

TEST_CASE(
    "the error bound of a correct factor in 32 digits is below 2^-88, and a wrong entry increases the "
    "bound") {
  const long_band a = springs_in_line(0x1p-60);
  long_band l = a;
  REQUIRE(factor(l));
  const double error = largest_row_of_error(a, l, 0.0);
  CHECK(error > 0.0);
  CHECK(error < 0x1p-88);
  CHECK(largest_row_of_error(a, l, 0x1p-80) >= 3 * 0x1p-80);

  l.at(2, 1) += 0x1p-70;  // a wrong entry
  CHECK(largest_row_of_error(a, l, 0.0) > 0x1p-71);
  l.at(2, 1) = std::nan("");
  CHECK(std::isinf(largest_row_of_error(a, l, 0.0)));
}

TEST_CASE(
    "factor and solution of a band matrix are correct for any bandwidth, also in the first and last rows") {
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

TEST_CASE(
    "the bound on the largest row sum of the error of a factor exceeds the true row sum only by rounding") {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const sparse_columns a = columns_of(random_band(40, 7, seed));
    const sparse_columns l = lower_of(random_band(40, 11, seed + 10));  // L has entries at zeros of A
    const double bound = largest_row_of_error(a, l);
    CHECK(bound >= largest_row(a, l));
    CHECK(bound <= largest_row(a, l) * (1 + 1e-9));
  }
}

TEST_CASE(
    "the error bound is only rounding for an exact factor, and larger for a factor with a relative error of "
    "1e-9") {
  // L has ones on and below its diagonal, so A_ij = 1 + min(i, j) exactly.
  constexpr int n = 6;
  sparse_columns l;
  sparse_columns a;
  for (int column = 0; column < n; ++column) {
    for (int row = column; row < n; ++row) {
      l.rows.push_back(row);
      l.values.push_back(1.0);
      a.rows.push_back(row);
      a.values.push_back(1.0 + column);
    }
    l.starts.push_back(static_cast<int>(l.rows.size()));
    a.starts.push_back(static_cast<int>(a.rows.size()));
  }
  const double rounding = largest_row_of_error(a, l);
  CHECK(rounding > 0.0);
  CHECK(rounding < 1e-13);
  l.values[1] += 1e-9;  // row 1 of column 0 affects all later rows
  CHECK(largest_row_of_error(a, l) >= largest_row(a, l));
  CHECK(largest_row_of_error(a, l) > 6e-9);
}

TEST_CASE("if an entry of a factor is NaN, the error bound of the factor is infinite") {
  const sparse_columns a = columns_of(random_band(9, 3, 7));
  sparse_columns l = a;
  l.values[l.starts[4]] = std::nan("");
  CHECK(std::isinf(largest_row_of_error(a, l)));
}
