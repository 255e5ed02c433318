// Tests double-doubles, which are sums of two doubles.
#include "contct/number/double_double.hpp"

#include "catch.hpp"

using namespace contct;

TEST_CASE("a sum in double-double keeps digits that a double would round away") {
  const double_double x = double_double(1.0) + 0x1p-80;
  CHECK(x.hi == 1.0);
  CHECK(x.lo == 0x1p-80);
  CHECK((x - 1.0).hi == 0x1p-80);
  CHECK(((x * x) - 1.0).hi == 0x1p-79);  // 2^-160 is below the precision
}

TEST_CASE("products and quotients in double-double have a relative error of at most 2^-100") {
  const double_double third = double_double(1.0) / 3;
  CHECK(std::abs((third * 3 - 1.0).hi) <= 0x1p-100);
  CHECK(exact_product(0x1.0000001p0, 0x1.0000001p0).lo != 0.0);
  const double_double seventh = double_double(22.0) / 7;
  CHECK(std::abs((seventh * 7 - 22.0).hi) <= 22 * 0x1p-100);
}
