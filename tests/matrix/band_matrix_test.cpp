#include "contct/matrix/band_matrix.hpp"

#include "catch.hpp"

using namespace contct;

TEST_CASE("a band keeps only its lower half, and adds from both sides") {
  band_matrix a(4, 1);
  a.add(1, 0, 2.0);
  a.add(0, 1, 3.0);
  a.add(2, 2, 7.0);
  CHECK(a.at(1, 0) == 5.0);
  CHECK(a.at(2, 2) == 7.0);
  CHECK(a.data()[1] == 5.0);      // second place of column 0
  CHECK(a.data()[2 * 2] == 7.0);  // first place of column 2
}

TEST_CASE("multiplying uses both halves") {
  band_matrix a(3, 1);  // 2 1 0 / 1 3 4 / 0 4 5
  a.add(0, 0, 2);
  a.add(1, 0, 1);
  a.add(1, 1, 3);
  a.add(2, 1, 4);
  a.add(2, 2, 5);
  std::vector<double> y(3);
  a.multiply(std::vector<double>{1, 2, 3}, y);
  CHECK(y == std::vector<double>{4, 19, 23});
}
