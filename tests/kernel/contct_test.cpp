// Tests the C++ kernel of the 1989 rule, one call at a time.
#include "contct/kernel/contct.hpp"

#include <limits>

#include "catch.hpp"
#include "support/one_pair.hpp"

using namespace contct;

TEMPLATE_TEST_CASE("a pair makes contact at the share of the load that brings it to its face (eq. 4)", "",
                   float, double) {
  // The structure meets the face below it after 1 of the 4 units of its response.
  small_call<TestType> c({{TestType(-1), TestType(-4), TestType(-2), apart, below}});
  c.ask();
  CHECK(c.smin == TestType(0.25));
  CHECK(c.ss[0] == TestType(0.25));
  CHECK(c.isep[0] == touching);
  CHECK(c.events == std::vector<event>{{0, change::make}});
}

TEMPLATE_TEST_CASE("a pair in contact separates at the share of the load that eq. 4 gives", "", float,
                   double) {
  // The pair is at D = -3, below its face at -2, and rises by 4, so that it passes the face at a quarter of
  // its way.
  small_call<TestType> c({{TestType(-3), TestType(4), TestType(-2), touching, below}});
  c.ask();
  CHECK(c.smin == TestType(0.25));
  CHECK(c.isep[0] == apart);
  CHECK(c.events == std::vector<event>{{0, change::break_}});
}

TEST_CASE("s by eq. 4 is the same for a face above and a face below") {
  small_call<double> c({{0.0, 2.0, 1.0, apart, above}, {0.0, 2.0, 1.0, apart, below}});
  c.ask();
  CHECK(c.ss[0] == c.ss[1]);
}

TEST_CASE(
    "a pair without a response has no event, and neither has a pair whose face is out of reach or behind "
    "it") {
  small_call<double> c({{0.0, -1.0, -2.0, apart, below},    // s = 2, beyond full load
                        {0.0, 1.0, -2.0, apart, below},     // s = -2, moving away
                        {0.0, 0.0, -2.0, apart, below},     // d* = 0
                        {0.0, -1.0, -1.0, apart, below}});  // s = 1, exactly at full load
  c.ask();
  CHECK(c.smin == 1.0);
  CHECK(c.events.empty());
  CHECK(c.ss == std::vector<double>{2.0, -2.0, 1.0, 1.0});
  CHECK(c.isep == std::vector<int>{apart, apart, apart, apart});
}

TEST_CASE("of several pairs with events, the pair with the smallest s is toggled first (lemma 2)") {
  small_call<double> c(
      {{0.0, -1.0, -0.75, apart, below}, {0.0, -2.0, -0.5, apart, below}, {-1.0, 2.0, 0.5, touching, below}});
  c.ask();
  CHECK(c.smin == 0.25);
  CHECK(c.events == std::vector<event>{{1, change::make}});
}

TEMPLATE_TEST_CASE("a stationary pair that is pulled separates at once, at an s below 1e-19 (eq. 11, 12)", "",
                   float, double) {
  using Real = TestType;
  small_call<Real> c({{Real(0), Real(0.5), Real(0), touching, below},     // pulled off its face
                      {Real(0), Real(-0.5), Real(0), touching, below},    // pressed: no event
                      {Real(0), Real(-0.5), Real(0), apart, below},       // pushed towards its face: makes
                      {Real(0), Real(0.25), Real(0), touching, below}});  // pulled with a smaller response
  c.ask();
  CHECK(c.smin == Real(2) * constants<Real>::delta);
  CHECK(c.smin < Real(1e-19));
  CHECK(c.ss[1] == Real(1));
  CHECK(c.ss[3] == Real(4) * constants<Real>::delta);
  // The pair with the largest |d*| has the least s, for a make and for a break.
  CHECK(c.events == std::vector<event>{{0, change::break_}, {2, change::make}});
}

TEST_CASE("a stationary pair is toggled before every advancing pair, at an s too small to change D") {
  small_call<double> c({{0.0, -1.0, -1e-9, apart, below}, {0.25, 1e-3, 0.25, touching, below}});
  c.ask();
  CHECK(c.events == std::vector<event>{{1, change::break_}});
  CHECK(0.25 + c.smin * 1e-3 == 0.25);
}

