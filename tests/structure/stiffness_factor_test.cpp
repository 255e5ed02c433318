// One stiffness in two storages, factored by two libraries. Only where CHOLMOD is built in.
#include "contct/structure/stiffness_factor.hpp"

#include "catch.hpp"
#include "structure/matrices.hpp"

using namespace contct;

TEST_CASE("K with springs is solved alike by LAPACK as a band and by CHOLMOD as it is") {
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
  CHECK_THROWS_AS(by_entries.band(), std::logic_error);
}

TEST_CASE("a matrix that is not positive definite has no factor in either storage") {
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
  CHECK(f.factor(enough));  // and the failure leaves nothing behind
}
