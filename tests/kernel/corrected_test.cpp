// Tests the corrected kernel, one call at a time.
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/kernel/contct.hpp"
#include "contct/number/bits.hpp"
#include "contct/number/random.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Returns the event of a call, from its statuses before and after; the test fails if several pairs changed.
std::optional<event> event_between(const std::vector<int>& before, const std::vector<int>& after) {
  std::optional<event> found;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] == after[i]) continue;
    REQUIRE_FALSE(found.has_value());
    found = event{static_cast<int>(i), after[i] == in_contact ? change::make : change::break_};
  }
  return found;
}

/// A call answered by the corrected kernel.
struct answered : small_call<double> {
  std::optional<event> happened;

  explicit answered(const std::vector<pair_at<double>>& pairs) : small_call<double>(pairs) {
    before = isep;
    call<double> c = arguments();
    contct_corrected(c);
    smin = c.smin;
    happened = event_between(before, isep);
  }
};

const std::optional<event> nothing;
std::optional<event> makes(int pair) {
  return event{pair, change::make};
}
std::optional<event> breaks(int pair) {
  return event{pair, change::break_};
}

/// Returns a random pair at its face, before it or beyond it by rounding or more, with or without a response.
pair_at<double> random_pair(random_numbers& r) {
  pair_at<double> p{};
  p.isep = r.chance(0.5) ? apart : touching;
  p.isurf = r.chance(0.5) ? above : below;
  p.c = r.chance(0.2) ? 0.0 : 2 * r.unit() - 1;
  const double gap = r.chance(0.3) ? 0.0 : std::ldexp(r.unit() - 0.2, r.whole(-60, 1));
  p.d = p.c - p.isep * p.isurf * gap;
  p.d_star = r.chance(0.1) ? 0.0 : std::ldexp(2 * r.unit() - 1, r.whole(-40, 2));
  return p;
}

std::vector<pair_at<double>> random_pairs(random_numbers& r) {
  std::vector<pair_at<double>> pairs(static_cast<std::size_t>(r.whole(1, 7)));
  for (auto& p : pairs) p = random_pair(r);
  return pairs;
}

/// Checks that the answers for random pairs and for these pairs after `changed` are equal.
template <class Change>
void check_unchanged(const Change& changed) {
  random_numbers r(101);
  int events = 0;
  int resting = 0;
  for (int round = 0; round < 20000; ++round) {
    const std::vector<pair_at<double>> pairs = random_pairs(r);
    std::vector<pair_at<double>> others;
    for (const pair_at<double>& p : pairs) others.push_back(changed(p));
    const answered here(pairs);
    const answered there(others);
    INFO(round);
    REQUIRE(same_bits(there.smin, here.smin));
    for (std::size_t i = 0; i < pairs.size(); ++i) REQUIRE(same_bits(there.ss[i], here.ss[i]));
    REQUIRE(there.happened == here.happened);
    events += here.happened ? 1 : 0;
    resting += here.smin == 0.0 ? 1 : 0;
  }
  CHECK(events > 10000);
  CHECK(resting > 3000);
}

}  // namespace

TEST_CASE(
    "the corrected kernel makes contact when a pair reaches its face, and breaks contact on return to the "
    "face") {
  const answered closes({{-1.0, -4.0, -2.0, apart, below}});
  CHECK(closes.smin == 0.25);
  CHECK(closes.ss[0] == 0.25);
  CHECK(closes.isep[0] == touching);
  CHECK(closes.happened == makes(0));
  const answered opens({{-3.0, 4.0, -2.0, touching, below}});
  CHECK(opens.smin == 0.25);
  CHECK(opens.isep[0] == apart);
  CHECK(opens.happened == breaks(0));
}

TEST_CASE("the corrected kernel makes contact only on approach, and breaks contact only on retreat") {
  // By eq. 4 each pair has an s in (0, 1), but each moves the wrong way for an event.
  const answered c({{-3.0, 4.0, -2.0, apart, below},      // separated, below its face, moving up
                    {3.0, -4.0, 2.0, apart, above},       // the same for a face above
                    {-1.0, -4.0, -2.0, touching, below},  // in contact, above its face, moving down
                    {1.0, 4.0, 2.0, touching, above}});   // the same for a face above
  CHECK(c.happened == nothing);
  CHECK(c.smin == 1.0);
  CHECK(c.ss == std::vector<double>{1, 1, 1, 1});
  CHECK(c.isep == std::vector<int>{apart, apart, touching, touching});
}

TEST_CASE(
    "the corrected kernel has no event for pairs without a response or at full load, and gives them s = 1") {
  const answered c({{0.0, -1.0, -1.0, apart, below},      // exactly at full load
                    {0.0, -1.0, -2.0, apart, below},      // beyond full load
                    {0.0, 1.0, -2.0, apart, below},       // moving away
                    {0.0, 0.0, -2.0, apart, below},       // no response
                    {0.0, 0.0, 0.0, apart, below},        // no response at its face
                    {-1.0, 0.0, 0.0, touching, below}});  // pressed, without a response
  CHECK(c.happened == nothing);
  CHECK(c.smin == 1.0);
  CHECK(c.ss == std::vector<double>(6, 1.0));
}

TEST_CASE(
    "the answer of the corrected kernel does not depend on where the arrays hold the dofs of the pairs") {
  random_numbers random(31);
  int happened = 0;
  for (int round = 0; round < 2000; ++round) {
    const std::vector<pair_at<double>> pairs = random_pairs(random);
    const answered in_order(pairs);
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
    call<double> c = elsewhere.arguments();
    c.dof = {2, 3};
    contct_corrected(c);
    CHECK(c.smin == in_order.smin);
    CHECK(elsewhere.ss == in_order.ss);
    CHECK(elsewhere.isep == in_order.isep);
    happened += in_order.happened ? 1 : 0;
  }
  CHECK(happened >= 500);
}