TEMPLATE_TEST_CASE(
    "a near tie toggles every pair whose s is less than 2^-8 above the smallest s, relative to the smallest "
    "s",
    "", float, double) {
  using Real = TestType;
  const Real half = Real(0.5);
  const Real edge = half + half / Real(256);
  const auto ask = [&](Real other) {
    small_call<Real> c({{Real(0), Real(1), half, apart, above}, {Real(0), Real(1), other, apart, above}});
    return c.ask().events.size();
  };
  CHECK(ask(half) == 2);
  CHECK(ask(std::nextafter(edge, Real(0))) == 2);  // the pair makes contact before its face
  CHECK(ask(edge) == 1);
  CHECK(ask(std::nextafter(edge, Real(1))) == 1);
}

TEST_CASE(
    "a pair without an event is toggled if the smallest s exceeds 256/257, by a defect of the listing") {
  // Pair 2 is at a fixed dof, d* = 0, one unit from its face, but is toggled.
  small_call<double> c({{0.0, 1.0, 0.9999, apart, above}, {0.0, 0.0, -1.0, apart, below}});
  c.ask();
  CHECK(c.smin == 0.9999);
  CHECK(c.isep == std::vector<int>{touching, touching});
}

// Problem files refuse a pair that starts beyond its face (reference/DIVERGENCES.md, way 5).
TEST_CASE(
    "a pair that starts beyond its face gets the wrong status at its event, and the kernel gives no error") {
  small_call<double> pressed({{0.0, -1.0, 0.1, apart, below}});  // the face is inside the structure
  CHECK(pressed.ask().smin == 1.0);                              // the structure ends 1.1 beyond the face
  CHECK(pressed.ss[0] == -0.1);
  small_call<double> leaves({{0.0, 1.0, 0.1, apart, below}});
  CHECK(leaves.ask().smin == 0.1);
  CHECK(leaves.isep[0] == touching);
  small_call<double> reaches({{0.0, -1.0, -0.1, touching, below}});
  CHECK(reaches.ask().smin == 0.1);
  CHECK(reaches.isep[0] == apart);
}

TEST_CASE("EPSGAP is an absolute length, so in a small unit of length every gap counts as zero") {
  // In units in which the structure measures 1e-10, a real gap counts as zero.
  small_call<double> c({{0.0, -4e-11, -1e-11, apart, below}});
  c.ask();
  CHECK(c.smin < 1e-8);          // the right s is 0.25
  CHECK(c.isep[0] == touching);  // the pair has not reached its face
}

TEST_CASE("a call with NaN for every pair has no event") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  small_call<double> c(
      {{nan, 1.0, 0.5, apart, above}, {0.0, nan, 0.5, apart, above}, {0.0, 1.0, nan, apart, above}});
  c.ask();
  CHECK(c.smin == 1.0);
  CHECK(c.events.empty());
}

TEST_CASE("the dof of a pair is computed from ID, INDOF and NDOFPN, and one node may have several pairs") {
  // Two nodes have three dofs each, of which the second deflects.
  std::vector<double> dd(6, 0.0);
  std::vector<double> dtest = {9, 9, 9, 9, 2.0, 9};
  std::vector<double> cc = {1.0, -1.0};
  std::vector<double> ss(2);
  std::vector<int> id = {2, 2};
  std::vector<int> isep = {apart, apart};
  const std::vector<int> isurf = {above, below};
  call<double> c{dd, dtest, cc, ss, 0.0, id, isep, isurf, {2, 3}};
  std::vector<event> events(2);
  CHECK(contct::contct(c, std::span<event>(events)) == 1);
  CHECK(ss == std::vector<double>{0.5, -0.5});
  CHECK(isep == std::vector<int>{touching, apart});
}

TEST_CASE("a call without pairs has no event") {
  small_call<double> c({});
  c.ask();
  CHECK(c.smin == 1.0);
  CHECK(c.events.empty());
}

TEST_CASE(
    "EPSGAP and DELTA are rounded in single precision, but EPSMUL is exactly 1/256 in both precisions") {
  CHECK(static_cast<double>(constants<float>::delta) != constants<double>::delta);
  CHECK(static_cast<double>(constants<float>::epsgap) != constants<double>::epsgap);
  CHECK(constants<float>::epsmul == 1.0F / 256);
  CHECK(constants<double>::epsmul == 1.0 / 256);
}
