// Text made safe for XML and for messages of one line.
#include "contct/text/markup.hpp"

#include "catch.hpp"

using namespace contct::app;

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
