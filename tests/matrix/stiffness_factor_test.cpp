// One stiffness in two storages, factored by two libraries. Only where CHOLMOD is built in.
#include "contct/matrix/stiffness_factor.hpp"

#include "catch.hpp"
#include "contct/matrix/several_right_hand_sides.hpp"
#include "contct/matrix/supernodal_solve.hpp"
#include "contct/structure/assembled.hpp"
#include "support/matrices.hpp"

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

TEST_CASE("eight unit vectors go through either factor at once, and come out as one at a time") {
  for (const int order : {1, 9, 40, 300}) {
    const stiffness_matrix wide(
        random_band(order, std::min(order - 1, 12), static_cast<std::uint64_t>(order)));
    const stiffness_matrix narrow(columns_of(wide.band()));
    for (const stiffness_matrix* k : {&wide, &narrow}) {
      stiffness_factor f(*k);
      REQUIRE(f.factor({}));
      CHECK(f.flops() >= 0.0);
      const std::vector<int> rows = {0, order / 2, -1, order - 1, order / 3};
      std::vector<double> all;
      f.solve_units(rows, all);
      REQUIRE(all.size() == static_cast<std::size_t>(order) * side_by_side);
      for (std::size_t i = 0; i < side_by_side; ++i) {
        std::vector<double> one(static_cast<std::size_t>(order));
        const bool is_asked = i < rows.size() && rows[i] >= 0;
        if (is_asked) one[static_cast<std::size_t>(rows[i])] = 1.0;
        f.solve(one);
        for (std::size_t row = 0; row < one.size(); ++row)
          CHECK(all[row * side_by_side + i] == Approx(one[row]).epsilon(1e-12).margin(1e-15));
      }
    }
  }
}

TEST_CASE("supernodes of any width, with rows far below, are solved as the matrix that they make") {
  // Columns 0 and 1 with rows 0, 1, 3; column 2 with rows 2, 4; columns 3, 4.
  const std::vector<int> columns = {0, 2, 3, 5};
  const std::vector<int> row_places = {0, 3, 5, 7};
  const std::vector<int> entry_places = {0, 6, 8};
  const std::vector<int> rows = {0, 1, 3, 2, 4, 3, 4};
  const std::vector<double> entries = {2, 1, 3, 0, 4, 5, 6, 7, 8, 9, 0, 10};
  const double l[5][5] = {
      {2, 0, 0, 0, 0}, {1, 4, 0, 0, 0}, {0, 0, 6, 0, 0}, {3, 5, 0, 8, 0}, {0, 0, 7, 9, 10}};
  random_numbers random(8);
  std::vector<double> x(5 * side_by_side);
  for (double& entry : x) entry = random.unit() - 0.5;
  for (std::size_t i = 0; i < 5; ++i) x[i * side_by_side + 3] = 0.0;  // one right-hand side of nothing
  std::vector<double> b(x.size());
  for (std::size_t row = 0; row < 5; ++row)
    for (std::size_t column = 0; column < 5; ++column)
      for (std::size_t k = 0; k < 5; ++k)
        for (std::size_t i = 0; i < side_by_side; ++i)
          b[row * side_by_side + i] += l[row][k] * l[column][k] * x[column * side_by_side + i];
  solve_many({columns, row_places, entry_places, rows, entries}, b);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(b[i] == Approx(x[i]).epsilon(1e-12).margin(1e-13));
}

TEST_CASE("free motions are found without a band as with one") {
  assembled body;
  body.name = "K";
  body.stiffness = braced(box_at(0), 1e5);
  const std::vector<contact_pair> six = {{2, -1, 0, 1, true}, {5, -1, 0, 1, true}, {8, -1, 0, 1, true},
                                         {0, -1, 0, 1, true}, {6, -1, 0, 1, true}, {1, -1, 0, 1, true}};
  const std::vector<support> two_corners = {{0, 0, true}, {1, 0, true}, {2, 0, true}, {5, 0, true}};
  for (const auto& supports : {std::vector<support>{}, two_corners}) {
    body.as_band = true;
    const linear_structure wide = build(body, supports, six);
    body.as_band = false;
    const linear_structure narrow = build(body, supports, six);
    CHECK_FALSE(narrow.stiffness.is_band());
    CHECK(narrow.rigid_motions == wide.rigid_motions);
    CHECK(narrow.rigid_motions == (supports.empty() ? 6 : 2));
    CHECK(narrow.rigid_rounding < 1e-6);
    rigid_rank rank = narrow.nothing_held();
    for (const rigid_row& row : narrow.held_by_pairs) rank.hold(row);
    CHECK(rank.rank() == narrow.rigid_motions);
  }
  body.stiffness.entries.front().value = -1e5;
  CHECK_THROWS_WITH(build(body, {}, {}), Catch::Matchers::Contains("K: "));
}
