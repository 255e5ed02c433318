// Tests numbers: their bits, decimals, sums of two doubles, exact rationals, random numbers, and the
// floating-point probe.
#include <bit>
#include <cfenv>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/number/bits.hpp"
#include "contct/number/decimal.hpp"
#include "contct/number/probe.hpp"
#include "contct/number/random.hpp"
#include "contct/number/rational.hpp"
#include "contct/text/strings.hpp"

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

using namespace contct;

namespace {
constexpr double infinite = std::numeric_limits<double>::infinity(),
                 least = std::numeric_limits<double>::denorm_min();
}

TEMPLATE_TEST_CASE("in a comparison to the bit, NaN equals NaN, but -0 differs from +0", "", float, double) {
  using Real = TestType;
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  CHECK(same_bits(Real(0.1), Real(0.1)));
  CHECK(same_bits(nan, -nan));
  CHECK_FALSE(same_bits(Real(0), -Real(0)));
  CHECK_FALSE(same_bits(nan, Real(1)));
  CHECK_FALSE(same_bits(Real(1), nan));
  CHECK_FALSE(same_bits(Real(1), std::nextafter(Real(1), Real(2))));
}

TEMPLATE_TEST_CASE("the distance of two numbers in ULPs is the number of steps between representable numbers",
                   "", float, double) {
  using limits = std::numeric_limits<TestType>;
  const TestType one = 1;
  CHECK(ulps_between(one, one) == 0);
  CHECK(ulps_between(one, std::nextafter(one, TestType(2))) == 1);
  CHECK(ulps_between(one, one + limits::epsilon()) == 1);
  CHECK(ulps_between(-TestType(0), TestType(0)) == 1);
  CHECK(ulps_between(-limits::denorm_min(), limits::denorm_min()) == 3);
  CHECK(ulps_between(one, limits::quiet_NaN()) == std::numeric_limits<std::uint64_t>::max());
  // The distance between the largest negative and positive numbers does not overflow.
  CHECK(ulps_between(-limits::infinity(), limits::infinity()) ==
        2 * static_cast<std::uint64_t>(place_of(limits::infinity())) + 1);
}

TEST_CASE("a double is written as a hex float with the same value") {
  for (const auto& [x, words] :
       {std::pair(1.5, "0x1.8p+0"), {-0.0, "-0x0p+0"}, {0.1, "0x1.999999999999ap-4"}, {infinite, "inf"}})
    CHECK(hexfloat(x) == words);
  CHECK(std::strtod(hexfloat(1e-310).c_str(), nullptr) == 1e-310);
}

TEST_CASE("stands_for ignores zeros, signs and the form of the exponent of a number") {
  for (const char* same : {"0.25", ".25", "25e-2", "+0.2500", "2_5E-0_2", "2.5d-1", "0.025D+01", "00.25",
                           "0.2500000000000000000000", "000000000000000000000.25"}) {
    INFO(same);
    CHECK(stands_for(same, 0.25));
    CHECK_FALSE(stands_for(same, least));
  }
  using row = std::tuple<const char*, double, bool>;
  for (const auto& [words, x, stands] :
       {row{"0", 0.0, true},
        {"-0.0", 0.0, true},
        {"0e999999999999999999", 0.0, true},
        {".0", 0.0, true},
        {"1.0000000000000000000000e-1", 0.1, true},
        {"0.10000000000000000555", 0.1, false},
        {"5e-324", 5e-324, true},
        {"4.9e-324", 5e-324, false},
        {"1e-400", 0.0, false},
        {"6283.1853069999997", 6283.185307, true},  // the 17 digits of this double
        {"6283.1853069999996", 6283.185307, false},
        {"6283.18530699999965", 6283.185307, false},
        {"2.9999999999999999e-1", 0.3, true},
        {"0.30000000000000001", 0.3, false}}) {
    INFO(words);
    CHECK(stands_for(words, x) == stands);
  }
  // Text that is not a decimal has no shortest decimal.
  for (const char* none : {"", "-", ".", "inf", "0x10", "1e", "1e+", "1 ", "1.2.3", "e5"})
    CHECK(stands_for(none, least));
  CHECK(shortest_decimal(0.25) == decimal{false, "25", -2});
  CHECK(shortest_decimal(-2.5e-300) == decimal{true, "25", -301});
  CHECK(shortest_decimal(-1000.0) == decimal{true, "1", 3});
}

