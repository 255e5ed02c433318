#include "contct/compare/compare.hpp"

#include <limits>
#include <vector>

#include "catch.hpp"
#include "contct/outside/registry.hpp"

using namespace contct::app;

namespace {

std::optional<mismatch> differ(double smin, std::vector<double> ss, std::vector<int> isep, tally& t) {
  const std::vector<double> leader_ss = {0.5, 0.0};
  const std::vector<int> leader_isep = {1, -1};
  return compare_answers<double>({0.5, leader_ss, leader_isep}, {smin, ss, isep}, t);
}

}  // namespace

TEST_CASE("equal answers are counted, value by value") {
  tally t;
  CHECK_FALSE(differ(0.5, {0.5, 0.0}, {1, -1}, t));
  CHECK(t.values == 5);
  CHECK(t.mismatches == 0);
}

TEST_CASE("one bit is enough, and the first difference is named") {
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

TEST_CASE("text is compared byte for byte, and the first different line is named") {
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
  CHECK(compare_text("a\n", "a", t));  // a lost line end is a difference too
  CHECK(t.values == 4);
  CHECK(t.mismatches == 3);
}

TEST_CASE("text compared by meaning may lack a number's zero and have other blanks, and nothing else") {
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

TEST_CASE("the text of gfortran is compared with that of C++ by bytes, and only f2c's by meaning") {
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
