// Printed numbers beside exact ones: rounded, cut, or neither.
#include "contct/lab/printed_number.hpp"

#include <stdexcept>

#include "catch.hpp"

using namespace contct::lab;

TEST_CASE("decimals and fractions are read without rounding") {
  CHECK(number_printed("-208/58875") == rational(-208, 58875));
  CHECK(number_printed("0") == 0);
  CHECK(number_printed("-0.0") == 0);
  CHECK(number_printed("010") == 10);
  CHECK(number_printed("0.1") == rational(1, 10));
  CHECK(number_printed("-1.25e-07") == rational(-1, 8'000'000));
  CHECK(number_printed("+2.5E+3") == 2500);
  const rational long_one = number_printed("-0.002016944987362138063308463352034424868111");
  CHECK(long_one < number_printed("-0.002016944987362138063308463352034424868110"));
}

TEST_CASE("what is no decimal and no fraction is refused") {
  for (const char* words : {"", "-", ".", "1/0", "1/", "/2", "1.5/2", "1e", "1e+", "1e99999", "0x10", "1_000",
                            "inf", "nan", " 1", "--1"}) {
    INFO(words);
    CHECK_THROWS_AS(number_printed(words), std::invalid_argument);
  }
}

TEST_CASE("a printed number is the exact one rounded, cut, or neither") {
  const rational two_thirds(2, 3);
  CHECK(printing_of("0.667", two_thirds) == printing::rounded);
  CHECK(printing_of("0.666", two_thirds) == printing::cut);
  CHECK(printing_of("0.665", two_thirds) == printing::neither);
  CHECK(printing_of("0.668", two_thirds) == printing::neither);
  CHECK(printing_of("1/13", two_thirds) == printing::neither);
  CHECK(printing_of("2/3", two_thirds) == printing::rounded);
  CHECK(printing_of("-0.667", -two_thirds) == printing::rounded);
  CHECK(printing_of("-0.666", -two_thirds) == printing::cut);
  CHECK(printing_of("0.667", -two_thirds) == printing::neither);
  CHECK(printing_of("6.67e-1", two_thirds) == printing::rounded);
  CHECK(printing_of("66.6e-2", two_thirds) == printing::cut);
  CHECK(printing_of("2e1", rational(17)) == printing::rounded);
  CHECK(printing_of("1e1", rational(17)) == printing::cut);
}

TEST_CASE("a cut number that is the nearest one too is rounded, and a half may go either way") {
  CHECK(printing_of("0.333", rational(1, 3)) == printing::rounded);
  CHECK(printing_of("0.12", rational(1, 8)) == printing::rounded);
  CHECK(printing_of("0.13", rational(1, 8)) == printing::rounded);
}

TEST_CASE("zeros at the end are digits") {
  CHECK(printing_of("0.5", number_printed("0.504")) == printing::rounded);
  CHECK(printing_of("0.500", number_printed("0.504")) == printing::neither);
}

TEST_CASE("0 agrees with 0 alone") {
  CHECK(printing_of("0.0", rational(0)) == printing::rounded);
  CHECK(printing_of("0.0", rational(1, 1000)) == printing::neither);
  CHECK(printing_of("0.1", rational(0)) == printing::neither);
}
