// One stiffness in two storages: what is asked of it has the same answer.
#include "contct/matrix/stiffness_matrix.hpp"

#include "catch.hpp"
#include "support/matrices.hpp"

using namespace contct::app;

namespace {

constexpr int order = 40;
constexpr int subdiagonals = 7;

std::vector<long double> minus_product(const stiffness_matrix& k, std::span<const double> x) {
  std::vector<long double> r(x.size());
  k.subtract_product(x, r);
  return r;
}

}  // namespace

TEST_CASE("a band and its entries alone are one matrix, to the bit") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const band_matrix band = random_band(order, subdiagonals, seed);
    stiffness_matrix wide(band);
    stiffness_matrix narrow(columns_of(band));
    CHECK(wide.is_band());
    CHECK_FALSE(narrow.is_band());
    CHECK(narrow.columns().values.size() < static_cast<std::size_t>(order * (subdiagonals + 1)) * 2 / 3);
    const std::vector<double> x = random_vector(order, seed + 100);
    const auto compare = [&] {
      REQUIRE(narrow.order() == wide.order());
      for (int row = 0; row < order; ++row) CHECK(narrow.diagonal(row) == wide.diagonal(row));
      CHECK(minus_product(narrow, x) == minus_product(wide, x));
    };
    compare();
    std::vector<char> fixed(order);
    fixed[0] = fixed[11] = fixed[order - 1] = 1;
    for (stiffness_matrix* k : {&wide, &narrow}) {
      k->add_to_diagonal(5, 2.5);
      k->fix(fixed);
    }
    compare();
    CHECK(minus_product(narrow, x)[11] == -static_cast<long double>(x[11]));
    std::vector<double> d = random_vector(order, seed + 200);
    for (double& entry : d) entry += 1.0;
    for (stiffness_matrix* k : {&wide, &narrow}) k->scale(d);
    compare();
    std::vector<double> diagonal;
    for (int row = 0; row < order; ++row) diagonal.push_back(wide.diagonal(row) + 1.0);
    CHECK(narrow.one_norm(diagonal, d) == wide.one_norm(diagonal, d));
  }
}

TEST_CASE("the largest sum of a column is that of the whole matrix, not of its lower triangle") {
  band_matrix k(3, 1);
  k.at(0, 0) = 4;
  k.at(1, 0) = -1;
  k.at(1, 1) = 5;
  k.at(2, 1) = -2;
  k.at(2, 2) = 6;
  const std::vector<double> ones(3, 1.0);
  CHECK(stiffness_matrix(k).one_norm(std::vector<double>{4, 5, 6}, ones) == 8.0);
  CHECK(stiffness_matrix(columns_of(k)).one_norm(std::vector<double>{4, 5.5, 6}, ones) == 8.5);
}

TEST_CASE("springs at one row add up on the diagonal, and K keeps its own") {
  band_matrix k(3, 1);
  for (int row = 0; row < 3; ++row) k.at(row, row) = row + 1.0;
  const std::vector<spring_at> springs = {{1, 10.0}, {1, 0.5}, {2, 4.0}};
  for (const stiffness_matrix& stored : {stiffness_matrix(k), stiffness_matrix(columns_of(k))}) {
    CHECK(stored.diagonal_with(springs) == std::vector<double>{1, 12.5, 7});
    CHECK(stored.diagonal_with({}) == std::vector<double>{1, 2, 3});
  }
}
