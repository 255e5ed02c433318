// Sums of two doubles.
#include "contct/numeric/double_double.hpp"

#include "catch.hpp"

using namespace contct::numeric;

TEST_CASE("a sum of two doubles keeps what each of them alone would round away") {
  const double_double x = double_double(1.0) + 0x1p-80;
  CHECK(x.hi == 1.0);
  CHECK(x.lo == 0x1p-80);
  CHECK((x - 1.0).hi == 0x1p-80);
  CHECK(((x * x) - 1.0).hi == 0x1p-79);  // 2^-160 is too small to matter
}

TEST_CASE("products and quotients are right to 2^-100") {
  const double_double third = double_double(1.0) / 3;
  CHECK(std::abs((third * 3 - 1.0).hi) <= 0x1p-100);
  CHECK(exact_product(0x1.0000001p0, 0x1.0000001p0).lo != 0.0);
  const double_double seventh = double_double(22.0) / 7;
  CHECK(std::abs((seventh * 7 - 22.0).hi) <= 22 * 0x1p-100);
}

TEST_CASE("the decimal 0.1 is one tenth, which its double is not") {
  CHECK(long_decimal(0.1).hi == 0.1);
  CHECK(long_decimal(0.1).lo != 0.0);
  CHECK(std::abs((long_decimal(0.1) * 10 - 1.0).hi) <= 0x1p-94);
  CHECK(std::abs((long_decimal(-2.5e-7) * 4e6 + 1.0).hi) <= 0x1p-94);
  CHECK(std::abs((long_decimal(1.25e22) / 1e22 - 1.25).hi) <= 0x1p-90);
  const double_double none = long_decimal(0.1) + long_decimal(0.2) - long_decimal(0.3);
  CHECK(std::abs(none.hi) < 1e-28);
  CHECK(0.1 + 0.2 - 0.3 > 1e-17);
}

TEST_CASE("whole numbers, and doubles that are short decimals, are taken as they are") {
  for (const double x : {0.0, -0.0, 3.0, -7.0, 0x1p52, 0.5, 0.25}) {
    CHECK(long_decimal(x).hi == x);
    CHECK(long_decimal(x).lo == 0.0);
  }
}

TEST_CASE("a decimal at the ends of the range of doubles is no less than its double") {
  for (const double x : {5e-324, -5e-324, 1e-310, 2.2250738585072014e-308, -1.2345678901234567e-300,
                         1.2345678901234567e-293, 1.7976931348623157e308}) {
    INFO(x);
    CHECK(long_decimal(x).hi == x);
    CHECK(std::abs(long_decimal(x).lo) <= std::abs(x) * 0x1p-53);
    CHECK(decimal_difference(x, 1.0).hi == x - 1.0);
  }
}

TEST_CASE("decimals are added up exactly before they are rounded: 0.1, 0.2 and -0.3 are nothing") {
  const auto sum = [](const std::vector<double>& parts) { return decimal_sum(parts); };
  CHECK(sum({}) == 0.0);
  CHECK(sum({0.1, 0.2, -0.3}) == 0.0);
  CHECK(sum({-0.3, 1e-20, 0.2, 0.1}) == long_decimal(1e-20));
  CHECK(sum({1e40, 1.0, -1e40}) == 1.0);
  CHECK(sum({1e300, 1e-300, -1e300}) == long_decimal(1e-300));
  CHECK(sum({60.1, -60.1}) == 0.0);
  CHECK(sum({1.7976931348623157e308, -1.7976931348623157e308, 0.25}) == 0.25);
}
