// Tests matrices as bands, entries and columns, and the factor of a band.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "catch.hpp"
#include "contct/linear/cholesky.hpp"
#include "contct/linear/stiffness_matrix.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

std::vector<long double> minus_product(const stiffness_matrix& k, std::span<const double> x) {
  std::vector<long double> r(x.size());
  k.subtract_product(x, r);
  return r;
}

/// Returns all entries of K, by rows.
std::vector<std::vector<double>> full(const stiffness_matrix& k) {
  std::vector<std::vector<double>> all(k.order(), std::vector<double>(k.order()));
  each_entry(k, [&all](int row, int column, double value) { all[row][column] = all[column][row] = value; });
  return all;
}

/// Returns a simply supported beam of `n` elements of length h.
linear_structure simple_span(int n, double h) {
  const std::vector<support> ends = {{0, 0, true}, {n, 0, true}};
  return build(even_beam(n * h, n, 1.0), ends, {});
}

double rcond_of(const linear_structure& s) {
  return stiffness_factor(s.stiffness).reciprocal_condition({});
}

}  // namespace

TEST_CASE("products, norms, supports and scales of K by columns are those of all entries of the matrix") {
  constexpr int order = 40, half_bandwidth = 7;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const band_matrix band = random_band(order, half_bandwidth, seed);
    stiffness_matrix k(band);
    CHECK(k.values.size() < static_cast<std::size_t>(order * (half_bandwidth + 1)) * 2 / 3);
    const std::vector<double> x = random_vector(order, seed + 100);
    std::vector<std::vector<double>> all = full(k);
    for (int row = 0; row < order; ++row)
      for (int column = std::max(0, row - half_bandwidth); column <= row; ++column)
        CHECK(all[row][column] == band.at(row, column));
    std::vector<char> marked(order);
    marked[11] = 1;
    for (const auto& [row, of, value] : k.entries_in(marked)) {
      CHECK(of == 11);
      CHECK(row != 11);
      CHECK(std::exchange(all[row][of], 0.0) == value);
    }
    for (int row = 0; row < order; ++row) CHECK((row == 11 || all[row][11] == 0.0));
    std::vector<double> pivots(order), d = random_vector(order, seed + 200), diagonal, sums(order);
    pivots[0] = pivots[order - 1] = 4.0;
    pivots[11] = 1.0;
    k.fix(pivots);
    CHECK(minus_product(k, x)[11] == -static_cast<long double>(x[11]));
    for (double& entry : d) entry += 1.0;
    for (int row = 0; row < order; ++row) diagonal.push_back(k.diagonal(row) + 1.0);
    const double norm = k.one_norm(diagonal, d);
    k.scale(d);
    const std::vector<long double> r = minus_product(k, x);
    all = full(k);
    for (int row = 0; row < order; ++row) {
      const bool fixed = pivots[row] > 0.0;
      long double product = 0.0L;
      for (int column = 0; column < order; ++column) {
        const bool beside = fixed || pivots[column] > 0.0 || std::abs(row - column) > half_bandwidth;
        const double value = row != column
                                 ? beside ? 0.0 : band.at(std::max(row, column), std::min(row, column))
                             : fixed ? pivots[row]
                                     : band.at(row, row);
        CHECK(all[row][column] == Approx(value * d[row] * d[column]).epsilon(1e-15));
        product += static_cast<long double>(all[row][column]) * x[column];
        sums[row] += std::abs((value + (row == column ? 1.0 : 0.0)) * d[row] * d[column]);
      }
      CHECK(static_cast<double>(-r[row]) == Approx(static_cast<double>(product)).margin(1e-16));
    }
    CHECK(norm == Approx(*std::max_element(sums.begin(), sums.end())).epsilon(1e-14));
  }
}

