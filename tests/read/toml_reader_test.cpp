// Tests the TOML reader: values of each kind, names of nodes, refusals with their positions, and warnings
// about numbers that are not shortest decimals.
#include "contct/read/toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catch.hpp"
#include "contct/read/node_reader.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/text/input_text.hpp"
#include "support/rows.hpp"

using namespace contct;

namespace {

/// What a use of the value n gives, as words.
using use = std::string (*)(const toml_value&);
std::string words_of(const auto& values) {
  return fmt::format("{}", fmt::join(values, " "));
}
const use whole = [](const toml_value& t) { return std::to_string(t["n"].integer(1, 5)); };
const use list = [](const toml_value& t) { return words_of(t["n"].numbers(5)); };
const use real = [](const toml_value& t) { return fmt::format("{}", t["n"].real(any_real)); };
const use reals = [](const toml_value& t) { return words_of(t["n"].reals(positive_real, 2)); };
const use three = [](const toml_value& t) { return words_of(t["n"].reals_for(any_real, 3, "thing")); };
const use surface = [](const toml_value& t) { return std::to_string(t["n"].choice({"below", "above"})); };
const use found = [](const toml_value& t) { return t["n"].found(); };
const use nothing = [](const toml_value&) { return std::string(); };
const use tables = [](const toml_value& t) { return std::to_string(t["a"].tables().size()); };
const use optional_tables = [](const toml_value& t) {
  return std::to_string(t["a"].optional_tables().size());
};
const use where = [](const toml_value& t) { return t["a"].tables()[1].where(); };
const use inner = [](const toml_value& t) {
  t["a"].tables()[1]["b"].tables()[1].allow_only({"c"});
  return std::string();
};
const use either = [](const toml_value& t) {
  t.refuse_beside({"b", "c"}, "a", "either a, or b and c");
  return std::string("accepted");
};

/// Returns what `with` gives, or the message.
std::string result(const std::string& text, use with) {
  std::string words;
  const std::string message = verdict([&] {
    const toml::table document = parse_toml(text, "f");
    words = with(toml_value(document, "f"));
  });
  return message == "accepted" ? words : message;
}

std::vector<std::string> warnings_of(const std::string& text) {
  return rounding_warnings(numbers_in(parse_toml(text, "p.toml"), text), "p.toml");
}

std::string warning(std::string_view place_and_key, std::string_view literal, std::string_view meant) {
  return "p.toml:" + std::string(place_and_key) + ": found " + std::string(literal) +
         "; the shortest decimal of its double, " + std::string(meant) + ", is used everywhere";
}

}  // namespace

TEST_CASE("a range of real numbers includes or excludes each of its ends as declared") {
  CHECK_FALSE(positive_real.holds(0.0));
  CHECK(positive_real.holds(5e-324));
  CHECK(any_real.holds(-1.7976931348623157e308));
  const real_range half{0.0, true, "", 0.5};
  CHECK(half.holds(0.0));
  CHECK(half.holds(0.5));
  CHECK_FALSE(half.holds(0.51));
}