TEST_CASE("the corrected kernel counts a face as reached if a pair is beyond it by any amount") {
  for (const double beyond : {0.0, eps, 1e-9, 0.1}) {
    const answered makes_at_once({{-1.0 - beyond, -1.0, -1.0, apart, below}});
    CHECK(makes_at_once.smin == 0.0);
    CHECK_FALSE(std::signbit(makes_at_once.smin));
    CHECK(makes_at_once.happened == makes(0));
    const answered breaks_at_once({{-1.0 + beyond, 1.0, -1.0, touching, below}});
    CHECK(breaks_at_once.smin == 0.0);
    CHECK(breaks_at_once.happened == breaks(0));
  }
}

TEST_CASE("the corrected kernel does not round a gap to zero, however small the gap is") {
  // The listing treats every gap below 1e-10 as zero.
  const answered c({{0.0, -4e-11, -1e-11, apart, below}});
  CHECK(c.smin == 0.25);
  const answered tiny({{0.0, -4e-300, -1e-300, apart, below}});
  CHECK(tiny.smin == 0.25);
}

TEST_CASE(
    "the corrected kernel ignores an approach below 1e-10 of the largest response, but ignores no break") {
  const auto ask = [](double d_star, int isep) {
    // The first pair is at its face; the second has a response of 1 and no event.
    return answered({{0.0, isep * -d_star, 0.0, isep, below}, {0.0, 1.0, -5.0, apart, below}}).happened;
  };
  CHECK(ask(1e-10, apart) == nothing);  // exactly at the threshold
  CHECK(ask(std::nextafter(1e-10, 0.0), apart) == nothing);
  CHECK(ask(std::nextafter(1e-10, 1.0), apart) == makes(0));
  // A break is never ignored, because the pair would keep a wrong force.
  CHECK(ask(1e-10, touching) == breaks(0));
  CHECK(ask(1e-200, touching) == breaks(0));
  CHECK(ask(std::numeric_limits<double>::denorm_min(), touching) == breaks(0));
}

TEST_CASE(
    "the largest response in the corrected kernel is that of all pairs, above or below, in any status") {
  for (const int isep : {apart, touching}) {
    for (const double other : {-1.0, 1.0}) {
      // The other pair has no event in this call.
      const double face = isep * other > 0 ? 9.0 : -9.0;
      const answered c({{0.0, -1e-11, 0.0, apart, below}, {0.0, other, face * isep, isep, above}});
      CHECK(c.happened == nothing);
    }
  }
}

TEST_CASE(
    "the corrected kernel toggles only the first pair with the least s, and no other pair of a tie or near "
    "tie") {
  const answered tie({{0.0, -1.0, -0.5, apart, below},
                      {0.0, 2.0, 0.5, apart, above},
                      {0.0, 1.0, 0.25, apart, above},
                      {0.0, -1.0, -0.25 * (1 + eps), apart, below}});
  CHECK(tie.smin == 0.25);
  CHECK(tie.ss == std::vector<double>{0.5, 0.25, 0.25, 0.25 * (1 + eps)});
  CHECK(tie.happened == makes(1));
  CHECK(tie.isep == std::vector<int>{apart, touching, apart, apart});
}

TEST_CASE("of pairs at their faces, the corrected kernel toggles the first one with the largest response") {
  const std::vector<pair_at<double>> pairs = {{0.0, -0.5, 0.0, apart, below},
                                              {0.0, 2.0, 0.0, touching, below},
                                              {0.0, -2.0, 0.0, touching, above},
                                              {0.0, -1.0, -1e-12, apart, below}};
  const answered c(pairs);
  CHECK(c.smin == 0.0);
  CHECK(c.ss == std::vector<double>{0.0, 0.0, 0.0, 1e-12});
  CHECK(c.happened == breaks(1));
  CHECK(c.isep == std::vector<int>{apart, apart, touching, apart});
}

TEST_CASE("the corrected kernel has no event in a call without pairs or in a call with NaN") {
  CHECK(answered({}).happened == nothing);
  CHECK(answered({}).smin == 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(answered({{0.0, nan, 0.5, apart, above}}).happened == nothing);
}

TEST_CASE("in another unit of length, the corrected kernel gives the same s and statuses to the bit") {
  for (const int power : {-600, -40, 33, 600}) {
    INFO(power);
    check_unchanged([power](const pair_at<double>& p) -> pair_at<double> {
      return {std::ldexp(p.d, power), std::ldexp(p.d_star, power), std::ldexp(p.c, power), p.isep, p.isurf};
    });
  }
}

TEST_CASE(
    "for a structure turned upside down, the corrected kernel gives the same s and statuses to the bit") {
  check_unchanged([](const pair_at<double>& p) -> pair_at<double> {
    return {-p.d, -p.d_star, -p.c, p.isep, -p.isurf};
  });
}

TEST_CASE(
    "the corrected kernel gives each pair an s from 0 to 1, and toggles only pairs whose s is the least, "
    "SMIN") {
  random_numbers r(103);
  for (int round = 0; round < 20000; ++round) {
    const std::vector<pair_at<double>> pairs = random_pairs(r);
    const answered a(pairs);
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
      REQUIRE(a.happened ==
              event{static_cast<int>(i), pairs[i].isep == apart ? change::make : change::break_});
    }
    REQUIRE(a.smin == least);
    REQUIRE(toggled == (a.smin < 1.0 ? 1 : 0));
    REQUIRE(a.happened.has_value() == (toggled == 1));
  }
}
