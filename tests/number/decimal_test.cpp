// Tests decimal literals and their last digits.
#include "contct/number/decimal.hpp"

#include "catch.hpp"

using namespace contct;

TEST_CASE("stands_for ignores zeros, signs and the form of the exponent of a number") {
  for (const char* same : {"0.25", ".25", "25e-2", "+0.2500", "2_5E-0_2", "2.5d-1", "0.025D+01", "00.25",
                           "0.2500000000000000000000", "000000000000000000000.25"}) {
    INFO(same);
    CHECK(stands_for(same, 0.25));
    CHECK(stands_for(same, 0x1p-1074) == false);
  }
  for (const char* zero : {"0", "-0.0", "0e999999999999999999", ".0"}) CHECK(stands_for(zero, 0.0));
  CHECK(stands_for("1.0000000000000000000000e-1", 0.1));
  CHECK_FALSE(stands_for("0.10000000000000000555", 0.1));
  CHECK(stands_for("5e-324", 5e-324));
  CHECK_FALSE(stands_for("4.9e-324", 5e-324));
  CHECK_FALSE(stands_for("1e-400", 0.0));
  CHECK(stands_for("6283.1853069999997", 6283.185307));  // the 17 digits of this double
  CHECK(stands_for("2.9999999999999999e-1", 0.3));
  for (const char* other : {"6283.1853069999996", "6283.18530699999965", "0.30000000000000001"})
    CHECK_FALSE(stands_for(other, other[0] == '6' ? 6283.185307 : 0.3));
  CHECK(shortest_decimal(0.25) == decimal{false, "25", -2});
  CHECK(shortest_decimal(-2.5e-300) == decimal{true, "25", -301});
  CHECK(shortest_decimal(-1000.0) == decimal{true, "1", 3});
}

TEST_CASE("stands_for is true for text that is not a decimal, since such text has no shortest decimal") {
  for (const char* none : {"", "-", ".", "inf", "0x10", "1e", "1e+", "1 ", "1.2.3", "e5"})
    CHECK(stands_for(none, 0x1p-1074));
}

TEST_CASE("zeros at the end of a number are significant digits, and zeros at its front are none") {
  for (const char* four : {"1.250", "0.001250", "-1250", "1_25.0e-7", "+0012.50"})
    CHECK(significant_digits(four) == 4);
  for (const char* none : {"0", "0.000", "", "x"}) CHECK(significant_digits(none) == 0);
}

TEST_CASE(
    "the warning about a long number quotes the number and the shortest decimal, in less than 150 bytes") {
  const std::string used = ", is used everywhere";
  CHECK(rounding_words("0.10000000000000000555", 0.1) ==
        "found 0.10000000000000000555; the shortest decimal of its double, 0.1" + used);
  CHECK(rounding_words("1152921504606846976", 0x1p60) ==
        "found 1152921504606846976; the shortest decimal of its double, 1.152921504606847e+18" + used);
  CHECK(rounding_words("1" + std::string(500, '0') + "e-500", 1.0).size() < 150);
}
