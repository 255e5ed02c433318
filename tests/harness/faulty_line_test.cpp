// Tests the line of the listing that is reported as faulty for a kernel's wrong answers. tests/mutants
// measures how often this line is right.
#include <cmath>

#include "catch.hpp"
#include "contct/harness/compare.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

using alteration = std::function<void(call_outputs&)>;

/// A call, and the alteration from the right answer to the answer of another kernel.
struct answered_otherwise {
  small_call<double> c;
  alteration wrong;
  std::string text = {};  // on unit 26, by the right kernel
};

/// Pair 1 reaches its face at s = 0.5, pair 2 is at its face and not pressed, pair 3 is at a distance of
/// `gap`, and pair 4 does not respond.
small_call<double> four_pairs(double gap) {
  return small_call<double>({{0, 1, 0.5}, {0, -1, 0}, {0, 1, gap}, {0, 0, 0.25}});
}

/// The same alteration of the answers to calls with these gaps of pair 3.
std::vector<answered_otherwise> four_pairs(const std::vector<double>& gaps, const alteration& wrong) {
  std::vector<answered_otherwise> all;
  for (const double gap : gaps) all.push_back({four_pairs(gap), wrong});
  return all;
}

/// A call with SMIN = 0.5 in which pairs 2 and 3 have these values of DIFF, and pair `toggled` is toggled
/// wrongly.
answered_otherwise with_diffs(double second, double third, std::size_t toggled) {
  return {small_call<double>({{0, 1, 0.5}, {0, 1, 0.5 + second / 2.0}, {0, 1, 0.5 + third / 2.0}}),
          [toggled](call_outputs& o) { o.isep[toggled] = in_contact; }};
}

