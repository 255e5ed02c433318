// A stiffness matrix for products.
#include "catch.hpp"
#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/numeric/random.hpp"

using namespace contct::app;

namespace {

/// Of 40 rows; entries further from the diagonal than `dense` are there at every ninth place.
band_matrix with_gaps(int dense, random_numbers& random) {
  band_matrix k(40, 20);
  for (int column = 0; column < 40; ++column)
    for (int row = column; row <= std::min(column + 20, 39); ++row)
      if (row - column <= dense || (row + column) % 9 == 0) k.at(row, column) = random.unit() - 0.3;
  return k;
}

}  // namespace

TEST_CASE("a band of which most is zeros has the same products by columns, to the bit") {
  random_numbers random(7);
  const stiffness_matrix band(with_gaps(1, random));
  const std::optional<stiffness_matrix> sparse = without_zeros(band);
  REQUIRE(sparse);
  CHECK_FALSE(sparse->is_band());
  int compared = 0;
  for (int round = 0; round < 50; ++round) {
    std::vector<double> x(40);
    for (double& entry : x) entry = random.unit() - 0.5;
    std::vector<long double> by_band(40, 0.1L);
    std::vector<long double> by_columns = by_band;
    band.subtract_product(std::span<const double>(x), by_band);
    sparse->subtract_product(std::span<const double>(x), by_columns);
    for (std::size_t row = 0; row < x.size(); ++row, ++compared) CHECK(by_band[row] == by_columns[row]);
  }
  CHECK(compared == 2000);
}

TEST_CASE("a band with few zeros stays a band") {
  random_numbers random(7);
  CHECK_FALSE(without_zeros(stiffness_matrix(with_gaps(20, random))));
  const stiffness_matrix sparse(columns_of(with_gaps(1, random)));
  CHECK_FALSE(without_zeros(sparse));
}
