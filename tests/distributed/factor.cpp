// A matrix that the ranks share: factors, solutions, and what has no factor. Rank 0 of
// tests/distributed/main.cpp runs it.
#include <cmath>

#include "catch.hpp"
#include "contct/distributed/ranks.hpp"
#include "contct/matrix/block_solve.hpp"

using namespace contct::matrix;
using contct::distributed::joined_ranks;

namespace {

/// -1 beside the diagonal and in row n - 1 of column 0; the diagonal is given with each factorisation.
sparse_columns ring(int n) {
  sparse_columns a;
  for (int j = 0; j < n; ++j) {
    for (const auto& [row, value] : {std::pair(j, 4.0), std::pair(j + 1, -1.0), std::pair(n - 1, -1.0)}) {
      if (row >= n || (row == n - 1 && row != j && row != j + 1 && j != 0)) continue;
      a.rows.push_back(row);
      a.values.push_back(value);
      if (row == n - 1) break;
    }
    a.starts.push_back(static_cast<int>(a.rows.size()));
  }
  return a;
}

/// The largest entry of b - A x.
double residual_of(int n, const std::vector<double>& diagonal, const std::vector<double>& x,
                   const std::vector<double>& b) {
  double largest = 0.0;
  const auto size = static_cast<std::size_t>(n);
  for (std::size_t i = 0; i < size; ++i) {
    const double ax = diagonal[i] * x[i] - x[(i + 1) % size] - x[(i + size - 1) % size];
    largest = std::max(largest, std::abs(b[i] - ax));
  }
  return largest;
}

}  // namespace

TEST_CASE("the ranks solve with one diagonal after the other, at all rows and at some") {
  constexpr int n = 203;
  const auto f = joined_ranks()->distribute(ring(n));
  CHECK(f->flops() > n);
  CHECK(f->bytes() >= 8 * n);
  for (const double d : {4.0, 2.5, 1e6}) {
    std::vector<double> diagonal(n, d);
    diagonal[7] += 3.0;
    REQUIRE(f->factor(diagonal));
    std::vector<double> b(n);
    for (int i = 0; i < n; ++i) b[static_cast<std::size_t>(i)] = std::sin(i);
    std::vector<double> x = b;
    f->solve(x);
    CHECK(residual_of(n, diagonal, x, b) < 1e-12);
    const std::vector<int> units = {n - 1, -1, 0, 101};
    for (const std::vector<int>& at : {std::vector<int>{150, 3, n - 1, 0}, std::vector<int>{102, 101, 101}}) {
      std::vector<double> some;
      REQUIRE(f->solve_units_at(units, at, some));
      REQUIRE(some.size() == at.size() * block_width);
      for (std::size_t u = 0; u < units.size(); ++u) {
        std::vector<double> e(n);
        if (units[u] >= 0) e[static_cast<std::size_t>(units[u])] = 1.0;
        f->solve(e);
        for (std::size_t i = 0; i < at.size(); ++i)
          CHECK(some[i * block_width + u] ==
                Approx(e[static_cast<std::size_t>(at[i])]).epsilon(1e-12).margin(1e-18));
      }
    }
    std::vector<double> all;
    f->solve_units(units, all);
    CHECK(all.size() == n * block_width);
  }
}

TEST_CASE("a matrix that is not positive definite has no factor, and the next one may have") {
  constexpr int n = 64;
  const auto f = joined_ranks()->distribute(ring(n));
  std::vector<double> b(n, 1.0);
  for (const double bad : {-4.0, 0.0, 0.25}) {
    std::vector<double> diagonal(n, 4.0);
    diagonal[n - 1] = bad;
    CHECK_FALSE(f->factor(diagonal));
    CHECK_FALSE(f->factor(std::vector<double>(n, 0.0)));
    diagonal[n - 1] = 4.0;
    REQUIRE(f->factor(diagonal));
    std::vector<double> x = b;
    f->solve(x);
    CHECK(residual_of(n, diagonal, x, b) < 1e-13);
  }
}

TEST_CASE("several matrices live beside each other, and each rank tells its memory") {
  const auto small = joined_ranks()->distribute(ring(3));  // fewer rows than there may be ranks
  {
    const auto large = joined_ranks()->distribute(ring(500));
    REQUIRE(large->factor(std::vector<double>(500, 3.0)));
  }
  const std::vector<double> diagonal(3, 3.0);
  REQUIRE(small->factor(diagonal));
  std::vector<double> x = {1.0, 2.0, 4.0};
  const std::vector<double> b = x;
  small->solve(x);
  CHECK(residual_of(3, diagonal, x, b) < 1e-14);
  const std::vector<long> peaks = joined_ranks()->peak_kib();
  CHECK(static_cast<int>(peaks.size()) == joined_ranks()->count());
  for (const long kib : peaks) CHECK(kib > 1000);
}
