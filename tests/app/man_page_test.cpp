// Pages for man: text as roff takes it, and what becomes of Markdown.
#include "app/man_page.hpp"

#include <string>

#include "catch.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;
using Catch::Matchers::EndsWith;
using Catch::Matchers::StartsWith;

namespace {

std::string page_of(const char* markdown) {
  return page_from_markdown({"contct-thing", "things of contct", markdown});
}

/// What becomes of Markdown, without what every page has.
std::string body_of(const char* markdown) {
  const std::string text = page_of(markdown);
  const std::string before = ".SH DESCRIPTION\n";
  const std::size_t from = text.find(before) + before.size();
  return text.substr(from, text.find(".SH SEE ALSO") - from);
}

}  // namespace

TEST_CASE("a typed hyphen stays one, and no line is taken for a request") {
  CHECK(roff("--json a\\b") == "\\-\\-json a\\eb");
  CHECK(roff(".5") == "\\&.5");
  CHECK(roff("'a'") == "\\&'a'");
  CHECK(roff("x^2 ~ y") == "x\\(ha2 \\(ti y");
}

TEST_CASE("a paragraph is broken at 72 characters, and a line that begins with a point is no request") {
  const std::string text = filled(std::string(70, 'a') + " .. " + std::string(10, 'b'));
  CHECK(text == std::string(70, 'a') + "\n\\&.. " + std::string(10, 'b') + "\n");
}

TEST_CASE("a page has its title, its name and the program's page beside its text") {
  const std::string text = page_of("# The thing\n\nIt is a thing.\n");
  CHECK_THAT(text, StartsWith(".TH CONTCT\\-THING 5 "));
  CHECK_THAT(text,
             Contains(".SH NAME\ncontct\\-thing \\- things of contct\n.SH DESCRIPTION\nIt is a thing.\n"));
  CHECK_THAT(text, EndsWith(".SH SEE ALSO\n.BR contct (1)\n"));
  CHECK_THAT(text, !Contains("The thing"));
}

TEST_CASE("headings, paragraphs and lists become the macros of man") {
  CHECK(body_of("One\nline.\n\nTwo.\n\n## Part `[a]`\n\nThree.\n\n### Of it\n- **x.** First,\n  longer.\n- "
                "Second.\n") ==
        "One line.\n.PP\nTwo.\n.SH Part \\fB[a]\\fR\nThree.\n.SS Of it\n"
        ".IP \\(bu 2\n\\fBx.\\fR First, longer.\n.IP \\(bu 2\nSecond.\n");
}

TEST_CASE("of a link its text stays, and code is as it is typed") {
  CHECK(body_of("See [the `[a]` table](#a) (here): `it's -1`, a * b [c].\n") ==
        "See the \\fB[a]\\fR table (here): \\fBit\\(aqs \\-1\\fR, a * b [c].\n");
}

TEST_CASE("a block of code is not filled, and its lines begin no requests and no headings") {
  CHECK(body_of("A:\n\n```toml\n# x\n.5 = -1\n\n| a |\n```\nB.\n") ==
        "A:\n.PP\n.RS 4\n.nf\n# x\n\\&.5 = \\-1\n\n| a |\n.fi\n.RE\n.PP\nB.\n");
}

TEST_CASE("a row of a table becomes an entry with the facts of its other columns") {
  CHECK(body_of("| key | type, allowed | unit | meaning |\n| --- | --- | --- | --- |\n"
                "| `x` | number | length | a place |\n| `y` | `a\\|b` | | |\n| `z` | | | a third |\n") ==
        ".TP\n\\fBx\\fR\ntype: number; unit: length\n.br\na place\n"
        ".TP\n\\fBy\\fR\ntype: \\fBa|b\\fR\n.TP\n\\fBz\\fR\na third\n");
}

TEST_CASE("a cell that begins with a word of its column's name does not have that name before it") {
  CHECK(body_of("| key | absent or null | meaning |\n| --- | --- | --- |\n| a | null: no b | c |\n") ==
        ".TP\na\nnull: no b\n.br\nc\n");
}

TEST_CASE("tables with a paragraph between them have columns of their own") {
  CHECK(body_of("| a | b |\n| --- | --- |\n| 1 | 2 |\n\nText.\n\n| c | d | e |\n| --- | --- | --- |\n| 3 | 4 "
                "| 5 |\n") == ".TP\n1\n2\n.PP\nText.\n.TP\n3\nd: 4\n.br\n5\n");
}

TEST_CASE("Markdown that is cut short ends the page and nothing else") {
  for (const char* text : {"", "#", "|", "`a", "**a", "[a](b", "```\na", "| a |\n| `b", "- "})
    CHECK_THAT(page_of(text), EndsWith(".BR contct (1)\n"));
}
