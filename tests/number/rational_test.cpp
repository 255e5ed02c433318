// Tests conversions between decimals, doubles and exact rationals.
#include "contct/number/rational.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/number/random.hpp"

using namespace contct;

TEST_CASE("decimal_of gives the shortest decimal that is read as the given double") {
  CHECK(decimal_of(0.1) == rational(1, 10));
  CHECK(decimal_of(-2.5e-7) == rational(-1, 4000000));
  CHECK(decimal_of(1200.0) == 1200);
  CHECK(decimal_of(0.0) == 0);
  CHECK(decimal_of(10.92) == rational(273, 25));
  CHECK(decimal_of(1e308) == rational(boost::multiprecision::pow(integer(10), 308U)));
  CHECK(decimal_of(5e-324) == rational(integer(5), boost::multiprecision::pow(integer(10), 324U)));
}

TEST_CASE("binary_value gives the exact value of a double, and refuses infinity and NaN") {
  CHECK(binary_value(0.75) == rational(3, 4));
  CHECK(binary_value(0.1) == rational(integer("3602879701896397"), integer("36028797018963968")));
  CHECK(binary_value(-8.0) == -8);
  CHECK(binary_value(std::numeric_limits<double>::denorm_min()) * rational(integer(1) << 1074U) == 1);
  CHECK_THROWS_AS(binary_value(std::numeric_limits<double>::infinity()), std::domain_error);
  CHECK_THROWS_AS(binary_value(std::numeric_limits<double>::quiet_NaN()), std::domain_error);
}

TEST_CASE("a rational number of any length is rounded to a double correctly") {
  CHECK(rounded(rational(1, 3)) == 1.0 / 3.0);
  CHECK(rounded(rational(-1, 10)) == -0.1);
  CHECK(rounded(0) == 0.0);
  const integer huge = boost::multiprecision::pow(integer(10), 5000U);
  CHECK(rounded(rational(integer(huge + 1), integer(huge * 4))) == 0.25);
  const integer between = (integer(1) << 53U) + 1;  // halfway between two doubles
  CHECK(rounded(rational(between)) == 0x1p53);
  CHECK(rounded(rational(integer((between << 200U) + 1), integer(integer(1) << 200U))) == 0x1p53 + 2);
  const double_double third = long_rounded(rational(1, 3));
  CHECK(third.hi == 1.0 / 3.0);
  CHECK(abs(binary_value(third.hi) + binary_value(third.lo) - rational(1, 3)) <
        rational(integer(1), integer(integer(1) << 107U)));
  CHECK(rounded(rational(huge)) == std::numeric_limits<double>::infinity());
  CHECK(rounded(rational(integer(-1), huge)) == 0.0);
}

TEST_CASE("the low part of a decimal in double-double is the same with and without rational numbers") {
  CHECK(long_decimal_of(0.5).lo == 0.0);
  CHECK(long_decimal_of(0.1).lo == -0.4 * 0x1p-56);  // 0.1 is 0x1.999999999999ap-4 less 2/5 of 2^-56
  contct::random_numbers random(11);
  std::size_t compared = 0;
  for (int i = 0; i < 20'000; ++i) {  // most of them need no rational numbers
    const double digits = std::floor(random.unit() * std::pow(10.0, random.whole(1, 16)));
    const double x = (i % 2 == 0 ? digits : -digits) * std::pow(10.0, random.whole(-30, 5));
    const double_double fast = long_decimal_of(x);
    const double_double slow = long_rounded(decimal_of(x));
    compared += fast.hi == x && fast.hi == slow.hi && fast.lo == slow.lo ? 1 : 0;
  }
  CHECK(compared == 20'000);
}

TEST_CASE("a rational number is rounded to the nearest double, and in a tie to the even double") {
  // Halfway between a double and the next double up, and a tiny amount below and above it.
  const double least = std::numeric_limits<double>::denorm_min();
  const rational hair(integer(1), integer(1) << 2000U);
  std::size_t compared = 0;
  for (const double x : {1.0, 1.0 + 0x1p-52, 0.1, 1e-300, 1e300, 3.0, 0x1p-1022, 0x1.fffffffffffffp-1023,
                         least, 3 * least, 0x1.8p-1050, std::numeric_limits<double>::max()}) {
    const double next = std::nextafter(x, std::numeric_limits<double>::infinity());
    const rational step = std::isfinite(next)
                              ? rational(binary_value(next) - binary_value(x))
                              : rational(binary_value(x) - binary_value(std::nextafter(x, 0.0)));
    const rational half = binary_value(x) + step / 2;
    CHECK(rounded(half - hair) == x);
    CHECK(rounded(half + hair) == next);
    CHECK(rounded(-half - hair) == -next);
    const double even = rounded(half);
    CHECK((even == x || even == next));
    CHECK((std::bit_cast<std::uint64_t>(even) & 1U) == 0);
    ++compared;
  }
  CHECK(compared == 12);
  CHECK(rounded(binary_value(least) / 2) == 0.0);
  CHECK(rounded(binary_value(least) / 2 + hair) == least);
}

TEST_CASE("a short fraction is written as a fraction, and a long one as a decimal") {
  CHECK(fraction_words(rational(-208, 58875)) == "-208/58875");
  CHECK(fraction_words(7) == "7");
  CHECK(short_words(rational(-208, 58875), 8) == "-208/58875");
  CHECK(short_words(rational(-208, 58875), 7) == "-0.003532909");
  CHECK(short_words(rational(2, 3), 1) == "0.7");
  CHECK(short_words(rational(999999, 1000), 3) == "1000");
  CHECK(short_words(rational(123456789, 1000), 5) == "123460");
  CHECK(short_words(rational(integer(1), integer("30000000000")), 4) == "3.333e-11");
  CHECK(short_words(rational(integer(100), integer("1000000000007")), 6) == "1.00000e-10");
  CHECK(short_words(rational(1000000001, 10), 4) == "100000000");
  CHECK(short_words(rational(integer("-100000000000001"), integer("1000000000000")), 6) == "-100.000");
  CHECK(short_words(rational(integer(1), integer("1000000000000000000000")), 5) == "1e-21");
  CHECK(short_words(0, 1) == "0");
}
