// Tests the JSON reader: accepted values, and refusals with their positions.
#include "contct/read/json_reader.hpp"

#include "catch.hpp"
#include "read/refusals.hpp"

using namespace contct;
using Catch::Matchers::StartsWith;

namespace {

std::string verdict_of(const std::string& text) {
  return verdict([&] { (void)parse_json(text, "f.json"); });
}

/// Returns the message with which `use` refuses a text.
template <class Use>
std::string refusal(const std::string& text, const Use& use) {
  const json_tree d = parse_json(text, "f.json");
  return verdict([&] { (void)use(toml_value(d.table, "f.json", d.places)); });
}

}  // namespace

TEST_CASE("JSON values of every kind are read like the same values in TOML") {
  const std::string text =
      R"({ "a": [1, -2.5e-3, true, "x\u00e9\"]" ], "b": {"c": 9007199254740993}, "d": {} })";
  const json_tree d = parse_json(text, "f.json");
  const toml_value top(d.table, "f.json", d.places);
  const auto a = top["a"].entries("four", 4, 4);
  CHECK(a[0].integer(1, 1) == 1);
  CHECK(a[1].real(any_real) == -2.5e-3);
  CHECK(a[3].text() == "x\xc3\xa9\"]");
  CHECK(top["b"]["c"].real(any_real) == 9007199254740992.0);  // the nearest double
  CHECK(top["d"].is_table());
}

TEST_CASE("text that is not JSON is refused with line and column") {
  check_refusals(
      {
          {"", "f.json:1:1: ", "the end", "'{'"},
          {"[1]", "f.json:1:1: ", "\"[\"", "an object"},
          {"{\"a\": 1,\n}", "f.json:2:1: ", "\"}\"", "string literal"},
          {"{\"a\": 1\n \"b\": 2}", "f.json:2:2: ", "\"\"\"", "'}'"},
          {"{\"a\" 1}", "f.json:1:6: ", "\"1\"", "':'"},
          {"{\"a\": [1 2]}", "f.json:1:10: ", "\"2\"", "']'"},
          {"{\"a\": 01}", "f.json:1:8: ", "\"1\"", "'}'"},
          {"{\"a\": 1e999}", "f.json:1:7: ", "\"1\"", "number overflow"},
          {"{\"a\": null}", "f.json:1:7: ", "\"n\"", "a number"},
          {"{\"a\": \"x}", "f.json:1:7: ", "\"\"\"", "missing closing quote"},
          {"{\"a\": 1} {", "f.json:1:10: ", "\"{\"", "end of input"},
          {"{\"a\": 1,\n \"a\": 2}", "f.json:2:2: ", "\"\"\"", "\"a\" is there twice"},
          {"{\"a\": " + std::string(1000, '['), "f.json:1:23: ", "\"[\"", "at most 16 deep"},
      },
      verdict_of);
}

TEST_CASE("a wrong value in a JSON file is refused with line and column") {
  const std::string text = "{\n  \"a\": [ { \"n\": 1 },\n    { \"n\": 7, \"m\": 0 } ] }";
  const auto second = [](const toml_value& t) { return t["a"].entries("two", 2)[1]; };
  CHECK_THAT(refusal(text, [&](const toml_value& t) { return second(t)["n"].integer(1, 3); }),
             StartsWith("f.json:3:12: a[2].n: found 7; allowed: "));
  CHECK_THAT(refusal(text, [&](const toml_value& t) { return second(t)["o"].text(); }),
             StartsWith("f.json:3:5: a[2].o: found nothing: this key is missing; allowed: "));
  CHECK_THAT(refusal(text,
                     [&](const toml_value& t) {
                       second(t).allow_only({"n"});
                       return 0;
                     }),
             StartsWith("f.json:3:20: a[2].m: found an unknown key; allowed: n"));
}
