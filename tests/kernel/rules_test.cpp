// Tests the C++ kernels of the 1989 rule and of the corrected rule, one call at a time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/number/random.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// A call and its answer.
template <class Real>
struct answered_call_row {
  const char* what = nullptr;
  std::vector<pair_at<Real>> pairs;
  struct {
    Real smin;
    std::vector<Real> ss;
    std::vector<int> isep;
  } answer;
};

template <class Real>
void check(small_call<Real>& c, const answered_call_row<Real>& row) {
  INFO(row.what);
  CHECK(same_bits(c.smin, row.answer.smin));
  CHECK(equal_bits(c.ss, row.answer.ss));
  CHECK(c.isep == row.answer.isep);
}

template <class Real>
std::vector<answered_call_row<Real>> by_the_1989_rule() {
  const auto delta = constants<Real>::delta;
  const Real half = Real(0.5), near_one = Real(0.9999), tenth = Real(0.1);
  const Real edge = half + half / Real(256), inside = std::nextafter(edge, Real(0)),
             outside = std::nextafter(edge, Real(1));
  return {
      {"no pairs", {}, {1, {}, {}}},
      {"a make at a quarter of the way (eq. 4)",
       {{-1, -4, -2, apart, below}},
       {Real(0.25), {Real(0.25)}, {touching}}},
      {"a break at a quarter of the way",
       {{-3, 4, -2, touching, below}},
       {Real(0.25), {Real(0.25)}, {apart}}},
      {"equal s for faces above and below",
       {{0, 2, 1}, {0, 2, 1, apart, below}},
       {half, {half, half}, {touching, touching}}},
      {"no event: beyond full load, moving away, d* = 0, exactly at full load",
       {{0, -1, -2, apart, below},
        {0, 1, -2, apart, below},
        {0, 0, -2, apart, below},
        {0, -1, -1, apart, below}},
       {1, {2, -2, 1, 1}, {apart, apart, apart, apart}}},
      {"the smallest s of several events (lemma 2)",
       {{0, -1, Real(-0.75), apart, below}, {0, -2, -half, apart, below}, {-1, 2, half, touching, below}},
       {Real(0.25), {Real(0.75), Real(0.25), Real(0.75)}, {apart, touching, touching}}},
      {"stationary pairs (eq. 11, 12): pulled, pressed, pushed to the face, pulled with a smaller response",
       {{0, half, 0, touching, below},
        {0, -half, 0, touching, below},
        {0, -half, 0, apart, below},
        {0, Real(0.25), 0, touching, below}},
       {2 * delta, {2 * delta, 1, 2 * delta, 4 * delta}, {apart, touching, touching, touching}}},
      {"a stationary pair before an advancing pair",
       {{0, -1, Real(-1e-9), apart, below}, {Real(0.25), Real(1e-3), Real(0.25), touching, below}},
       {1 / Real(1e-3) * delta, {Real(1e-9), 1 / Real(1e-3) * delta}, {apart, apart}}},
      {"an exact tie", {{0, 1, half}, {0, 1, half}}, {half, {half, half}, {touching, touching}}},
      {"a near tie: s less than 2^-8 above SMIN",
       {{0, 1, half}, {0, 1, inside}},
       {half, {half, inside}, {touching, touching}}},
      {"s exactly 2^-8 above SMIN", {{0, 1, half}, {0, 1, edge}}, {half, {half, edge}, {touching, apart}}},
      {"s more than 2^-8 above SMIN",
       {{0, 1, half}, {0, 1, outside}},
       {half, {half, outside}, {touching, apart}}},
      {"a defect: SMIN above 256/257 toggles a pair without an event",
       {{0, 1, near_one}, {0, 0, -1, apart, below}},
       {near_one, {near_one, 1}, {touching, touching}}},
      // Problem files refuse a pair that starts beyond its face (reference/DIVERGENCES.md, way 5).
      {"beyond its face, pressed", {{0, -1, tenth, apart, below}}, {1, {-tenth}, {apart}}},
      {"beyond its face, leaving", {{0, 1, tenth, apart, below}}, {tenth, {tenth}, {touching}}},
      {"in contact off its face, reaching it", {{0, -1, -tenth, touching, below}}, {tenth, {tenth}, {apart}}},
      {"EPSGAP is a length: a gap of 1e-11 counts as zero, although the right s is 0.25",
       {{0, Real(-4e-11), Real(-1e-11), apart, below}},
       {1 / Real(4e-11) * delta, {1 / Real(4e-11) * delta}, {touching}}},
  };
}

/// A call answered by the corrected kernel.
small_call<double> corrected(const std::vector<pair_at<double>>& pairs) {
  return small_call<double>(pairs).ask_by([](call<double>& c) { contct_corrected(c); });
}

/// Returns pairs of which the first is at its face, and the second has a response of 1 and no event.
std::vector<pair_at<double>> beside_a_response_of_1(double d_star, int isep) {
  return {{0, isep * -d_star, 0, isep, below}, {0, 1, -5, apart, below}};
}

