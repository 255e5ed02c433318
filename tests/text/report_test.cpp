// Reports for machines: JUnit that is well-formed whatever stands in it, Markdown that shows in a table.
#include "contct/text/report.hpp"

#include "catch.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

const check_report two_of_three{
    "contct replay",
    {"floating point: strict"},
    {{"a.trace: cpp", outcome::passed, "equal", ""},
     {"b <&> \"c\".trace: mine", outcome::failed, "1 mismatch | here", "call 1: SS(1)\n\x01 odd"},
     {"c.trace: cpp", outcome::skipped, "another precision", ""}},
    0.5};

}  // namespace

TEST_CASE("a JUnit report counts what failed and was skipped, and escapes what XML forbids") {
  const std::string xml = junit_xml(two_of_three);
  CHECK_THAT(xml, Contains("tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\" time=\"0.500\""));
  CHECK_THAT(xml, Contains("name=\"b &lt;&amp;&gt; &quot;c&quot;.trace: mine\""));
  CHECK_THAT(xml,
             Contains("<failure message=\"1 mismatch | here\">call 1: SS(1)\n\xEF\xBF\xBD odd</failure>"));
  CHECK_THAT(xml, Contains("<skipped message=\"another precision\"/>"));
  CHECK(xml.find('\x01') == std::string::npos);
  CHECK_THAT(junit_xml({"two\nlines", {}, {}, 0.0}),
             Contains("<testsuite name=\"two&#10;lines\" tests=\"0\""));
}

TEST_CASE("a Markdown summary begins with the verdict and keeps to its table") {
  const std::string text = markdown(two_of_three);
  CHECK(text.rfind("## contct replay: failed\n", 0) == 0);
  CHECK_THAT(text, Contains("1 passed, 1 failed, 1 skipped"));
  CHECK_THAT(text, Contains("| **failed** | 1 mismatch \\| here |"));
  CHECK_THAT(text, Contains("```\ncall 1: SS(1)"));
}

TEST_CASE("a report without failures says so") {
  check_report good = two_of_three;
  good.results.resize(1);
  CHECK(markdown(good).rfind("## contct replay: passed\n", 0) == 0);
  CHECK_THAT(junit_xml(good), Contains("failures=\"0\"") && !Contains("<failure"));
}
