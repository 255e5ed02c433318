// Numbers of a file as they are written.
#include "contct/read/number_literals.hpp"

#include <map>

#include "catch.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/text/input_text.hpp"

using namespace contct::read;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

std::map<double, std::string> kept_of(const std::string& text) {
  const toml::table document = parse_toml(text, "p.toml");
  std::map<double, std::string> kept;
  for (const written_number& w : written_numbers(document, text, "p.toml")) kept[w.value] = w.literal;
  return kept;
}

std::string refusal_of(const std::string& text) {
  try {
    (void)kept_of(text);
  } catch (const contct::text::input_error& e) {
    return e.what();
  }
  return "not refused";
}

}  // namespace

TEST_CASE("only literals that are not the shortest decimals of their doubles are kept") {
  const auto kept = kept_of(
      "a = 0.1\nb = 0.3333333333333333333\nc = [1, -2.00000000000000000001e+1, 1_0.000000000000000000_1]\n"
      "d = 0.250000000000000000000\ne = 9007199254740993\nf = 0x20000000000003\n");
  CHECK(kept == std::map<double, std::string>{{1.0 / 3.0, "0.3333333333333333333"},
                                              {-20.0, "-2.00000000000000000001e+1"},
                                              {10.0, "1_0.000000000000000000_1"},
                                              {9007199254740992.0, "9007199254740993"},
                                              {9007199254740996.0, "9007199254740995"}});
}

TEST_CASE(
    "literals are found behind letters of several bytes, tabs, line ends of two bytes and a mark of order") {
  const std::string line =
      "t = [ { name = \"\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80\",\tw = +0.30000000000000000001 } ]";
  const std::map<double, std::string> one = {{0.3, "+0.30000000000000000001"}};
  CHECK(kept_of(line) == one);
  CHECK(kept_of("# \xC3\xA9\r\n\r\n[a]\r\n" + line + "\r\n") == one);
  CHECK(kept_of("\xEF\xBB\xBF" + line + "\n") == one);
  CHECK(kept_of("s = \"\"\"\n0.5\n\"\"\"\n" + line) == one);
}

TEST_CASE("equal numbers may be written in several ways, and the signs keep numbers apart") {
  CHECK(kept_of("a = 0.10000000000000000555\nb = 1.0000000000000000555e-1\nc = -0.1\n").size() == 1);
}

TEST_CASE("two numbers that read as one double are refused with both places") {
  for (const char* text : {"a = 0.1\n[b]\nc = [2, 0.10000000000000000555]\n",
                           "a = 0.10000000000000000555\n[b]\nc = [2, 0.1]\n"}) {
    const std::string message = refusal_of(text);
    CHECK_THAT(message, StartsWith("p.toml:") && Contains("0.1, ") && Contains("0.10000000000000000555"));
    CHECK_THAT(message, Contains(":1:5") && Contains(":3:9"));
  }
  CHECK_THAT(refusal_of("a = 9007199254740993\nb = 9007199254740992.0\n"),
             StartsWith("p.toml:2:5: found 9007"));
}

TEST_CASE("a number that is not 0 and reads as 0 is refused, and so is an endless one") {
  CHECK_THAT(
      refusal_of("a = 1\nb = [0.0, 1e-400]\n"),
      StartsWith("p.toml:2:11: found 1e-400, which reads as 0; allowed in exact arithmetic: 0, or a number"));
  CHECK(kept_of("a = 0.0\nb = 0e-999\nc = -0\n").empty());
  CHECK(kept_of("a = 0." + std::string(120, '3') + "\n").size() == 1);
  CHECK_THROWS_WITH(kept_of("a = 1\nb = 0." + std::string(1200, '3') + "\n"),
                    StartsWith("p.toml:2:") && Contains("128"));
}
