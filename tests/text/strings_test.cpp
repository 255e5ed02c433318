// Tests suggestions for misspelt words, text escaped for XML and for messages, shares and amounts, and
// tables' widths, colours and line breaks.
#include "contct/text/strings.hpp"

#include <stdlib.h>  // setenv

#include "catch.hpp"
#include "contct/text/memory.hpp"
#include "contct/text/terminal.hpp"

using namespace contct;

namespace {

int width_with(const char* columns) {
  REQUIRE(setenv("COLUMNS", columns, 1) == 0);
  const int width = look_at_terminal().width;
  REQUIRE(unsetenv("COLUMNS") == 0);
  return width;
}

}  // namespace

TEST_CASE("a message suggests the nearest known word, unless too many letters differ") {
  const std::vector<std::string> keys = {"node", "nodes", "surface", "face", "stiffness"};
  for (const auto& [word, meant] : {std::pair("stifness", "stiffness"),
                                    {"Stiffness", "stiffness"},
                                    {"fase", "face"},
                                    {"nod", "node"},
                                    {"stfifness", "stiffness"}})  // two neighbouring letters are swapped
    CHECK(did_you_mean(word, keys) == " (did you mean \"" + std::string(meant) + "\"?)");
  for (const std::string& none : {std::string("colour"), std::string(), std::string(100'000, 's')})
    CHECK(did_you_mean(none, keys).empty());
  CHECK(did_you_mean("x", std::vector<std::string>{"w"}).empty());  // no letter is right
}

TEST_CASE("joined puts a separator between words, and escaped replaces each given character by a text") {
  CHECK(joined({}, ", ").empty());
  CHECK(joined({"one"}, ", ") == "one");
  CHECK(joined({"one", "", "three"}, ", ") == "one, , three");
  constexpr escape escapes[] = {{'-', "\\-"}, {'\\', "\\e"}};
  CHECK(escaped("a-\\-", escapes) == "a\\-\\e\\-");
}

TEST_CASE("markup_text escapes the special characters of XML, and replaces forbidden characters by U+FFFD") {
  CHECK(markup_text("a < b && \"c\" > d'") == "a &lt; b &amp;&amp; &quot;c&quot; &gt; d'");
  CHECK(markup_text("tab\t line\n return\r") == "tab\t line\n return\r");
  CHECK(markup_text(std::string("\0\x1b\x7f", 3)) == "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
  CHECK(markup_text("\xc3\xa9") == "\xc3\xa9");
}

TEST_CASE("printable escapes control characters, but not UTF-8 letters") {
  CHECK(printable(std::string("a\0\t\n\x1f\x7f b", 8)) == "a\\x00\\x09\\x0a\\x1f\\x7f b");
  CHECK(printable("\xc3\xa9") == "\xc3\xa9");
  CHECK(printable("").empty());
}

TEST_CASE("terminal_text escapes control characters, marks of text direction, and invalid UTF-8") {
  CHECK(terminal_text("a\x1b[31m\x07\x7f\n") == "a\\x1b[31m\\x07\\x7f\n");
  // NOLINTNEXTLINE(misc-misleading-bidirectional): these marks are what is escaped
  CHECK(terminal_text("\u009b31m\u202e\u2067x") == "\\xc2\\x9b31m\\xe2\\x80\\xae\\xe2\\x81\\xa7x");
  for (const char* kept :
       {"\u00a0\u00e9", "\u2029\u202f\u2065\u206a", "\U0001F600", "\u05d0", "\ud7ff\ue000"})
    CHECK(terminal_text(kept) == kept);
  // Cut sequences, overlong sequences, a surrogate, a value beyond Unicode, and bytes that begin no sequence.
  for (const auto& [bytes, words] : {std::pair("\xc3", "\\xc3"),
                                     {"\xe2\x80", "\\xe2\\x80"},
                                     {"\xc0\x9b", "\\xc0\\x9b"},
                                     {"\xe0\x82\x9b", "\\xe0\\x82\\x9b"},
                                     {"\xf0\x80\x82\x9b", "\\xf0\\x80\\x82\\x9b"},
                                     {"\xed\xa0\x80", "\\xed\\xa0\\x80"},
                                     {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"},
                                     {"\x9b\xff", "\\x9b\\xff"}})
    CHECK(terminal_text(bytes) == words);
}

TEST_CASE("on_one_line replaces line ends by blanks, and json_escaped uses the escapes of JSON") {
  CHECK(on_one_line("two\nlines\r\tand \x1b") == "two lines  and \\x1b");
  CHECK(json_escaped("{\"a\": \"\x7f\u0085\u202e\u00e9\"}\n") ==
        "{\"a\": \"\\u007f\\u0085\\u202e\u00e9\"}\n");
  // NOLINTNEXTLINE(misc-misleading-bidirectional): the same
  CHECK(markup_text("\u009b\u2066\xff") == "\uFFFD\uFFFD\uFFFD");
}

TEST_CASE("a message quotes a field if it looks like a number or is short, and else gives its length") {
  for (const char* number : {"12", "-1.5e+300", "1,5", "0x1p3", "NaN", "-inf", "1.5D0", "1 2"})
    CHECK(field_words(number) == std::string("\"") + number + "\"");
  CHECK(field_words("root:x:0:0") == "a word of 10 bytes");
  CHECK(field_words("x\x1b") == "\"x\\x1b\"");  // at most 3 bytes are always quoted
  CHECK(field_words("root") == "a word of 4 bytes");
  CHECK(field_words("e d e", "a line") == "a line of 5 bytes");  // no digit
  CHECK(field_words(std::string(33, '1')) == "\"" + std::string(32, '1') + "...\"");
}

TEST_CASE("text that is too long is cut between two UTF-8 characters") {
  CHECK(printable("abcdef", 6) == "abcdef");
  CHECK(printable("abcdef", 5) == "abcde...");
  CHECK(printable("ab\u4e2d\u4e2d", 4) == "ab...");
  CHECK(printable("ab\u4e2d\u4e2d", 5) == "ab\u4e2d...");
  CHECK(in_quotes(std::string(61, 'x')) == "\"" + std::string(60, 'x') + "...\"");
  CHECK(in_quotes(std::string(60, 'x')) == "\"" + std::string(60, 'x') + "\"");
}

TEST_CASE("a share in per cent and an amount of memory are written with few digits and without an exponent") {
  for (const auto& [share, words] :
       {std::pair(1e-6, "0.0001 %"), {0.03, "3 %"}, {0.0251, "2.5 %"}, {19.07, "1907 %"}})
    CHECK(percent_words(share) == words);
  CHECK(bytes_words(1 << 19) == "0.5 MiB");
  CHECK(bytes_words(std::int64_t{20} << 20) == "20 MiB");
  CHECK(bytes_words(std::int64_t{3} << 29) == "1.5 GiB");
  CHECK(memory_limit() > 0);
}

TEST_CASE("COLUMNS sets the width of a table between 40 and 160, and an invalid COLUMNS gives 80") {
  for (const auto& [columns, width] :
       {std::pair("100", 100), {"10", 40}, {"1000", 160}, {"0", 80}, {"-5", 80}, {"wide", 80}})
    CHECK(width_with(columns) == width);
}

TEST_CASE("text is coloured only if colour is requested") {
  CHECK(painted({80, false}, paint::bad, "no") == "no");
  CHECK(painted({80, true}, paint::good, "yes") == "\033[32myes\033[0m");
  CHECK(painted({80, true}, paint::bad, "no") == "\033[1;31mno\033[0m");
  CHECK(painted({80, true}, paint::quiet, "so") == "\033[2mso\033[0m");
  CHECK(painted({80, true}, paint::strong, "so") == "\033[1mso\033[0m");
}

TEST_CASE("wrap puts several items on a line, and breaks a long item only at blanks") {
  using lines = std::vector<std::string>;
  CHECK(wrap({"a", "b", "c"}, 4) == lines{"a; b", "c"});
  CHECK(wrap({"one two three"}, 7) == lines{"one two", "three"});
  CHECK(wrap({"one two three"}, 6) == lines{"one", "two", "three"});
  CHECK(wrap({"a unbreakable b"}, 5) == lines{"a", "unbreakable", "b"});
  CHECK(wrap({""}, 5) == lines{""});
}
