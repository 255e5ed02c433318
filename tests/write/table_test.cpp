// The pieces of the table; what a whole table looks like is tested on the program itself (tests/cli).
#include "contct/write/table.hpp"

#include <cstdlib>

#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "read/bad_plates.hpp"

using namespace contct::app;

TEST_CASE("the terminal's width comes from COLUMNS, within reason, and a pipe has no colour") {
  setenv("COLUMNS", "120", 1);
  CHECK(look_at_terminal().width == 120);
  setenv("COLUMNS", "7", 1);
  CHECK(look_at_terminal().width == 40);
  setenv("COLUMNS", "wide", 1);
  CHECK(look_at_terminal().width == 80);
  unsetenv("COLUMNS");
  CHECK(painted({80, false}, paint::bad, "DIFFER") == "DIFFER");
  CHECK(painted({80, true}, paint::bad, "DIFFER") != "DIFFER");
}

TEST_CASE("a share takes nine columns at most, and is 1 only when it is") {
  CHECK(share_words(1.0) == "1");
  CHECK(share_words(0.25) == "0.25");
  CHECK(share_words(0.0789473684210526) == "0.0789474");
  CHECK(share_words(0.9999999) == "0.9999999");
  CHECK(share_words(0.99999999) == "1-1e-08");
  CHECK(share_words(1 - 1e-16) == "1-1e-16");
  for (const double x : {1.0 / 3, 1e-300 / 3, 0.99999994, 0.99999996, 1 - 4e-12, 2.0 / 3e5}) {
    INFO(x);
    CHECK(share_words(x).size() <= 9);
    CHECK(share_words(x) != "1");
  }
}

TEST_CASE("items are joined while they fit, and a long one goes on in the next line, between words") {
  using lines = std::vector<std::string>;
  CHECK(wrap({"one", "two", "three"}, 8) == lines{"one; two", "three"});
  CHECK(wrap({"one two three four", "five"}, 9) == lines{"one two", "three", "four", "five"});
  CHECK(wrap({"unbreakable word"}, 5) == lines{"unbreakable", "word"});
  CHECK(wrap({}, 5).empty());
}
