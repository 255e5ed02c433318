#include "contct/matrix/block_solve.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/numeric/random.hpp"

using namespace contct::app;

namespace {

/// A factor of a random band matrix whose diagonal outweighs each row.
band_matrix random_factor(int order, int subdiagonals, random_numbers& random) {
  band_matrix a(order, subdiagonals);
  for (int column = 0; column < order; ++column) {
    a.at(column, column) = 2.0 * subdiagonals + 1.0 + random.unit();
    for (int row = column + 1; row <= std::min(column + subdiagonals, order - 1); ++row)
      a.at(row, column) = random.unit() - 0.5;
  }
  REQUIRE(factor(a));
  return a;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b, std::size_t stride,
                          std::size_t first) {
  double off = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - b[i * stride + first]));
  return off;
}

}  // namespace

TEST_CASE("right-hand sides that begin late are solved as dpbtrs solves them, one or eight at a time") {
  random_numbers random(12);
  int compared = 0;
  for (const int order : {1, 2, 3, 4, 5, 8, 17, 60}) {
    for (const int subdiagonals : {0, 1, 2, 3, 7, 20}) {
      const band_matrix l = random_factor(order, subdiagonals, random);
      for (int first = 0; first < order; first += 1 + order / 5) {
        const auto n = static_cast<std::size_t>(order);
        std::vector<double> eight(n * block_width);
        std::vector<std::vector<double>> each;
        for (std::size_t k = 0; k < block_width; ++k) {
          std::vector<double> b(n);
          for (auto i = static_cast<std::size_t>(first); i < n; ++i) {
            b[i] = random.unit() - 0.5;
            eight[i * block_width + k] = b[i];
          }
          std::vector<double> one = b;
          solve_with(l, b);
          solve_from(l, first, one);
          CHECK(largest_difference(b, one, 1, 0) <= 1e-15);
          each.push_back(b);
        }
        solve_block_from(l, first, eight);
        for (std::size_t k = 0; k < block_width; ++k) {
          CHECK(largest_difference(each[k], eight, block_width, k) <= 1e-15);
          ++compared;
        }
      }
    }
  }
  CHECK(compared > 1000);
}

namespace {

using row_entries = std::array<double, block_width>;

row_entries counted_from(double first) {
  row_entries row{};
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = first + static_cast<double>(i);
  return row;
}

}  // namespace

TEST_CASE("every right-hand side of a row has the same multiple of another row subtracted") {
  const row_entries x = counted_from(1);
  const row_entries y = counted_from(100);
  const row_entries start = counted_from(1000);
  row_entries row = start;
  subtract_from(row.data(), 2.0, block_row::load(x.data()));
  for (std::size_t i = 0; i < row.size(); ++i) CHECK(row[i] == start[i] - 2 * x[i]);
  subtract_from(row.data(), 1.0, block_row::load(x.data()), -3.0, block_row::load(y.data()));
  for (std::size_t i = 0; i < row.size(); ++i) CHECK(row[i] == start[i] - 3 * x[i] + 3 * y[i]);
}

TEST_CASE("a row is divided by the pivot after a sum is subtracted") {
  row_entries row = counted_from(5);
  block_row sum{};
  sum.add(2.0, block_row::load(row.data()));
  divide(row.data(), -4.0, sum);
  for (std::size_t i = 0; i < row.size(); ++i) CHECK(row[i] == counted_from(5)[i] / 4);
  row_entries returned{};
  divide(row.data(), 0.5).store(returned.data());
  CHECK(returned == row);
  CHECK(row[7] == 6.0);
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
  std::vector<double> x(5 * block_width);
  for (double& entry : x) entry = random.unit() - 0.5;
  for (std::size_t i = 0; i < 5; ++i) x[i * block_width + 3] = 0.0;  // one right-hand side of nothing
  std::vector<double> b(x.size());
  for (std::size_t row = 0; row < 5; ++row)
    for (std::size_t column = 0; column < 5; ++column)
      for (std::size_t k = 0; k < 5; ++k)
        for (std::size_t i = 0; i < block_width; ++i)
          b[row * block_width + i] += l[row][k] * l[column][k] * x[column * block_width + i];
  solve_block({columns, row_places, entry_places, rows, entries}, b);
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(b[i] == Approx(x[i]).epsilon(1e-12).margin(1e-13));
}
