#include <filesystem>

#include "catch.hpp"
#include "compare/other_compiler.hpp"
#include "contct/kernel/registry.hpp"

using namespace contct;

TEST_CASE("f2c's translation answers 20,000 random calls as gfortran's and C++ do, its text by meaning") {
  const three_compared found = compare_three("f2c", 20'000);
  CHECK(found.answers.values > 1'000'000);
  CHECK(found.answers.mismatches == 0);
  CHECK(found.lines > 20'000);
  CHECK(found.text.values == 40'000);
  CHECK(found.text.mismatches == 0);
  CHECK(found.different_bytes == 40'000);  // every call writes a number, and libf2c drops its zero
  CHECK_FALSE(std::filesystem::exists("fort.26"));
}

TEST_CASE("f2c's unit 26 is its own: one for each run-time library, and one at a time") {
  const auto first = make_kernel("f2c");
  const auto beside = make_kernel("fortran");
  CHECK_THROWS_AS(make_kernel("f2c"), std::logic_error);
  CHECK_THAT(answer_of(*first, one_pair_at(0.25)).text,
             Catch::Matchers::Contains("SCALE FACTOR =   .2500E+00"));
  CHECK(beside->take_text().empty());
}
