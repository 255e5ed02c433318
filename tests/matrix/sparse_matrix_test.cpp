#include "contct/matrix/sparse_matrix.hpp"

#include "catch.hpp"

using namespace contct::app;

namespace {

/// 4 . 1 / . 5 . / 1 . 6
const sparse_matrix small = {3, {{2, 0, 1.0}, {0, 0, 4.0}, {2, 2, 6.0}, {1, 1, 5.0}}};

}  // namespace

TEST_CASE("a product uses both triangles") {
  CHECK(small.times(std::vector<double>{1, 2, 3}) == std::vector<long double>{7, 10, 19});
}

TEST_CASE("the order of the rows sets the width of the band, its memory and its places") {
  CHECK(subdiagonals_of(small, {}) == 2);
  CHECK(bytes_of_band(small, {}) == 3 * 3 * 8);
  const std::vector<int> rows = {0, 2, 1};  // row 2 of the matrix beside row 0
  CHECK(subdiagonals_of(small, rows) == 1);
  CHECK(bytes_of_band(small, rows) == 3 * 2 * 8);
  const band_matrix band = band_of(small, rows);
  CHECK(band.subdiagonals() == 1);
  CHECK(band.at(0, 0) == 4.0);
  CHECK(band.at(1, 0) == 1.0);
  CHECK(band.at(1, 1) == 6.0);
  CHECK(band.at(2, 1) == 0.0);
  CHECK(band.at(2, 2) == 5.0);
}

TEST_CASE("entries in any order become columns in ascending order, each with its diagonal") {
  const sparse_matrix a{4, {{3, 1, 5.0}, {2, 2, 7.0}, {2, 1, 4.0}, {0, 0, 1.0}, {3, 3, 9.0}, {3, 0, 2.0}}};
  const sparse_columns k = columns_of(a);
  CHECK(k.order() == 4);
  CHECK(k.starts == std::vector<int>{0, 2, 5, 6, 7});
  CHECK(k.rows == std::vector<int>{0, 3, 1, 2, 3, 2, 3});
  CHECK(k.values == std::vector<double>{1, 2, 0, 4, 5, 7, 9});  // row 1 has nothing on its diagonal
}

TEST_CASE("columns of a band leave its zeros out, but for those on the diagonal") {
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
