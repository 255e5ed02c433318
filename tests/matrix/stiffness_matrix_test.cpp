// Tests that every function gives the same answer for a matrix as a band and by columns.
#include "contct/matrix/stiffness_matrix.hpp"

#include "catch.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

constexpr int order = 40;
constexpr int half_bandwidth = 7;

std::vector<long double> minus_product(const stiffness_matrix& k, std::span<const double> x) {
  std::vector<long double> r(x.size());
  k.subtract_product(x, r);
  return r;
}

}  // namespace

TEST_CASE("a matrix stored as a band and a matrix stored by columns are equal to the bit") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const band_matrix band = random_band(order, half_bandwidth, seed);
    stiffness_matrix wide(band);
    stiffness_matrix narrow(columns_of(band));
    CHECK(wide.is_band());
    CHECK_FALSE(narrow.is_band());
    CHECK(narrow.columns().values.size() < static_cast<std::size_t>(order * (half_bandwidth + 1)) * 2 / 3);
    const std::vector<double> x = random_vector(order, seed + 100);
    const auto compare = [&] {
      REQUIRE(narrow.order() == wide.order());
      for (int row = 0; row < order; ++row) CHECK(narrow.diagonal(row) == wide.diagonal(row));
      CHECK(minus_product(narrow, x) == minus_product(wide, x));
    };
    compare();
    std::vector<double> pivots(order);
    pivots[0] = pivots[order - 1] = 4.0;
    pivots[11] = 1.0;
    std::vector<char> marked(order);
    marked[11] = 1;
    for (const stiffness_matrix* k : {&wide, &narrow}) {
      std::vector<double> unit(order);
      unit[11] = -1.0;
      std::vector<long double> column = minus_product(*k, unit);
      for (const auto& [row, of, value] : k->entries_in(marked)) {
        CHECK(of == 11);
        CHECK(row != 11);
        column[row] -= value;
      }
      column[11] -= k->diagonal(11);
      CHECK(std::count(column.begin(), column.end(), 0.0L) == order);
    }
    for (stiffness_matrix* k : {&wide, &narrow}) {
      k->add_to_diagonal(5, 2.5);
      k->fix(pivots);
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

TEST_CASE("the 1-norm of K includes the upper triangle, although only the lower one is stored") {
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

TEST_CASE("several springs at one row add up on the diagonal, and K without springs does not change") {
  band_matrix k(3, 1);
  for (int row = 0; row < 3; ++row) k.at(row, row) = row + 1.0;
  const std::vector<spring_at> springs = {{1, 10.0}, {1, 0.5}, {2, 4.0}};
  for (const stiffness_matrix& stored : {stiffness_matrix(k), stiffness_matrix(columns_of(k))}) {
    CHECK(stored.diagonal_with(springs) == std::vector<double>{1, 12.5, 7});
    CHECK(stored.diagonal_with({}) == std::vector<double>{1, 2, 3});
  }
}

TEST_CASE("the entry (row, column) of a band is at column * (kd + 1) + row - column in memory") {
  band_matrix a(4, 1);
  a.add(1, 0, 2.0);
  a.add(0, 1, 3.0);
  a.add(2, 2, 7.0);
  CHECK(a.at(1, 0) == 5.0);
  CHECK(a.at(2, 2) == 7.0);
  CHECK(a.data()[1] == 5.0);  // position 1 of column 0
  CHECK(a.data()[4] == 7.0);  // position 0 of column 2
}

namespace {

/// The matrix [[4, 0, 1], [0, 5, 0], [1, 0, 6]].
const sparse_matrix small = {3, {{2, 0, 1.0}, {0, 0, 4.0}, {2, 2, 6.0}, {1, 1, 5.0}}};

}  // namespace

TEST_CASE(
    "the product of a symmetric matrix and a vector uses both triangles, although only the lower one is "
    "stored") {
  CHECK(small.times(std::vector<double>{1, 2, 3}) == std::vector<long double>{7, 10, 19});
}

TEST_CASE("the order of rows determines the width and the memory of a band, and where an entry is stored") {
  CHECK(subdiagonals_of(small, {}) == 2);
  CHECK(bytes_of_band(small, {}) == 3L * 3 * 8);
  const std::vector<int> rows = {0, 2, 1};  // row 2 of the matrix is next to row 0
  CHECK(subdiagonals_of(small, rows) == 1);
  CHECK(bytes_of_band(small, rows) == 3L * 2 * 8);
  const band_matrix band = band_of(small, rows);
  CHECK(band.subdiagonals() == 1);
  CHECK(band.at(0, 0) == 4.0);
  CHECK(band.at(1, 0) == 1.0);
  CHECK(band.at(1, 1) == 6.0);
  CHECK(band.at(2, 1) == 0.0);
  CHECK(band.at(2, 2) == 5.0);
}

TEST_CASE("entries in any order are sorted by column and row, and each column gets a diagonal entry") {
  const sparse_matrix a{4, {{3, 1, 5.0}, {2, 2, 7.0}, {2, 1, 4.0}, {0, 0, 1.0}, {3, 3, 9.0}, {3, 0, 2.0}}};
  const sparse_columns k = columns_of(a);
  CHECK(k.order() == 4);
  CHECK(k.starts == std::vector<int>{0, 2, 5, 6, 7});
  CHECK(k.rows == std::vector<int>{0, 3, 1, 2, 3, 2, 3});
  CHECK(k.values == std::vector<double>{1, 2, 0, 4, 5, 7, 9});  // row 1 of `a` has no diagonal entry
}

TEST_CASE("a band that is converted to sparse columns loses zeros, but keeps those on the diagonal") {
  band_matrix band(3, 2);
  band.at(0, 0) = 4.0;
  band.at(2, 0) = 1.0;
  band.at(2, 2) = 6.0;
  const sparse_columns k = columns_of(band);
  CHECK(k.starts == std::vector<int>{0, 2, 3, 4});
  CHECK(k.rows == std::vector<int>{0, 2, 1, 2});
  CHECK(k.values == std::vector<double>{4, 1, 0, 6});
  CHECK(k.diagonal(1) == 0.0);
  CHECK(k.diagonal(2) == 6.0);
}

TEST_CASE("a band with many zeros is multiplied as sparse columns, and a full band as a band") {
  band_matrix band(40, 20);
  for (int row = 0; row < 40; ++row) band.at(row, row) = 1.0;
  CHECK(without_zeros(stiffness_matrix(band)).has_value());
  CHECK_FALSE(without_zeros(stiffness_matrix(columns_of(band))));
  for (int column = 0; column < 40; ++column)
    for (int row = column; row <= std::min(column + 20, 39); ++row) band.at(row, column) = 1.0;
  CHECK_FALSE(without_zeros(stiffness_matrix(band)));
}
