// Tests the TOML reader: accepted values of each kind, and refusals with their positions.
#include "contct/read/toml_reader.hpp"

#include "catch.hpp"
#include "read/refusals.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// Returns "accepted", or the message with which `use` refuses a text.
template <class Use>
std::string refusal(const std::string& text, const Use& use) {
  return verdict([&] {
    const toml::table document = parse_toml(text, "f.toml");
    (void)use(toml_value(document, "f.toml"));
  });
}

template <class Use>
auto value(const std::string& text, const Use& use) {
  const toml::table document = parse_toml(text, "f.toml");
  return use(toml_value(document, "f.toml"));
}

const auto numbers_to_5 = [](const toml_value& t) { return t["n"].numbers(5); };
const auto reals = [](const toml_value& t) { return t["n"].reals(positive_real, 2); };

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

TEST_CASE(
    "a whole number is accepted as a real number, but a real number is not accepted as a whole number") {
  CHECK(value("n = 3", [](const toml_value& t) { return t["n"].real(any_real); }) == 3.0);
  CHECK(value("n = [1, 2.5]", reals) == std::vector<double>{1.0, 2.5});
  CHECK(value("n = 3", [](const toml_value& t) { return t["n"].integer(3, 3); }) == 3);
  CHECK(refusal("\n n = 3.0", [](const toml_value& t) { return t["n"].integer(1, 5); }) ==
        "f.toml:2:6: n: found 3.0; allowed: a whole number from 1 to 5");
}

TEST_CASE(
    "an array of wrong length is refused at the place of the array, and a wrong number at the place of the "
    "number") {
  CHECK_THAT(refusal("n = [1]", reals),
             Contains("f.toml:1:5: n: found an array of 1; allowed: an array of at"));
  CHECK_THAT(refusal("n = [1, 2, 0]", reals),
             Contains("f.toml:1:12: n[3]: found 0; allowed: a finite number"));
  CHECK_THAT(refusal("n = [1, \"2\"]", reals), Contains("f.toml:1:9: n[2]: found \"2\""));
}

TEST_CASE("a list of whole numbers may be an array, a range such as 2..4, or the word all") {
  CHECK(value("n = [5, 1, 3]", numbers_to_5) == std::vector<int>{4, 0, 2});
  CHECK(value("n = \"2..4\"", numbers_to_5) == std::vector<int>{1, 2, 3});
  CHECK(value("n = \"5..5\"", numbers_to_5) == std::vector<int>{4});
  CHECK(value("n = \"all\"", numbers_to_5) == std::vector<int>{0, 1, 2, 3, 4});
}

TEST_CASE("an error in a list of whole numbers is refused, and the message gives the place") {
  for (const char* text :
       {"0..2", "4..6", "3..2", "..3", "2..", "2...3", "2.3", "1 ..2", "+1..2", "", "ALL"}) {
    INFO(text);
    CHECK_THAT(refusal("n = \"" + std::string(text) + "\"", numbers_to_5),
               Contains("f.toml:1:5: n: found \"") && Contains("whole numbers from 1 to 5, each once"));
  }
  CHECK_THAT(refusal("n = []", numbers_to_5), Contains("n: found an empty array"));
  CHECK_THAT(refusal("n = 3", numbers_to_5), Contains("n: found 3"));
  CHECK_THAT(refusal("n = [1, 6]", numbers_to_5),
             Contains("f.toml:1:9: n[2]: found 6; allowed: a whole number"));
  CHECK_THAT(refusal("n = [2, 1, 2]", numbers_to_5), Contains("n[3]: found 2, a second time"));
}

TEST_CASE("a word from a fixed list is read as its index in the list, and a wrong word gets a suggestion") {
  const auto surface = [](const toml_value& t) { return t["n"].choice({"below", "above"}); };
  CHECK(value("n = \"above\"", surface) == 1);
  CHECK_THAT(refusal("n = \"abvoe\"", surface),
             Contains("found \"abvoe\" (did you mean \"above\"?); allowed: \"below\" or \"above\""));
}

TEST_CASE("if a key is in nested tables and arrays, a message names the key with all indices") {
  const std::string text = "[[a]]\n[[a]]\nb = [ { c = 1 }, { c = 2, d = 3 } ]\n";
  const auto inner = [](const toml_value& t) {
    const std::vector<toml_value> readers = t["a"].tables()[1]["b"].tables();
    readers[1].allow_only({"c"});
    return readers.size();
  };
  CHECK_THAT(refusal(text, inner), Contains("f.toml:3:27: a[2].b[2].d: found an unknown key; allowed: c"));
  CHECK(value("[[a]]\n[[a]]\n", [](const toml_value& t) { return t["a"].tables()[1].where(); }) ==
        "f.toml:2: a[2]");
  CHECK(value("", [](const toml_value& t) { return t["a"].optional_tables().size(); }) == 0);
  CHECK_THAT(refusal("", [](const toml_value& t) { return t["a"].tables().size(); }),
             Contains("a: found nothing: this key is missing; allowed: at least one table"));
  CHECK_THAT(refusal("a = [1]", [](const toml_value& t) { return t["a"].tables().size(); }),
             Contains("f.toml:1:6: a[1]: found 1; allowed: a table"));
}