std::vector<answered_otherwise> both(std::vector<answered_otherwise> a,
                                     const std::vector<answered_otherwise>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const alteration equal = [](call_outputs&) {};
alteration text(const char* words) {
  return [words](call_outputs& o) { o.text = words; };
}
alteration answering(double smin, std::size_t pair, double ss, const std::vector<int>& isep) {
  return [=](call_outputs& o) {
    o.smin = smin;
    o.ss[pair] = ss;
    o.isep = isep;
  };
}

struct faulty_kernel_row {
  const char* what;
  std::vector<answered_otherwise> calls;
  const char* words;  // the report begins so; empty: no report
};

std::vector<faulty_kernel_row> faulty_kernels() {
  const std::vector<int> only_third = {separated, separated, in_contact, separated};
  const std::vector<int> only_first = {in_contact, separated, separated, separated};
  const small_call<double> unset({{0, 1, not_an_answer}});
  const small_call<double> many(std::vector<pair_at<double>>(200, {0, 1, 0.5})), tiny({{0, 1e303, 0}});
  const alteration first_is_unset = [](call_outputs& o) { o.ss[0] = not_an_answer; };
  const alteration end_is_unset = [](call_outputs& o) { o.ss[2] = o.ss[3] = not_an_answer; };
  const small_call<double> slow({{0, 1, 3}, {0, 1, 3}, {0, 1e-13, 3}, {0, 1, 3}});
  const alteration responds_not = [](call_outputs& o) { o.ss[2] = 1.0; };
  const alteration nothing_is_toggled = [](call_outputs& o) {
    REQUIRE(o.smin == 0x2p-1074);
    o.isep[0] = separated;  // 2^-1073 / 256 is zero
  };
  return {
      {"equal answers", four_pairs({0.25}, equal), ""},
      {"EPSGAP = 1e-9: pair 3 has the s of a pair at its face, and no other pair is toggled",
       both(four_pairs({2e-10, 5e-10}, answering(1e-20, 2, 1e-20, only_third)), four_pairs({2e-9}, equal)),
       "line 33, ELSE IF (ABS(GAP).LT.EPSGAP) THEN: explains all 2 values that differ, in 2 calls; in these "
       "ABS(GAP) was "
       "2e-10 to 5e-10"},
      {"a quotient that is rounded twice",
       four_pairs({0.3, 0.7}, [](call_outputs& o) { o.ss[2] = std::nextafter(o.ss[2], 1.0); }), "line 38,"},
      {"a wrong sign of GAP",
       four_pairs({0.3, 0.7},
                  [](call_outputs& o) {
                    o = {1.0, {-o.ss[0], o.ss[1], -o.ss[2], o.ss[3]}, std::vector(4, separated), ""};
                  }),
       "line 30,"},
      {"a quotient that is cut off at 1", four_pairs({3, 5, 7}, [](call_outputs& o) { o.ss[2] = 1.0; }),
       "line 38,"},
      {"a quotient that is cut off at 0", four_pairs({-3, -5, -7}, [](call_outputs& o) { o.ss[2] = 0.0; }),
       "line 38,"},
      {"a product instead of the quotient DIFF, which underflows if SMIN is small",
       {{many, equal},
        {tiny, nothing_is_toggled},
        {many, equal},
        {tiny, nothing_is_toggled},
        {many, equal},
        {tiny, nothing_is_toggled}},
       "line 51, DIFF = ABS(SS(I) - SMIN) / SMIN: explains all 3 values that differ, in 3 calls; lines 51 "
       "and 52 are "
       "computed in another way, which rounds or underflows"},
      {"an SS that is not set, and is equal to the mark of an unset SS in one call",
       both({{unset, first_is_unset}},
            four_pairs({3}, answering(1.0, 0, not_an_answer, std::vector(4, separated)))),
       "line 27, DO 10 I = 1, NC: explains the 1 value that differs, in 1 call"},
      {"an SS of pair 3 and of later pairs that is not set",
       both({{unset, equal}}, four_pairs({0.6, 0.7}, end_is_unset)),
       "line 27, DO 10 I = 1, NC: explains all 4 values that differ, in 2 calls"},
      {"an SS of 1 if the quotient is negative, or over 1",
       both(four_pairs({-3, 5, -7}, [](call_outputs& o) { o.ss[2] = 1.0; }), four_pairs({0.3, 0.7}, equal)),
       "line 38,"},
      {"an SS of 1 if the response is small",
       {{slow, responds_not}, {slow, responds_not}},
       "line 31, IF (DTEST(NDOF).EQ.0.) THEN: explains all 2 values that differ, in 2 calls; in these "
       "DTEST(NDOF) was 1e-13 to 1e-13"},
      {"a wrong threshold of DIFF",
       {with_diffs(0x1.8p-8, 0x1.8p-7, 1), with_diffs(0x1.4p-8, 0x1p-6, 1)},
       "line 52,"},
      {"a wrong DIFF", {with_diffs(0x1.8p-8, 0x1.8p-7, 2)}, "line 51,"},
      {"an SMIN that is not the least", four_pairs({0.25, 0.3}, answering(0.5, 0, 0.5, only_first)),
       "line 40,"},
      {"a wrong value that the line cannot cause: SS and SMIN are right",
       both(four_pairs({0.3, 0.3, 0.3, 0.3}, answering(0.375, 2, 0.375, only_third)),
            four_pairs({0.3}, [](call_outputs& o) { o.isep[0] = in_contact; })),
       "line 38, SS(I) = GAP / DTEST(NDOF): explains 4 of 5 values"},
      {"a text, in a call without pairs",
       {{small_call<double>({}), text("  NO EVENTS. RETURNING. SCALE FACTOR =   0.10E+01\n"),
         "  NO EVENTS. RETURNING. SCALE FACTOR =  0.100E+01\n"}},
       "line 44,"},
      {"a text that the listing cannot write",
       {{four_pairs(0.25), text("  ******* MAKING CONTACT ********\n"),
         "  ******* NAKING CONTACT ********\n"}},
       "line 66,"},
  };
}

fault_finder found_in(std::vector<answered_otherwise> calls) {
  fault_finder all;
  for (answered_otherwise& a : calls) {
    answered_call right = a.c.ask().answered();
    if (!a.text.empty()) right.text = a.text;
    call_outputs other{a.c.smin, a.c.ss, a.c.isep, a.text};
    a.wrong(other);
    all.note(right, 8, other,
             other.ss == a.c.ss && other.isep == a.c.isep && other.smin == a.c.smin && other.text == a.text);
  }
  return all;
}

std::string report_of(const std::vector<answered_otherwise>& calls) {
  const fault_finder all = found_in(calls);
  return all.found() ? words_of(*all.found()) : "";
}

}  // namespace

TEST_CASE("for each fault of a kernel, the reported line of the listing is the line that is wrong") {
  for (const faulty_kernel_row& k : faulty_kernels()) {
    INFO(k.what);
    const std::string report = report_of(k.calls);
    CHECK_THAT(report, StartsWith(k.words));
    CHECK(report.empty() == (*k.words == '\0'));
  }
}

#ifdef __SSE2__
TEST_CASE("flushed subnormals are reported instead of a line, but not for a kernel that keeps some of them") {
  std::vector<answered_otherwise> flushes, tolerates;
  for (int times = 0; times < 3; ++times) {
    const small_call<double> tiny({{0, 0x1p-1074, -0.5}}), quotient({{0, 0x1p1000, 1e-9}});
    const alteration no_response = [](call_outputs& o) { o.ss[0] = 1.0; };
    flushes.push_back({tiny, no_response});
    flushes.push_back({quotient, answering(1.0, 0, 0.0, {separated})});
    tolerates.push_back({tiny, no_response});
    tolerates.push_back({quotient, equal});
  }
  CHECK_THAT(report_of(flushes), Contains("FTZ or DAZ") && Contains("-ffast-math): explains all 6 values"));
  CHECK_THAT(report_of(tolerates), StartsWith("line 31,"));
}
#endif

TEST_CASE("if an SS differs, the lines of both kernels are reported with GAP, DTEST and SSCHK") {
  small_call<double> c = four_pairs(5e-10).ask();
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
