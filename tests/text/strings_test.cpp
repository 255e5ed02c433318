// What somebody meant who mistyped, and text made safe for XML and for messages of one line.
#include "contct/text/strings.hpp"

#include <vector>

#include "catch.hpp"

using namespace contct::app;

TEST_CASE("edits are counted: put in, left out, replaced, swapped") {
  CHECK(edits_between("stiffness", "stiffness") == 0);
  CHECK(edits_between("stifness", "stiffness") == 1);
  CHECK(edits_between("stiffnesss", "stiffness") == 1);
  CHECK(edits_between("stiffmess", "stiffness") == 1);
  CHECK(edits_between("stfifness", "stiffness") == 1);  // two neighbours swapped
  CHECK(edits_between("", "face") == 4);
  CHECK(edits_between("face", "") == 4);
  CHECK(edits_between("kitten", "sitting") == 3);
  CHECK(edits_between("FACE", "face") == 0);
}

TEST_CASE("edits are the same both ways, and never more than the longer word has letters") {
  const std::vector<std::string> words = {"run", "rnu", "verify", "explain", "", "face", "stiffness"};
  for (const std::string& a : words) {
    for (const std::string& b : words) {
      CHECK(edits_between(a, b) == edits_between(b, a));
      CHECK(edits_between(a, b) <= static_cast<int>(std::max(a.size(), b.size())));
    }
  }
}

TEST_CASE("the nearest word is meant, and none where too much is wrong") {
  const std::vector<std::string> keys = {"node", "nodes", "surface", "face", "stiffness"};
  CHECK(did_you_mean("stifness", keys) == " (did you mean \"stiffness\"?)");
  CHECK(did_you_mean("Stiffness", keys) == " (did you mean \"stiffness\"?)");
  CHECK(did_you_mean("fase", keys) == " (did you mean \"face\"?)");
  CHECK(did_you_mean("nod", keys) == " (did you mean \"node\"?)");
  CHECK(did_you_mean("colour", keys).empty());
  CHECK(did_you_mean("", keys).empty());
  CHECK(did_you_mean(std::string(100'000, 's'), keys).empty());
  const std::vector<std::string> one = {"w"};
  CHECK(did_you_mean("x", one).empty());  // all of it would be wrong
}

TEST_CASE("words are joined, and characters are escaped one by one") {
  CHECK(joined({}, ", ").empty());
  CHECK(joined({"one"}, ", ") == "one");
  CHECK(joined({"one", "", "three"}, ", ") == "one, , three");
  constexpr escape escapes[] = {{'-', "\\-"}, {'\\', "\\e"}};
  CHECK(escaped("a-\\-", escapes) == "a\\-\\e\\-");
}

TEST_CASE("what has a meaning in XML is escaped, and what XML forbids becomes U+FFFD") {
  CHECK(markup_text("a < b && \"c\" > d'") == "a &lt; b &amp;&amp; &quot;c&quot; &gt; d'");
  CHECK(markup_text("tab\t line\n return\r") == "tab\t line\n return\r");
  CHECK(markup_text(std::string("\0\x1b\x7f", 3)) == "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  CHECK(markup_text("\xc3\xa9") == "\xc3\xa9");
}

TEST_CASE("control characters are written out in messages, and UTF-8 stays") {
  CHECK(printable(std::string("a\0\t\n\x1f\x7f b", 8)) == "a\\x00\\x09\\x0a\\x1f\\x7f b");
  CHECK(printable("\xc3\xa9") == "\xc3\xa9");
  CHECK(printable("").empty());
}

TEST_CASE("long text is cut between characters") {
  CHECK(printable("abcdef", 6) == "abcdef");
  CHECK(printable("abcdef", 5) == "abcde...");
  CHECK(printable("ab\u4e2d\u4e2d", 4) == "ab...");
  CHECK(printable("ab\u4e2d\u4e2d", 5) == "ab\u4e2d...");
  CHECK(in_quotes(std::string(61, 'x')) == "\"" + std::string(60, 'x') + "...\"");
  CHECK(in_quotes(std::string(60, 'x')) == "\"" + std::string(60, 'x') + "\"");
}