TEST_CASE("if two keys exclude each other, the second is refused with its place") {
  const auto either = [](const toml_value& t) {
    t.refuse_beside({"b", "c"}, "a", "either a, or b and c");
    return 0;
  };
  CHECK(refusal("a = 1", either) == "accepted");
  CHECK(refusal("a = 1\nc = 2", either) ==
        "f.toml:2:5: c: found this key together with a; allowed: either a, or b and c");
}

TEST_CASE("a message describes the value that was found, such as an array or a date") {
  const auto words = [](const toml_value& t) { return t["n"].found(); };
  CHECK(value("n = -5", words) == "-5");
  CHECK(value("n = 0.5", words) == "0.5");
  CHECK(value("n = true", words) == "true");
  CHECK(value("n = \"a\\tb\"", words) == "\"a\\x09b\"");
  CHECK(value("n = []", words) == "an empty array");
  CHECK(value("n = [1, 2]", words) == "an array of 2");
  CHECK(value("n = {}", words) == "a table");
  CHECK(value("n = 1989-08-28", words) == "a date or time");
}

TEST_CASE("text that is not TOML is refused with line and column, and so is a key of more than 1000 parts") {
  CHECK_THAT(verdict([] { (void)parse_toml("a = 1\nb = = 2\n", "f.toml"); }),
             Contains("f.toml:2:5: not TOML: "));
  std::string dotted = "a";
  for (int i = 0; i < 1001; ++i) dotted += ".a";
  CHECK_THAT(verdict([&] { (void)parse_toml(dotted + " = 1\n", "f.toml"); }),
             Contains("a key of more than 1000 parts"));
  CHECK(verdict([] { (void)parse_toml("a = \"" + std::string(999, '.') + "\"\n", "f.toml"); }) == "accepted");
}

TEST_CASE("if a file is not TOML, the message quotes the error of the file on one line") {
  CHECK_THAT(verdict([] { (void)parse_toml("x = f\n", "f.toml"); }),
             Contains("f.toml:1:") && Contains("\\x0a") && !Contains("\n"));
}

TEST_CASE(
    "a single number applies to all things of a kind, and an array must have one number for each thing") {
  const auto three = [](const toml_value& t) { return t["n"].reals_for(any_real, 3, "thing"); };
  CHECK(value("n = 4", three) == std::vector<double>{4});
  CHECK(value("n = [1, 2.5, 3]", three) == std::vector<double>{1, 2.5, 3});
  CHECK(refusal("n = [1, 2.5]", three) ==
        "f.toml:1:5: n: found an array of 2; allowed: one number, or 3 numbers, one for each thing");
  CHECK_THAT(refusal("n = [1, 2, 3, 4, 5, 6]", three),
             Contains("found an array of 6 (write a decimal point, 4.0 instead of 4,0)"));
  CHECK_THAT(refusal("n = [1.5, 2, 3, 4, 5, 6]", three), !Contains("decimal point"));
  CHECK_THAT(refusal("n = []", three), Contains("found an empty array"));
}

TEST_CASE("only for a number with a decimal comma, a message about invalid TOML suggests a decimal point") {
  const auto nothing = [](const toml_value&) { return 0; };
  const std::string hint = "(write a decimal point, 4.0 instead of 4,0)";
  for (const char* line : {"n = 4,0", "n = -0,004", "n=+12,5 # comment", "n = [ 0,04, 1 ]",
                           "n = { a = 1, w = -60,5 }", "n = 10.000,5", "n = { w = -1.250.000,75 }"}) {
    INFO(line);
    CHECK_THAT(refusal("a = 1\n" + std::string(line), nothing), Contains("f.toml:2:") && Contains(hint));
  }
  for (const char* line :
       {"n = [1,2", "n = , 3", "n = 4 5", "n = \"1,5", "n = [1,,2]", ",", "n = 4,", "= 1", "n = [1.5,2"}) {
    INFO(line);
    CHECK_THAT(refusal("a = 1\n" + std::string(line), nothing), Contains("f.toml:2:") && !Contains(hint));
  }
  CHECK_THAT(refusal("n = [4,0]", [](const toml_value& t) { return t["n"].real(any_real); }), Contains(hint));
}

TEST_CASE("for text without quotes or a name with blanks, a message about invalid TOML suggests quotes") {
  const auto nothing = [](const toml_value&) { return 0; };
  for (const char* line : {"n = Crane", "n = tower", "n=below", "n = { a = crane }", "n = [w, theta]"}) {
    INFO(line);
    CHECK_THAT(refusal(line, nothing), Contains("not TOML") && Contains("(write text in quotes)"));
  }
  for (const char* line : {"Q pos. 1 = 1.5", "n = { Q pos. 1 = 1.5 }"})
    CHECK_THAT(refusal(line, nothing), Contains("(write a name with blanks in quotes)"));
  for (const char* line : {"n = 4 5", "n = [1, 2", "n 4", "n =", "= 1"}) {
    INFO(line);
    CHECK_THAT(refusal(line, nothing), Contains("not TOML") && !Contains("in quotes"));
  }
}
