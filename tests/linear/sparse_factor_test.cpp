// Tests that a band factored by LAPACK and sparse columns factored by CHOLMOD agree; compiled only with
// CHOLMOD.
#include "contct/linear/sparse_factor.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "catch.hpp"
#include "support/matrices.hpp"

using namespace contct;

TEST_CASE("the product of the sparse factor and its transpose is the matrix in the factor's row order") {
  constexpr int unknowns = 40;
  const band_matrix k = random_band(unknowns, 7, 4);
  const auto f = sparse_factor::make(columns_of(k));
  REQUIRE(f->factor(columns_of(k)));
  const sparse_columns l = f->lower();
  REQUIRE(l.order() == unknowns);
  std::vector<std::vector<double>> product(unknowns, std::vector<double>(unknowns));
  for (int column = 0; column < unknowns; ++column) {
    const auto first = l.rows.begin() + l.starts[column];
    CHECK(*first == column);
    CHECK(std::is_sorted(first, l.rows.begin() + l.starts[column + 1]));
    for (int i = l.starts[column]; i < l.starts[column + 1]; ++i)
      for (int j = l.starts[column]; j < l.starts[column + 1]; ++j)
        product[l.rows[i]][l.rows[j]] += l.values[i] * l.values[j];
  }
  const std::vector<int>& places = f->places();
  for (int row = 0; row < unknowns; ++row)
    for (int column = std::max(0, row - 7); column <= row; ++column)
      CHECK(product[places[row]][places[column]] == Approx(k.at(row, column)).margin(1e-13));
}

TEST_CASE("CHOLMOD factors a matrix without creating OpenMP threads") {
  const auto threads = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
  };
  const band_matrix k = random_band(3000, 20, 5);
  const auto f = sparse_factor::make(columns_of(k));
  const std::ptrdiff_t before = threads();
  REQUIRE(before >= 1);
  REQUIRE(f->factor(columns_of(k)));
  CHECK(threads() == before);
}

TEST_CASE("K with springs has the same solution with LAPACK as a band and with CHOLMOD in sparse storage") {
  const stiffness_matrix wide(random_band(40, 7, 3)), narrow(columns_of(wide.band()));
  stiffness_factor by_band(wide), by_entries(narrow);
  const std::vector<spring_at> no_springs, springs = {{4, 2.0}, {4, 1.0}, {30, 500.0}};
  for (const auto& s : {no_springs, springs, no_springs}) {
    REQUIRE(by_band.factor(s));
    REQUIRE(by_entries.factor(s));
    std::vector<double> x = random_vector(40, 9), y = x;
    by_band.solve(x);
    by_entries.solve(y);
    for (std::size_t i = 0; i < x.size(); ++i) CHECK(y[i] == Approx(x[i]).epsilon(1e-12).margin(1e-14));
    const double rcond = by_band.reciprocal_condition(s);
    CHECK(rcond > 0.0);
    CHECK(by_entries.reciprocal_condition(s) == Approx(rcond).epsilon(1e-9));
  }
  CHECK(by_entries.reciprocal_condition(springs) != Approx(by_entries.reciprocal_condition(no_springs)));
}

TEST_CASE("a matrix that is not positive definite cannot be factored, as a band or in sparse storage") {
  band_matrix k = random_band(40, 7, 5);
  k.at(20, 20) = -1.0;
  for (const stiffness_matrix& stored : {stiffness_matrix(k), stiffness_matrix(columns_of(k))}) {
    stiffness_factor f(stored);
    CHECK_FALSE(f.factor({}));
    CHECK(f.reciprocal_condition({}) == 0.0);
    CHECK(f.factor(std::vector<spring_at>{{20, 10.0}}));  // the failed factorisation has no effect
  }
}

TEST_CASE("LAPACK and CHOLMOD solve several right-hand sides at once with the same result as one by one") {
  for (const int n : {1, 9, 40, 300}) {
    const band_matrix band = random_band(n, std::min(n - 1, 12), n);
    for (const stiffness_matrix& k : {stiffness_matrix(band), stiffness_matrix(columns_of(band))}) {
      stiffness_factor f(k);
      REQUIRE(f.factor({}));
      CHECK(f.flops() >= 0.0);
      const std::vector<double> given = random_vector(5 * n, 8);
      std::vector<double> all = given;
      f.solve(all);
      for (std::ptrdiff_t i = 0; i < 5; ++i) {
        std::vector<double> one(given.begin() + i * n, given.begin() + (i + 1) * n);
        f.solve(one);
        for (int row = 0; row < n; ++row)
          CHECK(all[i * n + row] == Approx(one[row]).epsilon(1e-12).margin(1e-15));
      }
    }
  }
}
