#include "contct/matrix/band_matrix.hpp"

#include "catch.hpp"

using namespace contct::app;

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

TEST_CASE("an entry below the diagonal is found at column * (kd + 1) + row - column") {
  band_matrix a(5, 2);
  a.at(3, 1) = 31.0;
  a.at(4, 4) = 44.0;
  CHECK(a.data()[1 * 3 + 2] == 31.0);
  CHECK(a.data()[4 * 3] == 44.0);
  CHECK(a.order() == 5);
  CHECK(a.subdiagonals() == 2);
}
