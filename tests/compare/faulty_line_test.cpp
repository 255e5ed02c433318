// Tests the line of the listing that is reported as faulty for a kernel's wrong answers. tests/mutants
// measures how often this line is right.
#include "contct/compare/faulty_line.hpp"

#include <cmath>

#include "catch.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

/// Pair 1 reaches its face at s = 0.5, pair 2 is at its face and not pressed, pair 3 is at a distance of
/// `gap`, and pair 4 does not respond.
small_call<double> four_pairs(double gap) {
  return small_call<double>({{0.0, 1.0, 0.5, separated, face_above},
                             {0.0, -1.0, 0.0, separated, face_above},
                             {0.0, 1.0, gap, separated, face_above},
                             {0.0, 0.0, 0.25, separated, face_above}})
      .ask();
}

/// A call with SMIN = 0.5 in which pairs 2 and 3 have these values of DIFF.
small_call<double> with_diffs(double second, double third) {
  return small_call<double>({{0.0, 1.0, 0.5, separated, face_above},
                             {0.0, 1.0, 0.5 + second / 2.0, separated, face_above},
                             {0.0, 1.0, 0.5 + third / 2.0, separated, face_above}})
      .ask();
}

/// Adds a call to `all`, with an answer of another kernel that is the right answer after `change`.
template <class Change>
void note(fault_finder& all, small_call<double> c, Change change) {
  call_outputs other{c.smin, c.ss, c.isep, ""};
  change(other);
  all.note(c.answered(), 8, other, other.ss == c.ss && other.isep == c.isep && other.smin == c.smin);
}

int line_of(const fault_finder& all) {
  const std::optional<faulty_line> line = all.found();
  return line ? line->at.number : 0;
}

}  // namespace

TEST_CASE("if all answers are equal, no line is reported as faulty") {
  fault_finder all;
  note(all, four_pairs(0.25), [](call_outputs&) {});
  CHECK_FALSE(all.found());
}

TEST_CASE(
    "for a kernel with EPSGAP = 1e-9, line 33 is reported with the gaps that the kernel treated as zero") {
  fault_finder all;
  for (const double gap : {2e-10, 5e-10}) {
    note(all, four_pairs(gap), [](call_outputs& o) {
      o.smin = o.ss[2] = 1e-20;  // the s of a pair at its face: no other pair is toggled
      o.isep = {separated, separated, in_contact, separated};
    });
  }
  note(all, four_pairs(2e-9), [](call_outputs&) {});
  REQUIRE(all.found());
  CHECK(words_of(*all.found()) ==
        "line 33, ELSE IF (ABS(GAP).LT.EPSGAP) THEN: explains all 2 values that differ, in 2 calls; in these "
        "ABS(GAP) was "
        "2e-10 to 5e-10");
}

TEST_CASE(
    "line 38 is reported for a kernel that rounds a quotient twice, and line 30 for a wrong sign of GAP") {
  fault_finder rounded, negative;
  for (const double gap : {0.3, 0.7}) {
    note(rounded, four_pairs(gap), [](call_outputs& o) { o.ss[2] = std::nextafter(o.ss[2], 1.0); });
    note(negative, four_pairs(gap), [](call_outputs& o) {
      for (const std::size_t i : {0U, 2U}) o.ss[i] = -o.ss[i];
      o.smin = 1.0;
      o.isep = {separated, separated, separated, separated};
    });
  }
  CHECK(line_of(rounded) == 38);
  CHECK(line_of(negative) == 30);
}

TEST_CASE("line 38 is reported for a kernel that cuts the quotient off at 1 or at 0") {
  fault_finder at_1, at_0;
  for (const double gap : {3.0, 5.0, 7.0}) {
    note(at_1, four_pairs(gap), [](call_outputs& o) { o.ss[2] = 1.0; });
    note(at_0, four_pairs(-gap), [](call_outputs& o) { o.ss[2] = 0.0; });
  }
  CHECK(line_of(at_1) == 38);
  CHECK(line_of(at_0) == 38);
}

TEST_CASE(
    "line 51 is reported for a product instead of the quotient DIFF, which underflows if SMIN is small") {
  fault_finder all;
  const std::vector<pair_at<double>> many(200, {0.0, 1.0, 0.5, separated, face_above});
  for (int times = 0; times < 3; ++times) {
    note(all, small_call<double>(many).ask(), [](call_outputs&) {});
    note(all, small_call<double>({{0.0, 1e303, 0.0, separated, face_above}}).ask(), [](call_outputs& o) {
      REQUIRE(o.smin == 0x2p-1074);
      o.isep[0] = separated;  // 2^-1073 / 256 is zero
    });
  }
  REQUIRE(all.found());
  CHECK(words_of(*all.found()) ==
        "line 51, DIFF = ABS(SS(I) - SMIN) / SMIN: explains all 3 values that differ, in 3 calls; lines 51 "
        "and 52 "
        "are computed in another way, which rounds or underflows");
}

TEST_CASE("an SS that is equal to the mark of an unset SS is not counted as explained") {
  fault_finder all;
  const auto first_is_unset = [](call_outputs& o) { o.ss[0] = not_an_answer; };
  note(all, small_call<double>({{0.0, 1.0, not_an_answer, separated, face_above}}).ask(), first_is_unset);
  note(all, four_pairs(3.0), [&](call_outputs& o) {
    first_is_unset(o);
    o.smin = 1.0;
    o.isep[0] = separated;
  });
  REQUIRE(all.found());
  CHECK(words_of(*all.found()) == "line 27, DO 10 I = 1, NC: explains the 1 value that differs, in 1 call");
}