TEST_CASE("a value of another kind is refused with its place, what it is and what is allowed") {
  const std::string nested = "[[a]]\n[[a]]\nb = [ { c = 1 }, { c = 2, d = 3 } ]\n";
  using row = std::tuple<std::string, use, std::string>;
  const row rows[] = {
      // A whole number is accepted as a real number, but not the reverse.
      {"n = 3", real, "3"},
      {"n = 3", whole, "3"},
      {"\n n = 3.0", whole, "f:2:6: n: found 3.0; allowed: a whole number from 1 to 5"},
      {"n = [1, 2.5]", reals, "1 2.5"},
      {"n = [1]", reals, "f:1:5: n: found an array of 1; allowed: an array of at"},
      {"n = [1, 2, 0]", reals, "f:1:12: n[3]: found 0; allowed: a finite number"},
      {"n = [1, \"2\"]", reals, "f:1:9: n[2]: found \"2\""},
      // A list of whole numbers is an array, a range or the word all; they count from 0 when read.
      {"n = [5, 1, 3]", list, "4 0 2"},
      {"n = \"2..4\"", list, "1 2 3"},
      {"n = \"5..5\"", list, "4"},
      {"n = \"all\"", list, "0 1 2 3 4"},
      {"n = []", list, "f:1:5: n: found an empty array"},
      {"n = 3", list, "f:1:5: n: found 3"},
      {"n = [1, 6]", list, "f:1:9: n[2]: found 6; allowed: a whole number"},
      {"n = [2, 1, 2]", list, "f:1:12: n[3]: found 2, a second time"},
      // A word is read as its index in the list of allowed words.
      {"n = \"above\"", surface, "1"},
      {"n = \"abvoe\"", surface,
       "f:1:5: n: found \"abvoe\" (did you mean \"above\"?); allowed: \"below\" or \"above\""},
      // A message names a key in nested tables and arrays with all indices.
      {nested, inner, "f:3:27: a[2].b[2].d: found an unknown key; allowed: c"},
      {"[[a]]\n[[a]]\n", where, "f:2: a[2]"},
      {"", optional_tables, "0"},
      {"", tables, "f:1:1: a: found nothing: this key is missing; allowed: at least one table"},
      {"a = [1]", tables, "f:1:6: a[1]: found 1; allowed: a table"},
      // If two keys exclude each other, the second is refused.
      {"a = 1", either, "accepted"},
      {"a = 1\nc = 2", either, "f:2:5: c: found this key together with a; allowed: either a, or b and c"},
      // A message describes the value that was found.
      {"n = -5", found, "-5"},
      {"n = 0.5", found, "0.5"},
      {"n = true", found, "true"},
      {"n = \"a\\tb\"", found, "\"a\\x09b\""},
      {"n = []", found, "an empty array"},
      {"n = [1, 2]", found, "an array of 2"},
      {"n = {}", found, "a table"},
      {"n = 1989-08-28", found, "a date or time"},
      // A single number applies to all things of a kind, and an array must have one number for each thing.
      {"n = 4", three, "4 4 4"},
      {"n = [1, 2.5, 3]", three, "1 2.5 3"},
      {"n = [1, 2.5]", three,
       "f:1:5: n: found an array of 2; allowed: one number, or 3 numbers, one for each thing"},
      {"n = [1, 2, 3, 4, 5, 6]", three,
       "f:1:5: n: found an array of 6 (write a decimal point, 4.0 instead of 4,0)"},
      {"n = [1.5, 2, 3, 4, 5, 6]", three, "f:1:5: n: found an array of 6; allowed"},
      {"n = []", three, "f:1:5: n: found an empty array"},
      {"n = [4,0]", real, "f:1:5: n: found an array of 2 (write a decimal point, 4.0 instead of 4,0)"},
      {"a = 1\nb = = 2\n", nothing, "f:2:5: not TOML: "},
  };
  for (const auto& [text, with, expected] : rows) {
    const std::string it = result(text, with);
    INFO(text << ": " << it);
    CHECK((expected.starts_with("f:") ? it.starts_with(expected) : it == expected));
  }
  for (const char* text :
       {"0..2", "4..6", "3..2", "..3", "2..", "2...3", "2.3", "1 ..2", "+1..2", "", "ALL"}) {
    INFO(text);
    CHECK(has_in_order(result(fmt::format("n = \"{}\"", text), list),
                       "f:1:5: n: found \" .. whole numbers from 1 to 5, each once"));
  }
}

TEST_CASE("a key of more than 1000 parts is refused, and an error of a file is quoted on one line") {
  std::string dotted = "a";
  for (int i = 0; i < 1001; ++i) dotted += ".a";
  CHECK_THAT(result(dotted + " = 1\n", nothing), Contains("a key of more than 1000 parts"));
  CHECK(result("a = \"" + std::string(999, '.') + "\"\n", nothing).empty());
  CHECK_THAT(result("x = f\n", nothing), Contains("f:1:") && Contains("\\x0a") && !Contains("\n"));
}

TEST_CASE("a message about invalid TOML suggests a decimal point or quotes only where they are missing") {
  const std::string point = "(write a decimal point, 4.0 instead of 4,0)";
  const std::string quotes = "(write text in quotes)";
  const std::string name = "(write a name with blanks in quotes)";
  const std::pair<std::string, std::vector<const char*>> lines_with[] = {
      {point,
       {"n = 4,0", "n = -0,004", "n=+12,5 # comment", "n = [ 0,04, 1 ]", "n = { a = 1, w = -60,5 }",
        "n = 10.000,5", "n = { w = -1.250.000,75 }"}},
      {quotes, {"n = Crane", "n = tower", "n=below", "n = { a = crane }", "n = [w, theta]"}},
      {name, {"Q pos. 1 = 1.5", "n = { Q pos. 1 = 1.5 }"}},
      {"",
       {"n = [1,2", "n = , 3", "n = 4 5", "n = \"1,5", "n = [1,,2]", ",", "n = 4,", "= 1", "n = [1.5,2",
        "n = [1, 2", "n 4", "n ="}}};
  for (const auto& [hint, lines] : lines_with) {
    for (const char* line : lines) {
      const std::string message = result("a = 1\n" + std::string(line), nothing);
      INFO(message);
      CHECK_THAT(message, Contains("f:2:") && Contains("not TOML"));
      for (const std::string& any : {point, quotes, name})
        CHECK((message.find(any) != std::string::npos) == (any == hint));
    }
  }
}

