// Tests widths, colours and line breaks.
#include "contct/text/terminal.hpp"

#include <stdlib.h>  // setenv

#include "catch.hpp"

using namespace contct;

namespace {

using lines = std::vector<std::string>;

int width_with(const char* columns) {
  REQUIRE(setenv("COLUMNS", columns, 1) == 0);
  const int width = look_at_terminal().width;
  REQUIRE(unsetenv("COLUMNS") == 0);
  return width;
}

}  // namespace

TEST_CASE("COLUMNS sets the width of a table between 40 and 160, and an invalid COLUMNS gives 80") {
  CHECK(width_with("100") == 100);
  CHECK(width_with("10") == 40);
  CHECK(width_with("1000") == 160);
  CHECK(width_with("0") == 80);
  CHECK(width_with("-5") == 80);
  CHECK(width_with("wide") == 80);
}

TEST_CASE("text is coloured only if colour is requested") {
  CHECK(painted({80, false}, paint::bad, "no") == "no");
  CHECK(painted({80, true}, paint::good, "yes") == "\033[32myes\033[0m");
  CHECK(painted({80, true}, paint::bad, "no") == "\033[1;31mno\033[0m");
  CHECK(painted({80, true}, paint::quiet, "so") == "\033[2mso\033[0m");
  CHECK(painted({80, true}, paint::strong, "so") == "\033[1mso\033[0m");
}

TEST_CASE("wrap puts several items on a line, and breaks a long item only at blanks") {
  CHECK(wrap({"a", "b", "c"}, 4) == lines{"a; b", "c"});
  CHECK(wrap({"one two three"}, 7) == lines{"one two", "three"});
  CHECK(wrap({"one two three"}, 6) == lines{"one", "two", "three"});
  CHECK(wrap({"a unbreakable b"}, 5) == lines{"a", "unbreakable", "b"});
  CHECK(wrap({""}, 5) == lines{""});
}