std::vector<answered_call_row<double>> by_the_corrected_rule() {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               least = std::numeric_limits<double>::denorm_min();
  const std::vector<int> closed = {touching, apart}, open = {apart, apart};
  std::vector<answered_call_row<double>> all = {
      {"no pairs", {}, {1, {}, {}}},
      {"NaN", {{0, nan, 0.5}}, {1, {1}, {apart}}},
      {"a make", {{-1, -4, -2, apart, below}}, {0.25, {0.25}, {touching}}},
      {"a break", {{-3, 4, -2, touching, below}}, {0.25, {0.25}, {apart}}},
      // By eq. 4 each of these pairs has an s in (0, 1).
      {"pairs that move the wrong way for an event",
       {{-3, 4, -2, apart, below}, {3, -4, 2}, {-1, -4, -2, touching, below}, {1, 4, 2, touching}},
       {1, {1, 1, 1, 1}, {apart, apart, touching, touching}}},
      {"at full load, beyond it, moving away",
       {{0, -1, -1, apart, below}, {0, -1, -2, apart, below}, {0, 1, -2, apart, below}},
       {1, {1, 1, 1}, {apart, apart, apart}}},
      {"no response: off its face, at it, pressed",
       {{0, 0, -2, apart, below}, {0, 0, 0, apart, below}, {-1, 0, 0, touching, below}},
       {1, {1, 1, 1}, {apart, apart, touching}}},
      {"a gap of 1e-11, which is 0 in the listing",
       {{0, -4e-11, -1e-11, apart, below}},
       {0.25, {0.25}, {touching}}},
      {"a gap of 1e-300", {{0, -4e-300, -1e-300, apart, below}}, {0.25, {0.25}, {touching}}},
      {"an approach of 1e-10 of the largest response",
       beside_a_response_of_1(1e-10, apart),
       {1, {1, 1}, open}},
      {"an approach below it", beside_a_response_of_1(std::nextafter(1e-10, 0), apart), {1, {1, 1}, open}},
      {"an approach above it", beside_a_response_of_1(std::nextafter(1e-10, 1), apart), {0, {0, 1}, closed}},
      // A break is never ignored, because the pair would keep a wrong force.
      {"a break at 1e-10", beside_a_response_of_1(1e-10, touching), {0, {0, 1}, open}},
      {"a break at 1e-200", beside_a_response_of_1(1e-200, touching), {0, {0, 1}, open}},
      {"a break at the least response", beside_a_response_of_1(least, touching), {0, {0, 1}, open}},
      {"a tie: only the first pair with the least s",
       {{0, -1, -0.5, apart, below}, {0, 2, 0.5}, {0, 1, 0.25}, {0, -1, -0.25 * (1 + eps), apart, below}},
       {0.25, {0.5, 0.25, 0.25, 0.25 * (1 + eps)}, {apart, touching, apart, apart}}},
      {"pairs at their faces: the first one with the largest response",
       {{0, -0.5, 0, apart, below},
        {0, 2, 0, touching, below},
        {0, -2, 0, touching},
        {0, -1, -1e-12, apart, below}},
       {0, {0, 0, 0, 1e-12}, {apart, apart, touching, apart}}},
  };
  for (const double beyond : {0.0, eps, 1e-9, 0.1}) {
    all.push_back({"a face that was reached", {{-1 - beyond, -1, -1, apart, below}}, {0, {0}, {touching}}});
    all.push_back({"a face that was left", {{-1 + beyond, 1, -1, touching, below}}, {0, {0}, {apart}}});
  }
  for (const int isep : {apart, touching})
    for (const double other : {-1.0, 1.0})
      all.push_back({"the largest response is that of any pair, in any status",
                     {{0, -1e-11, 0, apart, below}, {0, other, (isep * other > 0 ? 9.0 : -9.0) * isep, isep}},
                     {1, {1, 1}, {apart, isep}}});
  return all;
}

/// Returns random pairs at their faces, before or beyond them by rounding or more, with and without a
/// response.
std::vector<pair_at<double>> random_pairs(random_numbers& r) {
  std::vector<pair_at<double>> pairs(static_cast<std::size_t>(r.whole(1, 7)));
  for (auto& p : pairs) {
    p.isep = r.chance(0.5) ? apart : touching;
    p.isurf = r.chance(0.5) ? above : below;
    p.c = r.chance(0.2) ? 0.0 : 2 * r.unit() - 1;
    const double gap = r.chance(0.3) ? 0.0 : std::ldexp(r.unit() - 0.2, r.whole(-60, 1));
    p.d = p.c - p.isep * p.isurf * gap;
    p.d_star = r.chance(0.1) ? 0.0 : std::ldexp(2 * r.unit() - 1, r.whole(-40, 2));
  }
  return pairs;
}

}  // namespace