TEST_CASE("zeros at the end of a number are significant digits, and zeros at its front are none") {
  for (const char* four : {"1.250", "0.001250", "-1250", "1_25.0e-7", "+0012.50"})
    CHECK(significant_digits(four) == 4);
  for (const char* none : {"0", "0.000", "", "x"}) CHECK(significant_digits(none) == 0);
}

TEST_CASE("the warning about a long number quotes it and the shortest decimal in less than 150 bytes") {
  const std::string used = ", is used everywhere";
  CHECK(rounding_words("0.10000000000000000555", 0.1) ==
        "found 0.10000000000000000555; the shortest decimal of its double, 0.1" + used);
  CHECK(rounding_words("1152921504606846976", 0x1p60) ==
        "found 1152921504606846976; the shortest decimal of its double, 1.152921504606847e+18" + used);
  CHECK(rounding_words(printable("1" + std::string(500, '0') + "e-500"), 1.0).size() < 150);
}

TEST_CASE("sums, products and quotients in double-double keep digits that a double would round away") {
  const double_double x = double_double(1.0) + 0x1p-80;
  CHECK(x.hi == 1.0);
  CHECK(x.lo == 0x1p-80);
  CHECK((x - 1.0).hi == 0x1p-80);
  CHECK(((x * x) - 1.0).hi == 0x1p-79);  // 2^-160 is below the precision
  CHECK(std::abs((double_double(1.0) / 3 * 3 - 1.0).hi) <= 0x1p-100);
  CHECK(std::abs((double_double(22.0) / 7 * 7 - 22.0).hi) <= 22 * 0x1p-100);
  CHECK(exact_product(0x1.0000001p0, 0x1.0000001p0).lo != 0.0);
}

TEST_CASE("the floating-point probe finds this build strict, and detects rounding modes and flushing") {
  INFO(describe(probe_floating_point()));
  CHECK(probe_floating_point().strict());
  CHECK(describe(probe_floating_point()) == "strict");
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    const floating_point found = probe_floating_point();
    std::fesetround(FE_TONEAREST);
    CHECK_FALSE(found.strict());
    CHECK(describe(found).find("rounding mode") != std::string::npos);
  }
#ifdef __SSE2__
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8000);  // FTZ
  const floating_point flushed = probe_floating_point();
  _mm_setcsr(before | 0x0040);  // DAZ
  const floating_point zeroed = probe_floating_point();
  _mm_setcsr(before);
  CHECK(describe(flushed) == "subnormal results are flushed to zero");
  CHECK(describe(zeroed).find("subnormal operands count as zero") != std::string::npos);
  CHECK(probe_floating_point().strict());
#endif
}

TEST_CASE("splitmix64 gives its published first numbers for seed 1234567") {
  random_numbers r(1234567);
  for (const std::uint64_t published :
       {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL})
    CHECK(r.bits() == published);
}

TEST_CASE("random whole numbers reach both ends of a given range and never exceed them") {
  random_numbers r(1);
  std::set<int> seen;
  for (int i = 0; i < 1000; ++i) {
    seen.insert(r.whole(-3, 5));
    const double u = r.unit();
    REQUIRE((u >= 0.0 && u < 1.0));
  }
  CHECK(seen == std::set<int>{-3, -2, -1, 0, 1, 2, 3, 4, 5});
}

