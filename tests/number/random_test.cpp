#include "contct/number/random.hpp"

#include "catch.hpp"

using namespace contct;

TEST_CASE("splitmix64 gives its published first numbers for seed 1234567") {
  random_numbers r(1234567);
  CHECK(r.bits() == 6457827717110365317ULL);
  CHECK(r.bits() == 3203168211198807973ULL);
  CHECK(r.bits() == 9817491932198370423ULL);
}

TEST_CASE("random whole numbers reach both ends of a given range and never exceed them") {
  random_numbers r(1);
  bool least = false;
  bool most = false;
  for (int i = 0; i < 1000; ++i) {
    const int n = r.whole(-3, 5);
    REQUIRE(n >= -3);
    REQUIRE(n <= 5);
    least = least || n == -3;
    most = most || n == 5;
    const double u = r.unit();
    REQUIRE(u >= 0.0);
    REQUIRE(u < 1.0);
  }
  CHECK(least);
  CHECK(most);
}
