// Tests the page of a run: its data, its embedded files, and the escaping of a problem's text.
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/outputs.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
  return n;
}

/// Returns the JSON in the page as its script reads it.
nlohmann::json embedded_in(const std::string& page) {
  const std::string before = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(before) + before.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

const std::string nasty = "</script><script>alert(1)</script> <b>& \\\"{{data}}\\\" <!--";

}  // namespace

TEST_CASE(
    "markup in a title adds no element to the report page, and the data of the page have the title "
    "unchanged") {
  const a_run plain(good_problem);
  const a_run titled("title = \"" + nasty + "\"\n" + good_problem);
  const std::string page = run_page(titled.result);
  CHECK(count(page, "<script") == count(run_page(plain.result), "<script"));
  CHECK(count(page, "<b>") == count(run_page(plain.result), "<b>"));
  CHECK_THAT(page, Contains("<title>&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt; &lt;b&gt;&amp;"));
  CHECK(embedded_in(page)["title"] == "</script><script>alert(1)</script> <b>& \"{{data}}\" <!--");
}

TEST_CASE("the report page refers to no other file and to no network address") {
  const std::string page = run_page(a_run(good_problem).result);
  for (const char* way : {"src=", "@import", "fetch(", "<link", "<img", "XMLHttp", "url("}) {
    INFO(way);
    CHECK(count(page, way) == 0);
  }
  CHECK(count(page, "http://") == count(page, "http://www.w3.org/2000/svg"));
  CHECK_THAT(page, Contains("default-src 'none'"));
}

TEST_CASE("the report page contains the parallel edition of paper and listing in a folded section") {
  std::ifstream file(CONTCT_REFERENCE "/parallel-edition.html");
  const std::string whole(std::istreambuf_iterator<char>(file), {});
  const std::string edition =
      whole.substr(whole.find("<section"), whole.find("</body>") - whole.find("<section"));
  REQUIRE(count(edition, "<pre>") >= 20);
  const std::string page = run_page(a_run(good_problem).result);
  CHECK(count(page, "<!DOCTYPE") == 1);
  CHECK(count(page, "<title>") == 1);
  CHECK_THAT(page, Contains(edition) && Contains("<details id=\"edition\">"));
}
