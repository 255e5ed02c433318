#include <filesystem>

#include "catch.hpp"
#include "compare/other_compiler.hpp"
#include "contct/kernel/registry.hpp"

using namespace contct;

TEST_CASE("flang's build answers 20,000 random calls as gfortran's and C++ do, to the bit and to the byte") {
  const three_compared found = compare_three("flang", 20'000);
  CHECK(found.answers.values > 1'000'000);
  CHECK(found.answers.mismatches == 0);
  CHECK(found.lines > 20'000);
  CHECK(found.text.values == 40'000);
  CHECK(found.text.mismatches == 0);
  CHECK(found.different_bytes == 0);
  CHECK_FALSE(facts_of_kernel("flang").text_by_meaning);
  CHECK_FALSE(std::filesystem::exists("fort.26"));
}

TEST_CASE("flang's unit 26 is its own: one for each run-time library, and one at a time") {
  const auto first = make_kernel("flang");
  const auto beside = make_kernel("fortran");
  CHECK_THROWS_AS(make_kernel("flang"), std::logic_error);
  const call_outputs a = answer_of(*first, one_pair_at(0.25));
  CHECK_THAT(a.text, Catch::Matchers::Contains("SCALE FACTOR =  0.2500E+00"));
  CHECK(beside->take_text().empty());
}
