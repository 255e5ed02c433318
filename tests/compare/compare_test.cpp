// Tests comparisons of two answers, the counts of a follower, and texts compared by bytes or by meaning.
// Traces of f2c can be compared without the kernel f2c.
#include "contct/compare/compare.hpp"

#include <bit>
#include <limits>
#include <stdexcept>
#include <vector>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

std::optional<mismatch> differ(double smin, std::vector<double> ss, std::vector<int> isep, tally& t) {
  const std::vector<double> leader_ss = {0.5, 0.0};
  const std::vector<int> leader_isep = {1, -1};
  return compare_answers<double>({0.5, leader_ss, leader_isep}, {smin, ss, isep}, t);
}

/// One pair that reaches its face at s = 0.5.
const call_inputs<double> half_way{{0.0}, {1.0}, {0.5}, {1}, {separated}, {face_above}, {}};

/// The leader's answer to the call `half_way`, with the given SMIN.
struct answered_half_way {
  call_outputs out;
  call<double> c = out.prepare(half_way);

  explicit answered_half_way(double smin = 0.5) {
    c.smin = smin;
    c.ss[0] = 0.5;
    c.isep[0] = in_contact;
  }
};

/// Returns a trace of the call `half_way` by `kernel`, with `scale_factor` in its text.
std::string trace_of(const std::string& kernel, const std::string& scale_factor) {
  const double ss[] = {0.5};
  const int isep[] = {in_contact};
  trace_header header;
  header.kernel = kernel;
  std::string text;
  append_header(header, text);
  append_inputs(1, "", half_way, text);
  append_answer(0.5, ss, isep,
                "  ******* MAKING CONTACT ********\n"
                "   CONTACT PAIR:   1 NODE:   1 SURFACE:   1 SCALE FACTOR = " +
                    scale_factor + "\n",
                text);
  return text;
}

replay_report replayed(const std::string& trace) {
  trace_reader calls(trace, "a.trace");
  const trace_header h = calls.read_header();
  return replay(h, calls, *make_kernel("cpp"));
}

}  // namespace

