// Tests input files as text, lines, fields and numbers, and their refusals with file and line.
#include "contct/text/input_text.hpp"

#include <filesystem>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// Returns the message that refuses the first field of the line `text` as a real, or "accepted".
std::string refusal_of_real(const std::string& text) {
  field_lines lines(text, "f");
  REQUIRE(lines.next());
  try {
    (void)lines.real(0, "x");
  } catch (const input_error& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("an input file is read completely, whatever its bytes are") {
  const scratch_folder here;
  CHECK(read_input(here.write("empty", "")).empty());
  std::string all;
  for (int i = 0; i < 200'000; ++i) all += static_cast<char>(i % 256);  // more than one block
  CHECK(read_input(here.write("all", all)) == all);
}

TEST_CASE("a missing file, a folder and a file that is too large are refused, and the message has the name") {
  const scratch_folder here;
  CHECK_THROWS_WITH(read_input(here.at("none")), Contains("none: cannot be read: No such file"));
  CHECK_THROWS_WITH(read_input(here.path().string(), "mesh"),
                    Contains(": found a directory; allowed: a mesh"));
  const std::string large = here.write("large", "");
  std::filesystem::resize_file(large, (1 << 20) - 1);
  CHECK(read_input(large, "mesh", 1).size() == (1 << 20) - 1);
  std::filesystem::resize_file(large, 1 << 20);
  CHECK_THROWS_WITH(read_input(large, "mesh", 1),
                    Contains("large: found 1 MiB or more; allowed: a mesh of less than 1 MiB"));
}

TEST_CASE("an error message names the file and the line, or only the file") {
  CHECK_THROWS_WITH(refuse_line("K.mtx", 12, "x", "y"), "K.mtx:12: found x; allowed: y");
  CHECK_THROWS_WITH(refuse_line("K.mtx", 0, "x", "y"), "K.mtx: found x; allowed: y");
  CHECK_THROWS_AS(refuse_line("K.mtx", 1, "", ""), input_error);
}

TEST_CASE("text is split into lines at line feeds, and empty lines are counted") {
  text_lines lines("one\n\n three \r\nlast", "f");
  CHECK(lines.line() == 0);
  std::vector<std::string> found;
  while (lines.next()) found.emplace_back(lines.here());
  CHECK(found == std::vector<std::string>{"one", "", " three \r", "last"});
  CHECK(lines.line() == 4);
  CHECK(lines.rest().empty());
  CHECK_FALSE(text_lines("", "f").next());
}

TEST_CASE("if the last line has no line end, the file is refused as cut off") {
  text_lines lines("one\n2", "f");
  REQUIRE(lines.next());
  CHECK_NOTHROW(lines.refuse_unended());
  REQUIRE(lines.next());
  CHECK_THROWS_WITH(lines.refuse_unended(), Contains("f:2: found \"2\" without a line end"));
}

TEST_CASE("any blanks separate the fields of a line, and blank lines are skipped but counted") {
  field_lines lines("\n  a\tb  c\r\n \v\f\n1 2 3 4 5 6 7 8 9 10\n", "f");
  REQUIRE(lines.next());
  CHECK(lines.line() == 2);
  REQUIRE(lines.fields() == 3);
  CHECK(lines.field(0) == "a");
  CHECK(lines.field(2) == "c");
  CHECK_NOTHROW(lines.expect(3, "three"));
  CHECK_THROWS_WITH(lines.expect(2, "two"), Contains("f:2: found a line of 9 bytes; allowed: two"));
  REQUIRE(lines.next());
  CHECK(lines.line() == 4);
  CHECK(lines.fields() == 10);
  CHECK_FALSE(lines.next());
  CHECK(lines.fields() == 0);
}

TEST_CASE("a line of fields without a line end is refused, but blanks after the last line end are accepted") {
  field_lines cut("1 2\n3 4", "f");
  REQUIRE(cut.next());
  CHECK_THROWS_WITH(cut.next(), Contains("f:2: found \"3 4\" without a line end"));
  field_lines whole("1 2\n  ", "f");
  REQUIRE(whole.next());
  CHECK_FALSE(whole.next());
}

TEST_CASE("a whole number is read if it is in a given range, with or without a plus sign") {
  field_lines lines("+7 -3 8 7.0 7x +-7 99999999999999999999\n", "f");
  REQUIRE(lines.next());
  CHECK(lines.whole(0, -3, 7, "n") == 7);
  CHECK(lines.whole(1, -3, 7, "n") == -3);
  for (const std::size_t i : {2, 3, 4, 5, 6}) {
    INFO(lines.field(i));
    CHECK_THROWS_WITH(lines.whole(i, -3, 7, "n"), Contains("f:1: found \"" + std::string(lines.field(i)) +
                                                           "\" for n; allowed: a whole number from -3 to 7"));
  }
}

TEST_CASE("a real number must be a finite decimal, and FORTRAN's exponent D is accepted only on request") {
  field_lines lines("+1.5 -2e-3 .5 5.\n", "f");
  REQUIRE(lines.next());
  CHECK(lines.real(0, "x") == 1.5);
  CHECK(lines.real(1, "x") == -2e-3);
  CHECK(lines.real(2, "x") == 0.5);
  CHECK(lines.real(3, "x") == 5.0);
  for (const char* text : {"nan\n", "inf\n", "1e999\n", "1,5\n", "0x1p3\n", "1D0\n", "+-1\n", "+\n"})
    CHECK_THAT(refusal_of_real(text), Contains("for x; allowed: a finite number"));
  CHECK(lines.text_lines::real("-1.5D+01", "x", true) == -15.0);
  CHECK(lines.text_lines::real("+2d1", "x", true) == 20.0);
  CHECK_THROWS_WITH(lines.text_lines::real("1D999", "x", true), Contains("\"1D999\" for x"));
}

TEST_CASE("a text is read as a number only if the whole text is a number") {
  CHECK(number_in<int>("-12") == -12);
  CHECK(number_in<double>("1e3") == 1000.0);
  CHECK(number_in<double>("1.8p1", std::chars_format::hex) == 3.0);
  CHECK(number_in<double>("inf") == std::numeric_limits<double>::infinity());
  for (const char* text : {"", " 1", "1 ", "+1", "1x", "99999999999"}) {
    INFO(text);
    CHECK_FALSE(number_in<int>(text).has_value());
  }
}
