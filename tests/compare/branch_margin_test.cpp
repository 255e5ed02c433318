// Tests the branch margin of a report: the margin of the narrowest decision on which the first difference
// depends.
#include <limits>

#include "catch.hpp"
#include "contct/compare/compare.hpp"
#include "support/made_kernel.hpp"
#include "support/one_pair.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// Pair 1 reaches its face at s = 0.5, pair 2 is 5e-10 from its face, and the dof of pair 3 does not respond.
small_call<double> three_pairs() {
  return small_call<double>({{0.0, 1.0, 0.5, separated, face_above},
                             {0.0, 1e-3, 5e-10, separated, face_above},
                             {0.0, 0.0, 0.25, separated, face_above}})
      .ask();
}

/// Returns the branch margin that is reported if another kernel's answer has these changes.
template <class Change>
std::optional<decision> named(small_call<double> c, Change change) {
  call_outputs other{c.smin, c.ss, c.isep, ""};
  change(other);
  return narrowest_decision(c.answered(), 8, other);
}

}  // namespace

TEST_CASE(
    "if one SS is wrong, the nearest IF (branch margin) is one of the same pair, although another pair is "
    "nearer") {
  const auto of_gap = named(three_pairs(), [](call_outputs& o) { o.ss[1] = 1e-17; });
  REQUIRE(of_gap);
  CHECK(words_of(*of_gap).starts_with("pair 2: IF (ABS(GAP).LT.EPSGAP) was false by "));
  const auto of_response = named(three_pairs(), [](call_outputs& o) { o.ss[2] = 0.5; });
  REQUIRE(of_response);
  CHECK(words_of(*of_response) == "pair 3: IF (DTEST(NDOF).EQ.0.) was true, exactly on the threshold");
}

TEST_CASE(
    "if SMIN is wrong, the nearest IF (branch margin) is one of the wrong SS, or of the smallest SS if every "
    "SS is right") {
  const auto of_ss = named(three_pairs(), [](call_outputs& o) { o.smin = o.ss[1] = 1e-17; });
  REQUIRE(of_ss);
  CHECK(of_ss->what == branch::stationary);
  const auto of_smin = named(three_pairs(), [](call_outputs& o) { o.smin = 1.0; });
  REQUIRE(of_smin);
  CHECK(of_smin->what == branch::s_is_smallest);
}

TEST_CASE(
    "if an ISEP is wrong, the nearest IF (branch margin) tests the pair's DIFF, or SMIN if nothing was "
    "toggled") {
  // SMIN is the number next to 1, so the decision IF (SMIN.EQ.1.) has a narrower margin than any DIFF.
  const small_call<double> late = small_call<double>({{0.0, 1.0, 1.0 - 0x1p-53, separated, face_above},
                                                      {0.0, 1.0, 4.0, separated, face_above}})
                                      .ask();
  const auto of_diff = named(late, [](call_outputs& o) { o.isep[1] = in_contact; });
  REQUIRE(of_diff);
  CHECK(words_of(*of_diff).starts_with("pair 2: IF (DIFF.LT.EPSMUL) was false by "));
  const auto of_smin = named(late, [](call_outputs& o) { o.isep[0] = separated; });
  REQUIRE(of_smin);
  CHECK(words_of(*of_smin) == "IF (SMIN.EQ.1.) was false by 1 ULP");
}

TEST_CASE(
    "if two kernels toggle a pair to different statuses, the nearest IF (branch margin) is IF "
    "(ISEP(I).EQ.1)") {
  const small_call<double> odd = small_call<double>({{0.0, 1.0, 0.5, 2, face_above}}).ask();
  CHECK(odd.isep[0] == separated);
  const auto of_status = named(odd, [](call_outputs& o) { o.isep[0] = in_contact; });
  REQUIRE(of_status);
  CHECK(words_of(*of_status) == "pair 1: IF (ISEP(I).EQ.1) was false");
}

TEST_CASE("if EPSGAP = 1e-9 makes an SS wrong, this is traced to IF (ABS(GAP).LT.EPSGAP) of the same pair") {
  made_kernel wrong(
      [](call<double>& c) {
        std::vector<event> events(c.cc.size());
        (void)contct::contct(c, std::span<event>(events));
        c.ss[1] = 1e-20 / c.dtest[1];  // the s of a pair at its face
      },
      contact_rule::listing);
  small_call<double> c = three_pairs();
  follower f({"leader", 8, contact_rule::listing, "", "", "", false}, wrong);
  REQUIRE(f.ask(c.answered()));
  CHECK(f.first()->where.field == "SS");
  CHECK_THAT(words_of(*f.first())[1], Contains("pair 2: IF (ABS(GAP).LT.EPSGAP) was false") &&
                                          Contains("this smallest margin is too large for a tie"));
}