TEST_CASE("equal bytes count as equal, and so do NaNs of any payload") {
  tally t;
  const std::vector<int> isep = {1, -1};
  const auto compare = [&](double a, double b) {
    const std::vector<double> leader = {0.5, a};
    const std::vector<double> follower = {0.5, b};
    return compare_answers<double>({0.5, leader, isep}, {0.5, follower, isep}, t);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(compare(0.25, 0.25));
  CHECK_FALSE(compare(nan, nan));
  CHECK_FALSE(compare(nan, -nan));
  CHECK_FALSE(compare(nan, std::bit_cast<double>(std::bit_cast<std::uint64_t>(nan) + 1)));
  CHECK(t.values == 20);
  CHECK(t.mismatches == 0);
  CHECK(compare(0.0, -0.0));
  CHECK(t.mismatches == 1);
}

TEST_CASE("a difference of one bit is a mismatch, and the message names the first difference") {
  tally t;
  const auto one_ulp = differ(0.5, {0.5, std::numeric_limits<double>::denorm_min()}, {1, -1}, t);
  REQUIRE(one_ulp);
  CHECK(one_ulp->field == "SS");
  CHECK(one_ulp->index == 2);
  CHECK(one_ulp->ulps == 1);
  CHECK(one_ulp->follower == "0x0.0000000000001p-1022");
  const auto sign = differ(0.5, {0.5, -0.0}, {1, -1}, t);
  REQUIRE(sign);
  CHECK(sign->follower == "-0x0p+0");
  const auto status = differ(0.5, {0.5, 0.0}, {1, 1}, t);
  REQUIRE(status);
  CHECK(status->field == "ISEP");
  const auto both = differ(0.25, {0.5, 0.0}, {1, 1}, t);
  REQUIRE(both);
  CHECK(both->field == "SMIN");
  CHECK(t.values == 20);
  CHECK(t.mismatches == 5);
}

TEST_CASE("texts of unit 26 are compared byte for byte, and the message names the first line that differs") {
  tally t;
  CHECK_FALSE(compare_text("a\nb\n", "a\nb\n", t));
  const auto line = compare_text("a\nb\nc\n", "a\nB\nc\n", t);
  REQUIRE(line);
  CHECK(line->index == 2);
  CHECK(line->leader == "b");
  const auto missing = compare_text("a\nb\n", "a\n", t);
  REQUIRE(missing);
  CHECK(missing->index == 2);
  CHECK(missing->follower.empty());
  CHECK(compare_text("a\n", "a", t));  // without the last line end
  CHECK(t.values == 4);
  CHECK(t.mismatches == 3);
}

TEST_CASE(
    "texts of unit 26 that are compared by meaning may differ in blanks and in a number's leading zero "
    "only") {
  const auto same = [](std::string_view a, std::string_view b) {
    tally t;
    const auto found = compare_text(a, b, t, text_equality::meaning);
    CHECK(t.values == 1);
    CHECK(t.mismatches == (found ? 1 : 0));
    return !found;
  };
  const std::string_view line = " SCALE FACTOR =  0.2500E+00\n";
  CHECK(same(line, " SCALE FACTOR =   .2500E+00\n"));
  CHECK(same("-0.5\n", "  -.5\n"));
  CHECK(same(line, line));
  CHECK_FALSE(same(line, " SCALE FACTOR =   .2501E+00\n"));
  CHECK_FALSE(same(line, " SCALE FACTOR =   .2500E+01\n"));
  CHECK_FALSE(same(line, " SCALE FACTOR =  -.2500E+00\n"));
  CHECK_FALSE(same(line, " SCALE FACTOR =\n   .2500E+00\n"));
  CHECK_FALSE(same(line, " SCALE FACTOR =   .2500E+00"));
  CHECK_FALSE(same(line, ""));
  CHECK_FALSE(same("10.5\n", "1.5\n"));
  CHECK_FALSE(same("a\n", "a\nb\n"));
}

TEST_CASE("unit 26 of gfortran and of C++ is compared by bytes, and only unit 26 of f2c by meaning") {
  CHECK_FALSE(facts_of_kernel("fortran").text_by_meaning);
  CHECK_FALSE(facts_of_kernel("cpp").text_by_meaning);
  CHECK(text_equality_of(facts_of_kernel("fortran"), facts_of_kernel("cpp")) == text_equality::bytes);
  CHECK(text_equality_of(facts_of_kernel("fortran-r4"), facts_of_kernel("cpp-r4")) == text_equality::bytes);
  kernel_facts without_zeros = facts_of_kernel("cpp");
  without_zeros.text_by_meaning = true;
  CHECK(text_equality_of(facts_of_kernel("fortran"), without_zeros) == text_equality::meaning);
  CHECK(text_equality_of(without_zeros, facts_of_kernel("fortran")) == text_equality::meaning);
  for (const std::string& name : kernel_names())
    CHECK(facts_of_kernel(name).text_by_meaning == (name == "f2c"));
}

TEST_CASE(
    "the comparison of a follower counts compared values, and keeps the mismatch of the earliest call") {
  const auto k = make_kernel("cpp");
  follower f(k->facts(), *k);
  const answered_half_way right;
  const answered_half_way wrong(0.25);
  CHECK_FALSE(f.ask({right.c, half_way.isep, {}, 1}));
  CHECK_FALSE(f.first());
  CHECK(f.answer().smin == 0.5);
  CHECK(f.compared.values == 3);
  REQUIRE(f.ask({wrong.c, half_way.isep, {}, 5}));
  CHECK(f.difference()->field == "SMIN");
  CHECK(f.answered());
  CHECK(f.first()->call == 5);
  CHECK(f.first()->narrowest->what == branch::s_is_smallest);
  (void)f.ask({wrong.c, half_way.isep, {}, 6});
  CHECK(f.first()->call == 5);
  f.note({"text", 2, "a", "b", 0}, {wrong.c, half_way.isep, {}, 3});  // an earlier call, reported later
  CHECK(f.first()->call == 3);
  CHECK(f.first()->where.field == "text");
  CHECK(f.compared.values == 9);
  CHECK(f.compared.mismatches == 2);
}

TEST_CASE("a follower refuses a call that exceeds 32-bit integers, and compares no value of this call") {
  const auto k = make_kernel("cpp");
  follower f(k->facts(), *k);
  const answered_half_way right;
  const std::vector<int> isep = {-2'147'483'647 - 1};
  call<double> below = right.c;
  const std::vector<int> isurf = {face_below};
  below.isurf = isurf;
  CHECK_THROWS_WITH(f.ask({below, isep}), Contains("pair 1: found ISEP -2147483648 and ISURF -1"));
  CHECK(f.compared.values == 0);
  CHECK_FALSE(f.ask({right.c, half_way.isep, {}, 1}));
  CHECK(f.compared.values == 3);
}

TEST_CASE("if the leader's text is given, a follower compares the text, which counts as one value") {
  const auto k = make_kernel("cpp");
  follower f(k->facts(), *k);
  const answered_half_way right;
  const auto found = f.ask({right.c, half_way.isep, "another text\n"});
  REQUIRE(found);
  CHECK(found->field == "text");
  CHECK(found->index == 1);
  CHECK(f.compared.values == 4);
  CHECK(f.compared.mismatches == 1);
}

TEST_CASE("a comparison of kernels of different precisions or rules is refused") {
  CHECK_NOTHROW(refuse_unequal(facts_of_kernel("fortran"), facts_of_kernel("cpp")));
  CHECK_THROWS_WITH(refuse_unequal(facts_of_kernel("fortran"), facts_of_kernel("cpp-r4")),
                    Contains("precision") && Contains("--free-run"));
  CHECK_THROWS_WITH(refuse_unequal(facts_of_kernel("fortran"), facts_of_kernel("corrected")),
                    Contains("rule"));
}

TEST_CASE(
    "a mismatch report names the call, the kernels and the place, and calls a decision at the threshold a "
    "tie") {
  mismatch_report r{3, "fortran", "mine", {"ISEP", 2, "-1", "1", 0}, {}};
  r.narrowest = {branch::within_epsmul, 1, true, 1};
  CHECK(words_of(r)[0] == "call 3: mine differs in ISEP(2): fortran has -1, mine has 1");
  CHECK_THAT(words_of(r)[1], Contains("was true by 1 ULP: a tie"));
  r.narrowest->ulps = tie_ulps + 1;
  CHECK_THAT(words_of(r)[1], Contains("by 5 ULP") && Contains("a bug"));
  r.where = {"answer", 0, "an answer", "it ended with status 3", 0};
  CHECK(words_of(r) == std::vector<std::string>{"call 3: mine gave no answer: it ended with status 3"});
}

TEST_CASE("contct replay compares unit 26 by bytes, and the unit 26 of f2c by meaning") {
  const auto mismatches = [](const char* kernel, const char* scale_factor) {
    return replayed(trace_of(kernel, scale_factor)).compared.mismatches;
  };
  for (const char* kernel : {"fortran", "another"}) {
    CHECK(mismatches(kernel, " 0.5000E+00") == 0);
    CHECK(mismatches(kernel, "  .5000E+00") == 1);
  }
  CHECK(mismatches("f2c", "  .5000E+00") == 0);
  CHECK(mismatches("f2c", "  .5001E+00") == 1);
  CHECK(mismatches("f2c", "  .5000E+01") == 1);
  CHECK(replayed(trace_of("fortran", "  .5000E+00")).first->where.field == "text");
}

TEST_CASE("if every s and every status is wrong, each of them counts as a mismatch, even if SMIN is equal") {
  tally t;
  const std::optional<mismatch> first = differ(0.5, {0.25, 1.0}, {-1, 1}, t);
  REQUIRE(first);
  CHECK(first->field == "SS");
  CHECK(first->index == 1);
  CHECK(t.mismatches == 4);
}
