// How far a sparse factor is from its matrix, bounded from above.
#include "contct/certify/sparse_product.hpp"

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "support/matrices.hpp"

using namespace contct::app;
using namespace contct::certify;

namespace {

/// As it is, in long double.
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

/// L L' is not A, by far.
sparse_columns lower_of(const band_matrix& k) {
  sparse_columns l = columns_of(k);
  for (double& x : l.values) x = std::sin(37 * x);
  return l;
}

}  // namespace

TEST_CASE("the bound is above the largest row sum, and by rounding only") {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const sparse_columns a = columns_of(random_band(40, 7, seed));
    const sparse_columns l = lower_of(random_band(40, 11, seed + 10));  // with entries where A has none
    const double bound = largest_row_of_error_in(a, l);
    CHECK(bound >= largest_row(a, l));
    CHECK(bound <= largest_row(a, l) * (1 + 1e-9));
  }
}

TEST_CASE("of an exact factor nothing but the rounding of sums is left, and a part in 1e9 is seen") {
  // L has ones on its diagonal and below: A_ij = 1 + min(i, j), all exact.
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
  const double rounding = largest_row_of_error_in(a, l);
  CHECK(rounding > 0.0);
  CHECK(rounding < 1e-13);
  l.values[1] += 1e-9;  // row 1 of column 0, which all later rows meet
  CHECK(largest_row_of_error_in(a, l) >= largest_row(a, l));
  CHECK(largest_row_of_error_in(a, l) > 6e-9);
}

TEST_CASE("an entry that is no number is never passed over") {
  const sparse_columns a = columns_of(random_band(9, 3, 7));
  sparse_columns l = a;
  l.values[l.starts[4]] = std::nan("");
  CHECK(std::isinf(largest_row_of_error_in(a, l)));
}

TEST_CASE("a matrix in another order has its entries in the lower triangle again") {
  const sparse_columns a = columns_of(random_band(9, 3, 7));
  const std::vector<int> places = {8, 0, 7, 1, 6, 2, 5, 3, 4};
  const sparse_columns moved = reordered(a, places);
  CHECK(moved.values.size() == a.values.size());
  const auto entry = [](const sparse_columns& m, int i, int j) {
    const auto [row, column] = std::pair(std::max(i, j), std::min(i, j));
    for (int at = m.starts[column]; at < m.starts[column + 1]; ++at)
      if (m.rows[at] == row) return m.values[at];
    return 0.0;
  };
  for (int i = 0; i < 9; ++i)
    for (int j = 0; j <= i; ++j) CHECK(entry(moved, places[i], places[j]) == entry(a, i, j));
}