TEST_CASE("decimal_of gives the shortest decimal that is read as the given double") {
  const auto ten = [](unsigned power) { return integer(boost::multiprecision::pow(integer(10), power)); };
  for (const auto& [x, exactly] : {std::pair(0.1, rational(1, 10)),
                                   {-2.5e-7, rational(-1, 4000000)},
                                   {1200.0, rational(1200)},
                                   {0.0, rational(0)},
                                   {10.92, rational(273, 25)},
                                   {1e308, rational(ten(308))},
                                   {5e-324, rational(integer(5), ten(324))}})
    CHECK(decimal_of(x) == exactly);
}

TEST_CASE("binary_value gives the exact value of a double, and refuses infinity and NaN") {
  CHECK(binary_value(0.75) == rational(3, 4));
  CHECK(binary_value(0.1) == rational(integer("3602879701896397"), integer("36028797018963968")));
  CHECK(binary_value(-8.0) == -8);
  CHECK(binary_value(least) * rational(integer(1) << 1074U) == 1);
  CHECK_THROWS_AS(binary_value(infinite), std::domain_error);
  CHECK_THROWS_AS(binary_value(std::nan("")), std::domain_error);
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
  CHECK(rounded(rational(huge)) == infinite);
  CHECK(rounded(rational(integer(-1), huge)) == 0.0);
}

TEST_CASE("the low part of a decimal in double-double is the same with and without rational numbers") {
  CHECK(long_decimal_of(0.5).lo == 0.0);
  CHECK(long_decimal_of(0.1).lo == -0.4 * 0x1p-56);  // 0.1 is 0x1.999999999999ap-4 less 2/5 of 2^-56
  random_numbers random(11);
  for (int i = 0; i < 4'000; ++i) {  // most of them need no rational numbers
    const double digits = std::floor(random.unit() * std::pow(10.0, random.whole(1, 16)));
    const double x = (i % 2 == 0 ? digits : -digits) * std::pow(10.0, random.whole(-30, 5));
    const double_double fast = long_decimal_of(x), slow = long_rounded(decimal_of(x));
    REQUIRE((fast.hi == x && fast.hi == slow.hi && fast.lo == slow.lo));
  }
}

TEST_CASE("a rational number is rounded to the nearest double, and in a tie to the even double") {
  // Halfway between a double and the next double up, and a tiny amount below and above it.
  const rational hair(integer(1), integer(1) << 2000U);
  for (const double x : {1.0, 1.0 + 0x1p-52, 0.1, 1e-300, 1e300, 3.0, 0x1p-1022, 0x1.fffffffffffffp-1023,
                         least, 3 * least, 0x1.8p-1050, std::numeric_limits<double>::max()}) {
    const double next = std::nextafter(x, infinite);
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
  }
  CHECK(rounded(binary_value(least) / 2) == 0.0);
  CHECK(rounded(binary_value(least) / 2 + hair) == least);
}

TEST_CASE("a short fraction is written as a fraction, and a long one as a decimal") {
  CHECK(fraction_words(rational(-208, 58875)) == "-208/58875");
  CHECK(fraction_words(7) == "7");
  using row = std::tuple<rational, int, const char*>;
  const row rows[] = {{rational(-208, 58875), 8, "-208/58875"},
                      {rational(-208, 58875), 7, "-0.003532909"},
                      {rational(2, 3), 1, "0.7"},
                      {rational(999999, 1000), 3, "1000"},
                      {rational(123456789, 1000), 5, "123460"},
                      {rational(integer(1), integer("30000000000")), 4, "3.333e-11"},
                      {rational(integer(100), integer("1000000000007")), 6, "1.00000e-10"},
                      {rational(1000000001, 10), 4, "100000000"},
                      {rational(integer("-100000000000001"), integer("1000000000000")), 6, "-100.000"},
                      {rational(integer(1), integer("1000000000000000000000")), 5, "1e-21"},
                      {rational(0), 1, "0"}};
  for (const auto& [x, digits, words] : rows) CHECK(short_words(x, digits) == words);
}
