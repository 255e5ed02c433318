// Sentences on what the listing did.
#include "contct/write/explain_words.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "write/explained_run.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// The calls of a run, one after another.
std::vector<explained_call> calls_of(const char* text) {
  std::vector<explained_call> calls;
  explain_run(parse_problem(text, "pb.toml"), [&](const explained_increment& i) { calls.push_back(i.call); });
  return calls;
}

std::vector<int> lines_of(const std::vector<sentence>& story) {
  std::vector<int> lines;
  for (const sentence& t : story) lines.push_back(t.line);
  return lines;
}

}  // namespace

TEST_CASE("a pair's story cites the lines that it went through, with the paper's equations") {
  const std::vector<explained_call> calls = calls_of(two_pairs);
  REQUIRE(calls.size() == 2);
  CHECK(lines_of(scale_factor_story(calls[0].pairs[0])) == std::vector<int>{30, 31, 33, 38, 40});
  CHECK(scale_factor_story(calls[0].pairs[0])[3].equation == "(4)");
  CHECK(lines_of(scale_factor_story(calls[0].pairs[1])) == std::vector<int>{30, 31, 32, 40});
  CHECK(lines_of(winner_story(calls[0])) == std::vector<int>{42, 0});
  CHECK(lines_of(winner_story(calls[1])) == std::vector<int>{42, 45});
  CHECK(lines_of(toggle_story(calls[0], calls[0].pairs[0])) == std::vector<int>{51, 52, 54, 55});
  CHECK(lines_of(toggle_story(calls[0], calls[0].pairs[1])) == std::vector<int>{51, 52});
  CHECK(kind_of_contact(calls[1].pairs[0]) == "stationary");
  CHECK(name_of(calls[0].pairs[0].why) == "winner");
  CHECK(name_of(calls[0].pairs[1].why) == "not toggled");
}

TEST_CASE("two numbers are equal to the bit, so many ULP apart, or one is no number") {
  const double next = std::nextafter(0.25, 1.0);
  CHECK(side_by_side_words("a", 0.25, "b", 0.25, 8) == "a 0x1p-2, b equal to the bit");
  CHECK_THAT(side_by_side_words("a", 0.25, "b", next, 8), Contains(": 1 ULP apart"));
  CHECK_THAT(side_by_side_words("a", 0.25, "b", std::numeric_limits<double>::quiet_NaN(), 8),
             Contains("one is NaN"));
  CHECK(ulps_apart(0.25, next, 8) == 1);
  CHECK(ulps_apart(0.25, std::nextafter(0.25F, 1.0F), 4) == 1);
}
