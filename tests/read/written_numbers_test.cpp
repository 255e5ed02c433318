// Tests the positions of a file's numbers, and the warnings about numbers that are not shortest decimals.
#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/text/input_text.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::vector<std::string> warnings_of(const std::string& text) {
  return rounding_warnings(numbers_in(parse_toml(text, "p.toml"), text), "p.toml");
}

std::string warning(std::string_view place_and_key, std::string_view literal, std::string_view meant) {
  return "p.toml:" + std::string(place_and_key) + ": found " + std::string(literal) +
         "; the shortest decimal of its double, " + std::string(meant) + ", is used everywhere";
}

}  // namespace

TEST_CASE("a number that does not stand for its double gets a warning with the shortest decimal") {
  const auto warnings = warnings_of(
      "a = 0.1\nb = 0.3333333333333333333\n"
      "c = [1, -2.00000000000000000001e+1, { d = 1_0.000000000000000000_1 }]\n[[e]]\nf = 1e-400\n");
  CHECK(warnings == std::vector<std::string>{
                        warning("2:5: b", "0.3333333333333333333", "0.3333333333333333"),
                        warning("3:9: c[2]", "-2.00000000000000000001e+1", "-20"),
                        warning("3:43: c[3].d", "1_0.000000000000000000_1", "10"),
                        warning("5:5: e[1].f", "1e-400", "0"),
                    });
}

TEST_CASE("a number gets no warning for zeros, signs, exponents and underscores") {
  const std::string text =
      "a = [0.10, 1e3, 1.0, +1, -0, 0.0, 0e-999, 1_000.5, 1000.5e0, 0x10, 0o7, 0b1, inf, nan]\n"
      "b = [0.250000000000000000000, 10000000000000000000e-1, 1.7976931348623157e308, 5e-324]\n"
      "c = [0.1000000000000000000000000000e+00, 9007199254740992, 0.30000000000000004, 6283.1853069999997]\n";
  CHECK(warnings_of(text).empty());
  CHECK(numbers_in(parse_toml(text, "p.toml"), text).size() == 20);  // all numbers except inf and nan
}

TEST_CASE("a whole number that no double equals gets a warning, in decimal and in hexadecimal form") {
  CHECK(warnings_of("a = 9007199254740993\nb = 0x20000000000003\nc = 1152921504606846976\n") ==
        std::vector<std::string>{warning("1:5: a", "9007199254740993", "9007199254740992"),
                                 warning("2:5: b", "0x20000000000003", "9007199254740996"),
                                 warning("3:5: c", "1152921504606846976", "1.152921504606847e+18")});
}

TEST_CASE("a warning about a number has the right line and column after any letters, tabs and line ends") {
  const std::string line =
      "t = [ { name = \"\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80\",\tw = +0.30000000000000000001, "
      "a = 0.4000000000000000000001 } ]";
  for (const auto& [text, where] :
       {std::pair(line, "1"), std::pair("# \xC3\xA9\r\n\r\n[a]\r\n" + line + "\r\n", "4"),
        std::pair("\xEF\xBB\xBF" + line + "\n", "1"), std::pair("s = \"\"\"\n0.5\n\"\"\"\n" + line, "4")}) {
    const auto warnings = warnings_of(text);
    REQUIRE(warnings.size() == 2);
    CHECK_THAT(warnings[0], StartsWith("p.toml:" + std::string(where) + ":27: ") &&
                                Contains("t[1].w: found +0.30000000000000000001; "));
    CHECK_THAT(warnings[1], Contains("t[1].a: found 0.4000000000000000000001; "));
  }
}

TEST_CASE(
    "only the first ten numbers that are not shortest decimals get a warning, and the tenth gives the "
    "count") {
  std::string text = "a = [\n";
  for (int i = 0; i < 11; ++i) text += "0.10000000000000000001,\n";
  const auto warnings = warnings_of(text + "]\n");
  REQUIRE(warnings.size() == 10);
  CHECK_THAT(warnings[0], !Contains("such numbers"));
  CHECK_THAT(warnings[9],
             StartsWith("p.toml:11:1: a[10]: ") && Contains(" (the first 10 of 11 such numbers are shown)"));
}

TEST_CASE("warnings about one line with 200,001 numbers are correct, and take linear time") {
  std::string text = "a = [";
  constexpr int count = 100'000;
  for (int i = 0; i < count; ++i) text += "{w=1.5,n=2},";
  text += "{w=0.10000000000000000001}]\n";
  CHECK(warnings_of(text).size() == 1);
  CHECK(numbers_in(parse_toml(text, "p.toml"), text).size() == 2 * count + 1);
}

TEST_CASE(
    "parse_problem warns about a number that is not the shortest decimal of its double, and uses the "
    "shortest") {
  const std::string rest =
      "[[support]]\nnode = 1\nfix = \"w\"\n[[step]]\npoint = [ { node = 2, w = 1000000000000.00001 } ]\n";
  const auto p = parse_problem("[beam]\nx = [0, 1]\nEI = 0.10000000000000000555\n" + rest, "p.toml");
  CHECK(p.warnings ==
        std::vector<std::string>{warning("3:6: beam.EI", "0.10000000000000000555", "0.1"),
                                 warning("8:27: step[1].point[1].w", "1000000000000.00001", "1e+12")});
  CHECK_THROWS_WITH(parse_problem("[beam]\nx = [0, 1]\nEI = 0." + std::string(1200, '3') + "\n", "p.toml"),
                    StartsWith("p.toml:3:") && Contains("128"));
}
