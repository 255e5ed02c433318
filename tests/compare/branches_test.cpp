// Tests the counted outcomes of the listing's IFs, and the margins of these decisions.
#include "contct/compare/branches.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

/// Returns the margin of one decision of a call.
std::uint64_t margin_of(small_call<double> c, branch what, std::size_t pair) {
  std::optional<std::uint64_t> margin;
  const answered_call answered = c.ask().answered();
  for_each_decision(answered.c, answered.isep_before, [&](branch b, std::size_t i, bool, double x, double y) {
    if (b == what && i == pair) margin = margin_between(x, y);
  });
  REQUIRE(margin);
  return *margin;
}

bool any(branch /*b*/, std::size_t /*pair*/) {
  return true;
}

}  // namespace

TEST_CASE("true and false outcomes of each IF of the listing are counted separately") {
  small_call<double> c({{0.0, 0.0, 1.0, separated, face_above},     // no response
                        {0.0, 1.0, 0.0, in_contact, face_below},    // stationary and pulled: breaks
                        {0.0, -1.0, 0.0, in_contact, face_below},   // stationary and pressed: no event
                        {0.0, 1.0, -0.5, separated, face_below}});  // moving away
  const answered_call answered = c.ask().answered();
  branch_counts counts;
  counts.count(answered.c, answered.isep_before);
  CHECK(counts.of(branch::no_response, true) == 1);
  CHECK(counts.of(branch::no_response, false) == 3);
  CHECK(counts.of(branch::stationary, true) == 2);
  CHECK(counts.of(branch::stationary, false) == 1);
  CHECK(counts.of(branch::check_positive, true) == 1);
  CHECK(counts.of(branch::check_positive, false) == 1);
  CHECK(counts.of(branch::s_positive, true) == 3);
  CHECK(counts.of(branch::s_positive, false) == 1);
  CHECK(counts.of(branch::s_is_smallest, true) == 1);
  CHECK(counts.of(branch::s_is_smallest, false) == 2);
  CHECK(counts.of(branch::no_events, false) == 1);
  CHECK(counts.of(branch::within_epsmul, true) == 1);
  CHECK(counts.of(branch::within_epsmul, false) == 3);
  CHECK(counts.of(branch::was_separated, false) == 1);
  CHECK(counts.rarest() == 0);  // neither a call without events nor a make occurred
}

TEST_CASE(
    "if s is one ULP inside EPSMUL, DIFF is 512 ULP from the threshold (branch margin), and at the edge 0") {
  const double edge = 0.5 + 0.5 / 256;
  for (const auto& [face, ulps] : {std::pair(edge, 0UL), {std::nextafter(edge, 0.0), 1UL}}) {
    const small_call<double> c(
        {{0.0, 1.0, 0.5, separated, face_above}, {0.0, 1.0, face, separated, face_above}});
    // Below 2^-8 numbers are 2^-61 apart; one ULP of s = 0.5 is 2^-53, and changes DIFF by 2^-52.
    CHECK(margin_of(c, branch::within_epsmul, 1) == ulps * 512);
  }
}

TEST_CASE(
    "if a gap is one ULP below EPSGAP, the nearest IF (branch margin) is that of the gap, at a distance of "
    "one ULP") {
  small_call<double> c({{0.0, 1.0, std::nextafter(1e-10, 0.0), separated, face_above}});
  CHECK(margin_of(c, branch::stationary, 0) == 1);
  const std::optional<decision> least = narrowest_decision(c.ask().answered(), 8, any);
  REQUIRE(least);
  CHECK(words_of(*least) == "pair 1: IF (ABS(GAP).LT.EPSGAP) was true by 1 ULP");
}

TEST_CASE("a response of +0 or -0 is exactly on the threshold of IF (DTEST(NDOF).EQ.0.)") {
  const auto margin = [](double d_star) {
    return margin_of(small_call<double>({{0.0, d_star, 0.5, separated, face_above}}), branch::no_response, 0);
  };
  CHECK(margin(0.0) == 0);
  CHECK(margin(-0.0) == 0);
  CHECK(margin(std::numeric_limits<double>::denorm_min()) == 1);
}

TEST_CASE("a comparison with NaN has no distance to a threshold (branch margin), and the message names NaN") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
  CHECK(margin_of(small_call<double>({{nan, 1.0, 0.5, separated, face_above}}), branch::stationary, 0) ==
        most);
  CHECK(words_of({branch::stationary, 0, false, most}) ==
        "pair 1: IF (ABS(GAP).LT.EPSGAP) was false, with NaN");
}

TEST_CASE(
    "in a call with 4-byte REAL, the distance to a threshold (branch margin) is counted in 4-byte numbers") {
  const auto face = static_cast<double>(std::nextafter(1e-10F, 0.0F));
  small_call<double> c({{0.0, 1.0, face, separated, face_above}});
  const std::optional<decision> least = narrowest_decision(c.ask().answered(), 4, any);
  REQUIRE(least);
  CHECK(least->what == branch::stationary);
  CHECK(least->ulps == 1);
}
