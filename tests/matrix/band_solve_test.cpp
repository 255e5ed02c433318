#include "contct/matrix/band_solve.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/matrix/several_right_hand_sides.hpp"
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