TEST_CASE("a number that does not stand for its double gets a warning with the shortest decimal") {
  CHECK(
      warnings_of("a = 0.1\nb = 0.3333333333333333333\n"
                  "c = [1, -2.00000000000000000001e+1, { d = 1_0.000000000000000000_1 }]\n[[e]]\nf = 1e-400\n"
                  "g = 9007199254740993\nh = 0x20000000000003\ni = 1152921504606846976\n") ==
      std::vector<std::string>{warning("2:5: b", "0.3333333333333333333", "0.3333333333333333"),
                               warning("3:9: c[2]", "-2.00000000000000000001e+1", "-20"),
                               warning("3:43: c[3].d", "1_0.000000000000000000_1", "10"),
                               warning("5:5: e[1].f", "1e-400", "0"),
                               warning("6:5: e[1].g", "9007199254740993", "9007199254740992"),
                               warning("7:5: e[1].h", "0x20000000000003", "9007199254740996"),
                               warning("8:5: e[1].i", "1152921504606846976", "1.152921504606847e+18")});
  const std::string shortest =  // but for zeros, signs, exponents and underscores
      "a = [0.10, 1e3, 1.0, +1, -0, 0.0, 0e-999, 1_000.5, 1000.5e0, 0x10, 0o7, 0b1, inf, nan]\n"
      "b = [0.250000000000000000000, 10000000000000000000e-1, 1.7976931348623157e308, 5e-324]\n"
      "c = [0.1000000000000000000000000000e+00, 9007199254740992, 0.30000000000000004, 6283.1853069999997]\n";
  CHECK(warnings_of(shortest).empty());
  CHECK(numbers_in(parse_toml(shortest, "p.toml"), shortest).size() == 20);  // all numbers except inf and nan
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

TEST_CASE("warnings about one line with 200,001 numbers are correct") {
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

TEST_CASE("a table gives nodes or dofs in exactly one way, and a message lists the allowed ways") {
  assembled labelled;
  labelled.stiffness.order = 3;
  labelled.labels = {"1.1", "1.2", "top"};
  assembled numbered;
  numbered.stiffness.order = 12;
  const model b{beam{{0.0, 0.3, 0.5, 2.0}, {1, 1, 1}}};
  const model p{plate{{0.0, 0.5, 1.0}, {0.0, 2.0}, 1.0, 0.3}};
  const model m{labelled};
  struct {
    const model& of;
    std::string text, expected;  // nodes from 1, or the message
  } const rows[] = {
      {b, "node = 2", "2"},
      {b, "nodes = [4, 1]", "4 1"},
      {b, "nodes = \"2..3\"", "2 3"},
      {b, "x = 2", "4"},
      {b, "x = [2.0, 0.3, 0]", "4 2 1"},
      {b, "x = 0\nnodes = [1]", "f:2:9: nodes: found this key together with x; allowed: either nodes or x"},
      {b, "",
       "f:1:1: node: found nothing: this key is missing; allowed: a whole number from 1 to 4; or nodes or x "
       "instead of node"},
      {p, "nodes = \"all\"", "1 2 3 4 5 6"},
      {p, "at = [0.5, 2]", "5"},
      {p, "at = [[1, 0], [0.0, 2.0]]", "3 4"},
      {p, "at = [[1, 0], [1.0, 0.0]]", "f:1:15: at[2]: found node 3, a second time"},
      {p, "at = []", "f:1:6: at: found an empty array; allowed: [x, y], or a list"},
      {p, "at = [1, 0, 0]", "f:1:6: at: found an array of 3; allowed: [x, y]"},
      {p, "at = [[1, 0], 3]", "f:1:15: at[2]: found 3; allowed: [x, y]"},
      {p, "at = [0.7, 0]",
       "f:1:7: at[1]: found 0.7, where there is no grid line along x; allowed: the coordinate of "
       "a grid line along x; the nearest are 0.5 and 1"},
      {p, "", "f:1:1: node: .. ; or nodes or at instead of node"},
      {m, "dof = \"top\"", "3"},
      {m, "dofs = [\"top\", \"1.1\"]", "3 1"},
      {m, "dofs = [\"top\", \"top\"]", "f:1:16: dofs[2]: found dof top, a second time"},
      {m, "dof = \"1.3\"",
       "f:1:7: dof: found \"1.3\", which has no row: a dof that is fixed or depends on others"},
      {m, "dof = \"1.11\"", "f:1:7: dof: found \"1.11\" (did you mean \"1.1\"?)"},
      {m, "dof = \"1\"", "f:1:7: dof: .. such as \"1.1\""},
      {m, "", "f:1:1: dof: found nothing: this key is missing; allowed: a label"},
      {{numbered}, "dof = \"12\"", "12"},
  };
  const auto read = [](const model& of, const std::string& text) {
    std::string words;
    const std::string message = verdict([&] {
      const toml::table document = parse_toml(text, "f");
      for (const int node : node_reader(of).read(toml_value(document, "f")))
        words += (words.empty() ? "" : " ") + std::to_string(node + 1);
    });
    return message == "accepted" ? words : message;
  };
  for (const auto& row : rows) {
    const std::string found = read(row.of, row.text);
    INFO(row.text << ": " << found);
    CHECK((row.expected[0] == 'f' ? has_in_order(found, row.expected) : found == row.expected));
  }
  for (const char* no :
       {"0", "13", "-1", "1.0", "01", "+1", " 1", "", "99999999999999", "x"})  // one spelling only
    CHECK(has_in_order(read({numbered}, fmt::format("dof = \"{}\"", no)),
                       "f:1:7: dof: .. a label, \"1\" to \"12\""));
}
