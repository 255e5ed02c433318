#include "contct/number/bits.hpp"

#include <cmath>

#include "catch.hpp"

using namespace contct;

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
  using Real = TestType;
  const Real denormal = std::numeric_limits<Real>::denorm_min();
  CHECK(ulps_between(Real(1), Real(1)) == 0);
  CHECK(ulps_between(Real(1), std::nextafter(Real(1), Real(2))) == 1);
  CHECK(ulps_between(Real(1), Real(1) + std::numeric_limits<Real>::epsilon()) == 1);
  CHECK(ulps_between(-Real(0), Real(0)) == 1);
  CHECK(ulps_between(-denormal, denormal) == 3);
  CHECK(ulps_between(Real(1), std::numeric_limits<Real>::quiet_NaN()) ==
        std::numeric_limits<std::uint64_t>::max());
  // The distance between the largest negative and positive numbers does not overflow.
  CHECK(ulps_between(-std::numeric_limits<Real>::infinity(), std::numeric_limits<Real>::infinity()) ==
        2 * static_cast<std::uint64_t>(place_of(std::numeric_limits<Real>::infinity())) + 1);
}

TEST_CASE("a double is written as a hex float with the same value") {
  CHECK(hexfloat(1.5) == "0x1.8p+0");
  CHECK(hexfloat(-0.0) == "-0x0p+0");
  CHECK(hexfloat(0.1) == "0x1.999999999999ap-4");
  CHECK(hexfloat(std::numeric_limits<double>::infinity()) == "inf");
  CHECK(std::strtod(hexfloat(1e-310).c_str(), nullptr) == 1e-310);
}
