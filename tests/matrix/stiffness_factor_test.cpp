// Tests that a band factored by LAPACK and sparse columns factored by CHOLMOD agree; compiled only with
// CHOLMOD.
#include "catch.hpp"
#include "contct/matrix/cholesky.hpp"
#include "support/matrices.hpp"

using namespace contct;

TEST_CASE("K with springs has the same solution with LAPACK as a band and with CHOLMOD in sparse storage") {
  const stiffness_matrix wide(random_band(40, 7, 3));
  const stiffness_matrix narrow(columns_of(wide.band()));
  stiffness_factor by_band(wide);
  stiffness_factor by_entries(narrow);
  const std::vector<spring_at> no_springs;
  const std::vector<spring_at> springs = {{4, 2.0}, {4, 1.0}, {30, 500.0}};
  for (const auto& s : {no_springs, springs, no_springs}) {
    REQUIRE(by_band.factor(s));
    REQUIRE(by_entries.factor(s));
    std::vector<double> x = random_vector(40, 9);
    std::vector<double> y = x;
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
  const stiffness_matrix wide(k);
  CHECK_FALSE(stiffness_factor(wide).factor({}));
  CHECK(stiffness_factor(wide).reciprocal_condition({}) == 0.0);
  const stiffness_matrix narrow(columns_of(k));
  stiffness_factor f(narrow);
  CHECK_FALSE(f.factor({}));
  CHECK(f.reciprocal_condition({}) == 0.0);
  const std::vector<spring_at> enough = {{20, 10.0}};
  CHECK(f.factor(enough));  // the failed factorisation has no effect
}

TEST_CASE("LAPACK and CHOLMOD solve several right-hand sides at once with the same result as one by one") {
  for (const int order : {1, 9, 40, 300}) {
    const auto n = static_cast<std::size_t>(order);
    const stiffness_matrix wide(
        random_band(order, std::min(order - 1, 12), static_cast<std::uint64_t>(order)));
    const stiffness_matrix narrow(columns_of(wide.band()));
    for (const stiffness_matrix* k : {&wide, &narrow}) {
      stiffness_factor f(*k);
      REQUIRE(f.factor({}));
      CHECK(f.flops() >= 0.0);
      std::vector<double> all = random_vector(5 * order, 8);
      const std::vector<double> given = all;
      f.solve(all);
      for (std::size_t i = 0; i < 5; ++i) {
        const auto begin = given.begin() + static_cast<std::ptrdiff_t>(i * n);
        std::vector<double> one(begin, begin + order);
        f.solve(one);
        for (std::size_t row = 0; row < n; ++row)
          CHECK(all[i * n + row] == Approx(one[row]).epsilon(1e-12).margin(1e-15));
      }
    }
  }
}
