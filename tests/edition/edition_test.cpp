// The parallel edition is complete, quotes what stands there, and its pages are those that it makes.
#include "edition/edition.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "catch.hpp"
#include "contct/text/input_text.hpp"
#include "support/scratch_folder.hpp"

using namespace contct_test;
using Catch::Matchers::Contains;

namespace {

const std::filesystem::path root = CONTCT_ROOT;

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

edition as_it_is() {
  return read_edition(CONTCT_EDITION_MAP);
}

/// The one fault of a doctored map.
std::string only_fault_of(const edition& e) {
  const std::vector<std::string> faults = faults_of(e, sources(root));
  REQUIRE(faults.size() == 1);
  return faults[0];
}

}  // namespace

TEST_CASE(
    "every statement of the listing is in the map exactly once, and every quoted block stands in its file "
    "once") {
  const edition e = as_it_is();
  for (const std::string& fault : faults_of(e, sources(root))) FAIL_CHECK(fault);
  std::size_t lines = 0;
  std::size_t blocks = 0;
  for (const edition_part& p : e.parts) {
    lines += p.listing.size();
    blocks += p.cpp.size();
    CHECK_FALSE(p.cpp.empty());
  }
  CHECK(lines == 45);
  CHECK(blocks >= e.parts.size());
}

TEST_CASE("the steps of the paper's algorithm come in their order, from 1 to 14") {
  std::string steps;
  for (const edition_part& p : as_it_is().parts)
    if (!p.step.empty()) steps += p.step + "; ";
  CHECK(steps == "1; 2; 3; 4; 5, 6; 7; 8; 9 to 11; 12, 13; 14; 14; 14; ");
}

TEST_CASE("the pages in reference are those that the map and the sources make") {
  const edition e = as_it_is();
  const sources s(root);
  CHECK(text_of(root / "reference/parallel-edition.md") == markdown_page(e, s));
  CHECK(text_of(root / "reference/parallel-edition.html") == html_page(e, s));
}

TEST_CASE("a map that leaves a statement out is noticed, whichever it is") {
  const edition whole = as_it_is();
  int left_out = 0;
  for (std::size_t p = 0; p < whole.parts.size(); ++p) {
    for (std::size_t i = 0; i < whole.parts[p].listing.size(); ++i) {
      edition doctored = whole;
      const int line = whole.parts[p].listing[i];
      doctored.parts[p].listing.erase(doctored.parts[p].listing.begin() + static_cast<std::ptrdiff_t>(i));
      CHECK_THAT(only_fault_of(doctored), Contains("line " + std::to_string(line) + ": is left out: "));
      ++left_out;
    }
  }
  CHECK(left_out == 45);
}

TEST_CASE("a map with a statement twice, a comment, or a line beyond the end is noticed") {
  edition doctored = as_it_is();
  doctored.parts[0].listing.push_back(26);
  CHECK_THAT(only_fault_of(doctored), Contains("line 26: is in the map 2 times"));
  doctored = as_it_is();
  doctored.parts[0].listing.push_back(24);
  CHECK_THAT(only_fault_of(doctored), Contains("line 24: is a comment"));
  doctored = as_it_is();
  doctored.parts[0].listing.push_back(70);
  CHECK_THAT(only_fault_of(doctored), Contains("line 70: there is no such line"));
}

TEST_CASE("C++ that does not stand there, stands there twice, or whose file is gone is noticed") {
  edition doctored = as_it_is();
  doctored.parts[2].cpp[0].lines = {"Real s_min = Real(2);"};
  CHECK_THAT(only_fault_of(doctored),
             Contains("\"Real s_min = Real(2);\" and what follows it stands there 0 times"));
  doctored.parts[2].cpp[0].lines = {"}"};
  CHECK_THAT(only_fault_of(doctored), Contains("allowed: once"));
  doctored = as_it_is();
  doctored.parts[2].cpp[0].file = "cpp/contct/kernel/gone.hpp";
  CHECK_THAT(only_fault_of(doctored), Contains("cpp/contct/kernel/gone.hpp"));
}

TEST_CASE("the page changes when the map does, and the HTML is escaped and closed") {
  const sources s(root);
  edition e = as_it_is();
  const std::string before = markdown_page(e, s);
  e.parts[3].note += " Another word.";
  CHECK(markdown_page(e, s) != before);
  const std::string html = html_fragment(e, s);
  CHECK_THAT(html, Contains("if (s &gt; Real(0) &amp;&amp; s &lt; s_min) s_min = s;"));
  for (const char* tag : {"section", "table", "tr", "td", "th", "pre", "p", "blockquote", "code", "h3"}) {
    const auto count = [&html](const std::string& piece) {
      int n = 0;
      for (std::size_t at = html.find(piece); at != std::string::npos; at = html.find(piece, at + 1)) ++n;
      return n;
    };
    const std::string name = tag;
    CHECK(count("<" + name + ">") + count("<" + name + " ") == count("</" + name + ">"));
  }
}

TEST_CASE("the HTML is a page of its own, with its section once") {
  const std::string page = html_page(as_it_is(), sources(root));
  CHECK(page.starts_with("<!DOCTYPE html>\n"));
  CHECK_THAT(page, Contains("<title>CONTCT: the parallel edition</title>") && Contains("name=\"viewport\"") &&
                       Contains("<style>") && Catch::Matchers::EndsWith("</section>\n</body>\n</html>\n"));
  CHECK(page.find("<section") == page.rfind("<section"));
}

TEST_CASE("a map with a key that it does not know is refused") {
  const contct::app::scratch_folder folder;
  const std::string file = folder.write("map.toml", text_of(CONTCT_EDITION_MAP) + "\nfootnote = \"x\"\n");
  CHECK_THROWS_AS(read_edition(file), contct::app::input_error);
}
