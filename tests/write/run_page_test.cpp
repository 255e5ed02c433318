// The page of a run: what is embedded in it, and that no text of a problem becomes markup.
#include "contct/write/run_page.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/page_data.hpp"
#include "contct/write/page_sampling.hpp"
#include "read/bad_plates.hpp"
#include "support/a_run.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
  return n;
}

/// The JSON in the page, as its script will read it.
nlohmann::json embedded_in(const std::string& page) {
  const std::string before = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(before) + before.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

const std::string nasty = "</script><script>alert(1)</script> <b>& \\\"{{data}}\\\" <!--";

}  // namespace

TEST_CASE("a title with markup stays text: no new element comes of it, and the data say it unchanged") {
  const a_run plain(good_problem);
  const a_run titled("title = \"" + nasty + "\"\n" + good_problem);
  const std::string page = run_page(titled.finished());
  CHECK(count(page, "<script") == count(run_page(plain.finished()), "<script"));
  CHECK(count(page, "<b>") == count(run_page(plain.finished()), "<b>"));
  CHECK_THAT(page, Contains("<title>&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt; &lt;b&gt;&amp;"));
  CHECK(embedded_in(page)["title"] == "</script><script>alert(1)</script> <b>& \"{{data}}\" <!--");
}

TEST_CASE("the page names no other file and no network") {
  const std::string page = run_page(a_run(good_problem).finished());
  for (const char* way : {"src=", "@import", "url(", "fetch(", "<link", "<img", "XMLHttp"}) {
    INFO(way);
    CHECK(count(page, way) == 0);
  }
  CHECK(count(page, "http://") == count(page, "http://www.w3.org/2000/svg"));
  CHECK_THAT(page, Contains("default-src 'none'"));
}

TEST_CASE("the parallel edition is in the page, folded, as reference/ has it") {
  std::ifstream file(CONTCT_REFERENCE "/parallel-edition.html");
  const std::string edition(std::istreambuf_iterator<char>(file), {});
  REQUIRE(count(edition, "<pre>") >= 20);
  const std::string page = run_page(a_run(good_problem).finished());
  CHECK_THAT(page, Contains(edition) && Contains("<details id=\"edition\">"));
}

TEST_CASE("the embedded numbers are the run's, with every digit") {
  const a_run r(good_problem);
  const nlohmann::json data = embedded_in(run_page(r.finished()));
  REQUIRE(data["frames"].size() == 3);
  const nlohmann::json& end = data["frames"][2];
  const std::vector<double>& u = r.kept.frames().back().displacement;
  CHECK(end["w"] == std::vector<double>{u[0], u[2], u[4]});
  CHECK(end["slope"] == std::vector<double>{u[1], u[3], u[5]});
  CHECK(end["looks"] == "c");
  CHECK(end["counts"] == std::vector<int>{0, 1, 0});
  CHECK(end["end"] == true);
  CHECK(data["frames"][1]["events"] == nlohmann::json({{1, 3, -1, 1}}));
  CHECK(data["frames"][1]["looks"] == "f");
  CHECK(data["thinned"].empty());
}

TEST_CASE("moment and shear are the elements', on either side of a node, and nothing beyond the ends") {
  const a_run r(good_problem);
  const nlohmann::json data = embedded_in(run_page(r.finished()));
  const nlohmann::json& end = data["frames"][2];
  // 60 down and the stop's force up, at the tip: the shear is the same all along, the moment falls to 0.
  const double tip = 60.0 - 5e4 * (-0.004 - r.kept.frames().back().displacement[4]);
  CHECK(end["shear"]["right"][0].get<double>() == Approx(tip));
  CHECK(end["shear"]["left"][2].get<double>() == Approx(tip));
  CHECK(end["moment"]["right"][0].get<double>() == Approx(-2 * tip));
  CHECK(end["moment"]["left"][1].get<double>() == Approx(-tip));
  CHECK(end["moment"]["right"][1].get<double>() == Approx(-tip));
  CHECK(end["moment"]["left"][0].is_null());
  CHECK(end["moment"]["right"][2].is_null());
  CHECK(end["moment"]["largest"].get<double>() == Approx(-2 * tip));
  CHECK(end["moment"]["node"] == 1);
}

TEST_CASE("every call has its distance from each follower's answer") {
  const a_run r(good_problem);
  const nlohmann::json data = embedded_in(run_page(r.finished()));
  REQUIRE(data["calls"].size() == 2);
  for (const auto& call : data["calls"]) CHECK(call["followers"] == nlohmann::json({{4, 0, 0, 0, 0}}));
  CHECK(data["calls"][0]["smin"] == r.record.calls[0].smin);
  CHECK(r.record.calls[0].smin == Approx(0.25));
  CHECK(data["calls"][0]["ss"] == std::vector<double>{r.record.calls[0].smin});
  CHECK(data["calls"][1]["number"] == 2);
  CHECK_THAT(data["log"].get<std::string>(), Contains("MAKING CONTACT"));
}

TEST_CASE("a plate's frame has w at the crossings of its grid lines, row by row") {
  const a_run r(good_plate);
  const nlohmann::json data = embedded_in(run_page(r.finished()));
  CHECK(data["geometry"]["kind"] == "plate");
  CHECK(data["geometry"]["x"].size() * data["geometry"]["y"].size() == 6);
  const std::vector<double>& u = r.kept.frames().back().displacement;
  CHECK(data["frames"].back()["w"] == std::vector<double>{u[0], u[3], u[6], u[9], u[12], u[15]});
}

TEST_CASE("a large problem is thinned to a bounded size, its largest values are kept, and it is said") {
  std::string text =
      "[beam]\nlength = 50\nelements = 5000\nEI = 1e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";
  text += "[[bed]]\nmodulus = 100.0\nface = -0.01\n[[step]]\npoint = [ { node = 2222, w = -10.0 } ]\n";
  const a_run r(text);
  const shown_parts shown = choose_parts(r.finished());
  const auto frames = r.kept.frames().size();
  CHECK(shown.nodes.size() * frames <= most_places + 70 * frames);
  CHECK(shown.pairs.size() == most_pairs_of_a_beam);
  CHECK(std::find(shown.nodes.begin(), shown.nodes.end(), 0) != shown.nodes.end());
  CHECK(std::find(shown.nodes.begin(), shown.nodes.end(), static_cast<int>(shown.watched)) !=
        shown.nodes.end());
  REQUIRE(shown.said.size() >= 2);
  CHECK_THAT(shown.said[0], Contains(" of 5001 nodes"));
  CHECK_THAT(shown.said[1], Contains("300 of 5000 pairs"));
  const nlohmann::json data = embedded_in(run_page(r.finished()));
  CHECK(data["frames"].back()["counts"][0].get<int>() + data["frames"].back()["counts"][1].get<int>() +
            data["frames"].back()["counts"][2].get<int>() ==
        5000);
  CHECK(data["frames"].back()["largest"]["node"].get<std::size_t>() == shown.watched + 1);
}

TEST_CASE("evenly chosen numbers have both ends, and are all where there are few") {
  CHECK(evenly(5, 9) == std::vector<int>{0, 1, 2, 3, 4});
  CHECK(evenly(11, 3) == std::vector<int>{0, 5, 10});
  CHECK(evenly(0, 3).empty());
  CHECK(evenly(9, 1) == std::vector<int>{0});
}