TEMPLATE_TEST_CASE("the C++ kernel of the 1989 rule gives SMIN, SS, ISEP and events of hand calculations", "",
                   float, double) {
  using Real = TestType;
  for (const auto& row : by_the_1989_rule<Real>()) {
    small_call<Real> c(row.pairs);
    check(c.ask(), row);
    std::vector<event> events;
    for (int i = 0; i < static_cast<int>(row.answer.isep.size()); ++i)
      if (row.answer.isep[i] != row.pairs[i].isep)
        events.push_back({i, row.answer.isep[i] == touching ? change::make : change::break_});
    CHECK(c.events == events);
  }
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  small_call<Real> c({{nan, 1, Real(0.5)}, {0, nan, Real(0.5)}, {0, 1, nan}});
  CHECK(c.ask().smin == 1);
  CHECK(c.events.empty());
}

TEST_CASE("the dof of a pair is computed from ID, INDOF and NDOFPN, and one node may have several pairs") {
  // Two nodes have three dofs each, of which the second deflects.
  std::vector<double> dd(6, 0.0), dtest = {9, 9, 9, 9, 2.0, 9}, cc = {1.0, -1.0}, ss(2);
  std::vector<int> id = {2, 2}, isep = {apart, apart}, isurf = {above, below};
  call<double> c{dd, dtest, cc, ss, 0.0, id, isep, isurf, {2, 3}};
  std::vector<event> events(2);
  CHECK(contct::contct(c, std::span<event>(events)) == 1);
  CHECK(ss == std::vector<double>{0.5, -0.5});
  CHECK(isep == std::vector<int>{touching, apart});
}

TEST_CASE("EPSGAP and DELTA are rounded in single precision, EPSMUL is exactly 1/256 in both precisions") {
  CHECK(static_cast<double>(constants<float>::delta) != constants<double>::delta);
  CHECK(static_cast<double>(constants<float>::epsgap) != constants<double>::epsgap);
  CHECK(constants<float>::epsmul == 1.0F / 256);
  CHECK(constants<double>::epsmul == 1.0 / 256);
}

TEST_CASE("the corrected kernel gives SMIN, SS and ISEP of hand calculations, in 25 calls") {
  for (const auto& row : by_the_corrected_rule()) {
    small_call<double> c = corrected(row.pairs);
    check(c, row);
  }
}

TEST_CASE("in other units, upside down or with other dofs, the corrected kernel gives the same bits") {
  const auto unit = [](int power) { return std::ldexp(1.0, power); };
  random_numbers r(101);
  int events = 0, resting = 0;
  for (int round = 0; round < 4000; ++round) {
    const std::vector<pair_at<double>> pairs = random_pairs(r);
    const small_call<double> here = corrected(pairs);
    INFO(round);
    for (const double scale : {unit(-600), unit(-40), unit(33), unit(600), -1.0}) {
      std::vector<pair_at<double>> others = pairs;
      for (auto& p : others)
        p = {scale * p.d, scale * p.d_star, scale * p.c, p.isep, scale < 0 ? -p.isurf : p.isurf};
      const small_call<double> there = corrected(others);
      REQUIRE(same_bits(there.smin, here.smin));
      REQUIRE(equal_bits(there.ss, here.ss));
      REQUIRE(there.isep == here.isep);
    }
    // The pairs are at nodes in reverse order with three dofs a node, of which the second deflects.
    small_call<double> elsewhere(pairs);
    const std::size_t n = pairs.size();
    elsewhere.dd.assign(3 * n, 77.0);
    elsewhere.dtest.assign(3 * n, 9e30);  // rotations do not count as the largest response
    for (std::size_t i = 0; i < n; ++i) {
      elsewhere.id[i] = static_cast<int>(n - i);
      elsewhere.dd[3 * (n - 1 - i) + 1] = pairs[i].d;
      elsewhere.dtest[3 * (n - 1 - i) + 1] = pairs[i].d_star;
    }
    elsewhere.ask_by([](call<double>& c) {
      c.dof = {2, 3};
      contct_corrected(c);
    });
    REQUIRE(elsewhere.smin == here.smin);
    REQUIRE(elsewhere.ss == here.ss);
    REQUIRE(elsewhere.isep == here.isep);
    events += here.smin < 1.0 ? 1 : 0;
    resting += here.smin == 0.0 ? 1 : 0;
  }
  CHECK(events > 2000);
  CHECK(resting > 600);
}

TEST_CASE("the corrected kernel gives each pair an s from 0 to 1, and toggles one pair with the least s") {
  random_numbers r(103);
  for (int round = 0; round < 4000; ++round) {
    const std::vector<pair_at<double>> pairs = random_pairs(r);
    const small_call<double> a = corrected(pairs);
    INFO(round);
    double least = 1.0;
    int toggled = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      REQUIRE((a.ss[i] >= 0.0 && a.ss[i] <= 1.0));
      least = std::min(least, a.ss[i]);
      if (a.isep[i] == pairs[i].isep) continue;
      ++toggled;
      REQUIRE(a.isep[i] == -pairs[i].isep);
      REQUIRE(a.ss[i] == a.smin);
    }
    REQUIRE(a.smin == least);
    REQUIRE(toggled == (a.smin < 1.0 ? 1 : 0));
  }
}