#ifdef __SSE2__
TEST_CASE("flushed subnormals are reported instead of a line, but not for a kernel that keeps some of them") {
  fault_finder flushes, tolerates;
  for (int times = 0; times < 3; ++times) {
    const small_call<double> tiny = small_call<double>({{0.0, 0x1p-1074, -0.5, separated, face_above}}).ask();
    const small_call<double> quotient =
        small_call<double>({{0.0, 0x1p1000, 1e-9, separated, face_above}}).ask();
    const auto no_response = [](call_outputs& o) { o.ss[0] = 1.0; };
    note(flushes, tiny, no_response);
    note(flushes, quotient, [](call_outputs& o) { o = {1.0, {0.0}, {separated}, ""}; });
    note(tolerates, tiny, no_response);
    note(tolerates, quotient, [](call_outputs&) {});
  }
  REQUIRE(flushes.found());
  CHECK_THAT(words_of(*flushes.found()),
             Catch::Matchers::Contains("FTZ or DAZ") &&
                 Catch::Matchers::Contains("-ffast-math): explains all 6 values"));
  CHECK(line_of(tolerates) == 31);
}
#endif

TEST_CASE("line 52 is reported for a wrong threshold of DIFF, and line 51 for a wrong DIFF") {
  fault_finder threshold, no_threshold;
  const auto toggle = [](std::size_t i) { return [i](call_outputs& o) { o.isep[i] = in_contact; }; };
  note(threshold, with_diffs(0x1.8p-8, 0x1.8p-7), toggle(1));
  note(threshold, with_diffs(0x1.4p-8, 0x1p-6), toggle(1));
  note(no_threshold, with_diffs(0x1.8p-8, 0x1.8p-7), toggle(2));
  CHECK(line_of(threshold) == 52);
  CHECK(line_of(no_threshold) == 51);
}

TEST_CASE(
    "if only SMIN is wrong, the reported line is the IF that finds SMIN, and not a line that computes SS") {
  fault_finder all;
  for (const double gap : {0.25, 0.3}) {
    note(all, four_pairs(gap), [](call_outputs& o) {
      o.smin = 0.5;  // the s of pair 1, which is not the least
      o.isep = {in_contact, separated, separated, separated};
    });
  }
  REQUIRE(all.found());
  CHECK(all.found()->at.number == 40);
  CHECK(all.found()->explained == 2);
}

TEST_CASE("a wrong value that the reported faulty line cannot cause is counted as not explained") {
  fault_finder all;
  for (int times = 0; times < 4; ++times) {
    note(all, four_pairs(0.3), [](call_outputs& o) {
      o.smin = o.ss[2] = 0.375;
      o.isep = {separated, separated, in_contact, separated};
    });
  }
  note(all, four_pairs(0.3), [](call_outputs& o) { o.isep[0] = in_contact; });  // SS and SMIN are right
  REQUIRE(all.found());
  CHECK(all.found()->at.number == 38);
  CHECK(all.found()->explained == 4);
  CHECK(all.found()->differ == 5);
}

TEST_CASE(
    "if the SS of a pair differs, the lines of both kernels are reported with GAP, DTEST and SSCHK of the "
    "pair") {
  small_call<double> c = four_pairs(5e-10);
  call_outputs other{c.smin, c.ss, c.isep, ""};
  other.ss[2] = 1e-20;
  CHECK(lines_taken(c.answered(), 8, other, "a", "b") ==
        "pair 3: GAP = 5e-10, DTEST = 1; a took line 38, SS(I) = GAP / DTEST(NDOF); b has the SS of line 36, "
        "IF "
        "(SSCHK.GT.0.) SS(I) = SSCHK * DELTA");
  other.ss[1] = -1e-20;
  CHECK(lines_taken(c.answered(), 8, other, "a", "b") ==
        "pair 2: GAP = 0, DTEST = -1, SSCHK = -1; a took line 34, SS(I) = 1.0; b has the SS of line 36, IF "
        "(SSCHK.GT.0.) SS(I) = SSCHK * DELTA");
}

TEST_CASE("in a call without pairs, the FORMAT is the faulty line if only the text of unit 26 differs") {
  fault_finder all;
  small_call<double> c({});
  answered_call right = c.ask().answered();
  right.text = "  NO EVENTS. RETURNING. SCALE FACTOR =  0.100E+01\n";
  const call_outputs other{c.smin, {}, {}, "  NO EVENTS. RETURNING. SCALE FACTOR =   0.10E+01\n"};
  all.note(right, 8, other, false);
  CHECK(line_of(all) == 44);
}

TEST_CASE("the FORMAT is the faulty line if a text of unit 26 has no line that the listing can write") {
  fault_finder all;
  small_call<double> c = four_pairs(0.25);
  answered_call right = c.answered();
  right.text = "  ******* NAKING CONTACT ********\n";
  all.note(right, 8, {c.smin, c.ss, c.isep, "  ******* MAKING CONTACT ********\n"}, false);
  CHECK(line_of(all) == 66);
}