TEST_CASE("several springs at one row add up on the diagonal, and K without springs does not change") {
  band_matrix k(3, 1);
  for (int row = 0; row < 3; ++row) k.at(row, row) = row + 1.0;
  const std::vector<spring_at> springs = {{1, 10.0}, {1, 0.5}, {2, 4.0}};
  const stiffness_matrix stored(k);
  CHECK(stored.diagonal_with(springs) == std::vector<double>{1, 12.5, 7});
  CHECK(stored.with(springs).values == std::vector<double>{1, 12.5, 7});
  CHECK(stored.diagonal_with({}) == std::vector<double>{1, 2, 3});
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

TEST_CASE("the order of rows determines the width and the memory of a band, and where an entry is stored") {
  // The matrix [[4, 0, 1], [0, 5, 0], [1, 0, 6]]; both triangles are used, although only the lower one is
  // stored.
  const sparse_matrix a = {3, {{2, 0, 1.0}, {0, 0, 4.0}, {2, 2, 6.0}, {1, 1, 5.0}}};
  CHECK(a.times(std::vector<double>{1, 2, 3}) == std::vector<long double>{7, 10, 19});
  CHECK(subdiagonals_of(a, {}) == 2);
  CHECK(bytes_of_band(a, {}) == 3L * 3 * 8);
  const std::vector<int> rows = {0, 2, 1};  // row 2 of the matrix is next to row 0
  CHECK(subdiagonals_of(a, rows) == 1);
  CHECK(bytes_of_band(a, rows) == 3L * 2 * 8);
  const band_matrix band = stiffness_matrix(columns_of(a, rows), subdiagonals_of(a, rows)).band();
  CHECK(band.subdiagonals() == 1);
  CHECK(std::vector{band.at(0, 0), band.at(1, 0), band.at(1, 1), band.at(2, 1), band.at(2, 2)} ==
        std::vector<double>{4, 1, 6, 0, 5});
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
  CHECK(columns_of(band_matrix(3, 3)).rows ==
        std::vector<int>{0, 1, 2, 1, 2, 2});  // a beam's, which is copied whole
}

TEST_CASE("the rows of a chain in random order are reordered to a band with one subdiagonal") {
  constexpr int n = 23;
  sparse_matrix chain{n, {}};
  const auto shuffled = [](int i) { return i * 7 % n; };
  for (int i = 0; i < n; ++i) {
    const int a = shuffled(i), b = shuffled(i + 1);
    chain.entries.push_back({a, a, 2.0});
    if (i + 1 < n) chain.entries.push_back({std::max(a, b), std::min(a, b), -1.0});
  }
  REQUIRE(subdiagonals_of(chain, {}) > 1);
  std::vector<int> rows = rows_for_small_band(chain);
  CHECK(subdiagonals_of(chain, rows) == 1);
  std::sort(rows.begin(), rows.end());
  for (int i = 0; i < n; ++i) CHECK(rows[i] == i);  // each row once
}

TEST_CASE("if no other order of rows makes the band narrower, the order is kept") {
  CHECK(rows_for_small_band({2, {{0, 0, 1.0}, {1, 0, -0.5}, {1, 1, 1.0}}}).empty());
  CHECK(rows_for_small_band({3, {{0, 0, 1.0}, {1, 1, 1.0}, {2, 2, 1.0}}}).empty());
}

extern "C" void dpbcon_(const char* uplo, const int* n, const int* kd, const double* ab, const int* ldab,
                        const double* anorm, double* rcond, double* work, int* iwork, int* info,
                        std::size_t uplo_length);

TEST_CASE("a band factor solves K x = b, and gives the x from which b was computed") {
  band_matrix a(5, 2);
  for (int j = 0; j < 5; ++j) {
    a.add(j, j, 10.0 + j);
    if (j + 1 < 5) a.add(j + 1, j, -3.0);
    if (j + 2 < 5) a.add(j + 2, j, 1.5);
  }
  const std::vector<double> x = {1, -2, 3, -4, 5};
  std::vector<double> b = product(a, x);
  REQUIRE(factor(a));
  solve_with(a, b);
  for (std::size_t i = 0; i < 5; ++i) CHECK(b[i] == Approx(x[i]).epsilon(1e-14));
}

TEST_CASE("the condition number is that of the equilibrated matrix, and does not depend on units") {
  const double metres = rcond_of(simple_span(10, 1.0));
  const double tiny = rcond_of(simple_span(10, 1e-9));
  CHECK(metres == Approx(tiny).epsilon(1e-6));
  CHECK(metres > 1e-6);
  CHECK(metres < 1e-3);
}

TEST_CASE("the condition number equals the estimate that dpbcon of LAPACK gives") {
  for (const int n : {1, 2, 7, 50, 400}) {
    const linear_structure s = simple_span(n, 1.0);
    const double ours = rcond_of(s);
    // dpbcon gets the same scaled matrix.
    stiffness_matrix scaled = s.stiffness;
    std::vector<double> d;
    for (const double entry : scaled.diagonal_with({})) d.push_back(1.0 / std::sqrt(entry));
    const double norm = scaled.one_norm(scaled.diagonal_with({}), d);
    scaled.scale(d);
    band_matrix a = scaled.band();
    REQUIRE(factor(a));
    const int order = a.order();
    const int kd = 3;
    const int ldab = 4;
    int info = -1;
    double rcond = 0.0;
    std::vector<double> work(3 * d.size());
    std::vector<int> iwork(d.size());
    dpbcon_("L", &order, &kd, a.data(), &ldab, &norm, &rcond, work.data(), iwork.data(), &info, 1);
    REQUIRE(info == 0);
    INFO(n << " elements");
    CHECK(ours == Approx(rcond).epsilon(1e-6));
  }
}

TEST_CASE("the condition number of an equilibrated 2 by 2 matrix is exact") {
  band_matrix a(2, 1);  // scaled [[1, .5], [.5, 1]]: norm 1.5, its inverse 2
  a.add(0, 0, 4.0);
  a.add(1, 1, 25.0);
  a.add(1, 0, 5.0);
  const stiffness_matrix k(a);
  CHECK(stiffness_factor(k).reciprocal_condition({}) == Approx(1.0 / 3.0).epsilon(1e-14));
}

TEST_CASE("a span of n elements loses correct digits as n^4, and for n = 5000 at most one digit remains") {
  const double at_10 = rcond_of(simple_span(10, 1.0));
  const double at_100 = rcond_of(simple_span(100, 1.0));
  CHECK(at_10 / at_100 == Approx(1e4).epsilon(0.5));
  CHECK(digits_left(at_10) >= 10);
  CHECK(digits_left(rcond_of(simple_span(5000, 1.0))) <= 1);
}

TEST_CASE("the number of correct digits is from 0 to 15 for any condition number") {
  CHECK(digits_left(0.0) == 0);
  CHECK(digits_left(1e-30) == 0);
  CHECK(digits_left(1.0) == 15);
}

TEST_CASE("LAPACK is identified by a version and the library that contains dpbtrf") {
  const std::string identity = lapack_identity();
  CHECK(identity.rfind("LAPACK 3.", 0) == 0);
  const std::size_t comma = identity.find(", ");
  REQUIRE(comma != std::string::npos);
  CHECK(identity.find('/') == std::string::npos);  // the library is named without its folder
  CHECK(identity.size() > comma + 2);
}
