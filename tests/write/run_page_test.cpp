// The page of a run: what it draws from, what is embedded in it, and that no text of a problem becomes
// markup.
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/pictures.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "read/small_matrix.hpp"
#include "support/a_run.hpp"
#include "support/scratch_folder.hpp"
#include "support/structures.hpp"

using namespace contct::app;
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

std::vector<double> whole_of(const nlohmann::json& list) {
  return list.get<std::vector<double>>();
}

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

TEST_CASE(
    "a problem with units has a page whatever its structure: only a plate has units of moments per length") {
  const std::string units = "[units]\nlength = \"m\"\nforce = \"kN\"\n";
  const auto of = [&units](const std::string& text) {
    return embedded_in(run_page(a_run(units + text).finished()))["units"];
  };
  const auto on_matrix = of(portal_frame().substr(portal_frame().find("[matrix]")));
  CHECK(on_matrix["w"] == "m");
  CHECK(on_matrix["force"] == "kN");
  CHECK(!on_matrix.contains("mx"));
  CHECK(!of(good_problem).contains("mx"));
  CHECK(of(good_plate)["mxy"] == "kN m/m");
}

TEST_CASE("a page of moments that are no numbers is written, without colours for them") {
  // A spring of 1.6e308 beside a stiffness of 1e-9: where both act, the state between the ends is not finite.
  const std::string contact = "surface = \"below\"\nstate = \"separated\"\n";
  const a_run r(
      "[plate]\nsize = [1.953125, 0.1]\nelements = [2, 1]\nnu = 0.3125\nE = 10\nthickness = 0.001\n"
      "[[support]]\nnode = 3\nfix = [\"w\", \"wx\", \"wy\"]\n"
      "[[contact]]\nnode = 4\nface = -0.125\nstiffness = 0.3333333333333333\n" +
      contact + "[[contact]]\nnode = 6\nface = -0.5\nstiffness = 1.6452542856298016e+308\n" + contact +
      "[[contact]]\nnode = 5\nsurface = \"above\"\nface = 0.0625\nstiffness = 0.46875\n"
      "[[step]]\npoint = [ { node = 1, wy = 1.375 } ]\n[[step]]\npoint = [ { node = 5, wx = -1 } ]\n");
  CHECK(embedded_in(run_page(r.finished())).contains("frames"));
}

TEST_CASE("the page names no other file and no network") {
  const std::string page = run_page(a_run(good_problem).finished());
  for (const char* way : {"src=", "@import", "fetch(", "<link", "<img", "XMLHttp"}) {
    INFO(way);
    CHECK(count(page, way) == 0);
  }
  CHECK(count(page, "url(") == count(page, "url(#part)"));  // a part of the page itself
  CHECK(count(page, "http://") == count(page, "http://www.w3.org/2000/svg"));
  CHECK_THAT(page, Contains("default-src 'none'"));
}

TEST_CASE("the parallel edition is in the page, folded, as reference/ has it") {
  std::ifstream file(CONTCT_REFERENCE "/parallel-edition.html");
  const std::string whole(std::istreambuf_iterator<char>(file), {});
  const std::string edition =
      whole.substr(whole.find("<section"), whole.find("</body>") - whole.find("<section"));
  REQUIRE(count(edition, "<pre>") >= 20);
  const std::string page = run_page(a_run(good_problem).finished());
  CHECK(count(page, "<!DOCTYPE") == 1);
  CHECK(count(page, "<title>") == 1);
  CHECK_THAT(page, Contains(edition) && Contains("<details id=\"edition\">"));
}

TEST_CASE("the numbers of the page are the run's, with every digit") {
  const a_run r(good_problem);
  const nlohmann::json data = page_data(r.finished());
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
  const nlohmann::json data = page_data(r.finished());
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
  CHECK(end["moment"]["least"]["value"].get<double>() == Approx(-2 * tip));
  CHECK(end["moment"]["least"]["node"] == 1);
}

TEST_CASE("every call has its distance from each follower's answer") {
  const a_run r(good_problem);
  const nlohmann::json data = page_data(r.finished());
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
  const nlohmann::json data = page_data(r.finished());
  CHECK(data["geometry"]["kind"] == "plate");
  CHECK(data["geometry"]["x"].size() * data["geometry"]["y"].size() == 6);
  const std::vector<double>& u = r.kept.frames().back().displacement;
  CHECK(data["frames"].back()["w"] == std::vector<double>{u[0], u[3], u[6], u[9], u[12], u[15]});
}

TEST_CASE("the frame's page has its nodes, edges, and displacements to a hundred-thousandth of the largest") {
  const a_run r(portal_frame());
  const nlohmann::json page = page_data(r.finished());
  const auto& g = page["geometry"];
  CHECK(g["kind"] == "mesh");
  CHECK(g["names"].size() == 11);
  CHECK(g["x"][7] == 4.0);
  CHECK(g["y"][7] == 3.0);
  CHECK(g["edges"] == std::vector<int>{0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7, 10, 8, 9, 9, 10});
  CHECK(g["axes"] == std::vector<int>{0, 1});
  CHECK(g["view"] == 0);
  CHECK(g["still"].empty());
  CHECK(g["watched"] == "6.y");
  CHECK(page["place"] == "dof");
  REQUIRE(page["frames"].size() == r.kept.frames().size());
  const double unit = g["unit"].get<double>();
  double largest = 0.0;
  for (std::size_t i = 0; i < page["frames"].size(); ++i) {
    const std::vector<double>& u = r.kept.frames()[i].displacement;  // x, y, r of node after node
    const std::vector<double> drawn = whole_of(page["frames"][i]["u"]);
    REQUIRE(drawn.size() == 22);
    for (std::size_t node = 0; node < 11; ++node) {
      CHECK(std::abs(drawn[2 * node] * unit - u[3 * node]) <= 0.51 * unit);
      CHECK(std::abs(drawn[2 * node + 1] * unit - u[3 * node + 1]) <= 0.51 * unit);
      largest = std::max(largest, std::hypot(u[3 * node], u[3 * node + 1]));
    }
  }
  CHECK(g["reach"] == largest);
  CHECK(unit == Approx(largest / 1e5));
  const auto& pairs = page["pairs"];
  CHECK(pairs[0]["node"] == "6.y");
  CHECK(pairs[0]["at"] == 5);
  CHECK(pairs[0]["direction"] == 2);
  CHECK(pairs[1]["at"] == 7);
  CHECK(pairs[1]["direction"] == 1);
  REQUIRE(page["supports"].size() == 6);
  CHECK(page["supports"][2]["node"] == "1.r");
  CHECK(page["supports"][2]["direction"] == 6);
  CHECK(page["frames"][1]["events"] == nlohmann::json({{1, "6.y", -1, 1}}));
  CHECK(page["thinned"] == nlohmann::json({"Rotations, 11 of 33 dofs, are not drawn."}));
  // The wind: node, direction, dof, value, label.
  const auto& wind = page["frames"][4]["points"];
  REQUIRE(wind.size() == 4);
  CHECK(wind[0] == nlohmann::json({5, 2, 16, -20000.0, "6.y"}));
  CHECK(wind[3] == nlohmann::json({3, 1, 9, 2000.0, "4.x"}));
}

TEST_CASE(
    "the console's page has CalculiX's mesh, its clamped nodes stand still, and modes of bricks are not "
    "drawn") {
  const a_run r(structure_problem("calculix/", "console"));
  const nlohmann::json page = page_data(r.finished());
  const auto& g = page["geometry"];
  CHECK(g["names"].size() == 54);
  CHECK(g["edges"].size() == 222);
  CHECK(g["still"] == std::vector<int>{0, 1, 2, 3, 4, 5});
  CHECK(g["view"] == 3);
  CHECK(g["watched"] == "51.3");
  CHECK(page["pairs"][2]["at"] == 48);
  CHECK(page["pairs"][2]["direction"] == 3);
  CHECK_THAT(page["thinned"].dump(), Contains("144 of 288 dofs have no known node") && Contains("55.1"));
}

TEST_CASE("without coordinates the page has the pairs and the dof that moves most, by their labels") {
  const a_run r(frame_without_coordinates());
  const nlohmann::json page = page_data(r.finished());
  CHECK(page["geometry"] == nlohmann::json({{"kind", "none"}, {"watched", "6.y"}}));
  const auto& end = page["frames"][2];
  const double w = r.kept.frames()[2].displacement[16];
  CHECK(end["at_pairs"][0] == w);
  CHECK(end["watched"] == w);
  CHECK(end["largest"] == nlohmann::json({{"w", w}, {"node", "6.y"}}));
  CHECK_FALSE(end.contains("u"));
  CHECK(page["thinned"].empty());
}

TEST_CASE("a propped cantilever of two elements is drawn with its largest moment inside the second one") {
  const a_run r(propped_cantilever);
  const nlohmann::json data = page_data(r.finished());
  const nlohmann::json& end = data["frames"].back();
  CHECK(end["moment"]["most"]["value"].get<double>() == Approx(9.0 / 128 * 8 * 2 * 2));
  CHECK(end["moment"]["most"]["x"].get<double>() == Approx(5.0 / 8 * 2));
  CHECK(end["moment"]["most"]["node"].is_null());
  CHECK(end["moment"]["least"]["value"].get<double>() == Approx(-8.0 * 2 * 2 / 8));
  // The line between the nodes is w = -q x^2 (2 L^2 .. ) / 48 EI, at every place that is drawn.
  const std::vector<double> x = whole_of(data["geometry"]["x"]);
  REQUIRE(x.size() > 10);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double exact = -8.0 / (48 * 100.0) * x[i] * x[i] * (3 * 4 - 5 * 2 * x[i] + 2 * x[i] * x[i]);
    CHECK(end["w"][i].get<double>() == Approx(exact).margin(1e-15));
    const double moment = -8.0 / 8 * (4 - 5 * 2 * x[i] + 4 * x[i] * x[i]);
    const auto& at = end["moment"][data["geometry"]["nodes"][i] == 3 ? "left" : "right"][i];
    CHECK(at.get<double>() == Approx(moment).margin(1e-12));
  }
  CHECK(end["largest"]["node"].is_null());
  CHECK(end["largest"]["w"].get<double>() == Approx(-8.0 * 16 / 100 * 0.0054161).epsilon(1e-4));
}

TEST_CASE("a distributed load is drawn between its jumps, and a curved one at more places") {
  const std::string beam =
      "[beam]\nlength = 4.0\nelements = 4\nEI = 1.0\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";
  const a_run r(beam +
                "[[step]]\nuniform = [ { value = -2.0, elements = \"1..2\" }, { polynomial = [0.0, 1.0], "
                "elements = \"4..4\" } ]\n");
  const nlohmann::json data = page_data(r.finished());
  CHECK(data["geometry"]["loaded"] == nlohmann::json({{0.0, 2.0}, {3.0, 4.0}}));
  CHECK(data["frames"].back()["q"] == std::vector<double>{-2.0, -2.0, 3.0, 4.0});
  const a_run curved(beam + "[[step]]\nuniform = [ { polynomial = [0.0, 0.0, 1.0] } ]\n");
  const nlohmann::json page = page_data(curved.finished());
  CHECK(page["geometry"]["loaded"] == nlohmann::json({{0.0, 4.0}}));
  CHECK(page["frames"].back()["q"].size() == 13);
  CHECK(page["frames"].back()["q"][3] == 1.0);
}

TEST_CASE("a plate's frame has moments and the bed's pressure for contours, to four digits") {
  a_run r(good_plate);
  r.what.beds = {{4.0, {0.5}, 0}};
  const nlohmann::json end = page_data(r.finished())["frames"].back();
  for (const char* name : {"mx", "my", "mxy", "pressure"}) CHECK(end[name].size() == 6);
  const frame& f = r.kept.frames().back();
  const contact_pair& pair = r.what.pairs[0];
  CHECK(end["pressure"][pair.node].get<double>() ==
        Approx(reading_of(r.what, f, 0).force / 0.5).epsilon(1e-3));
  const auto moments = moments_in_elements(std::get<plate>(r.what.geometry.kind), f.displacement);
  CHECK(end["mx"][0].get<double>() == Approx(moments[0].mx[0]).epsilon(1e-3));
  CHECK(end["mx"][1].get<double>() == Approx((moments[0].mx[1] + moments[1].mx[0]) / 2).epsilon(1e-3));
}

TEST_CASE("point loads are drawn at their nodes, and a support's force is that on its deflection") {
  const a_run r(good_problem);
  const nlohmann::json data = embedded_in(run_page(r.finished()));
  const auto& last = data["frames"].back();
  CHECK(last["points"][0][4] == 3);  // from 1
  CHECK(last["points"][0][0] == 2.0);
  const frame& end = r.kept.frames().back();
  const std::vector<double> all = reactions(r.what, load_path(r.what).at(1, 1.0), end.displacement, end.isep);
  REQUIRE(r.what.supports[0].dof == 0);
  CHECK(last["reactions"][0] == all[0]);  // and not the moment all[1]
}

TEST_CASE("a matrix whose dofs all turn has a page, whose largest deflection is none") {
  const scratch_folder folder;
  std::ofstream(folder.at("K.mtx")) << small_matrix;
  std::ofstream(folder.at("K.dof")) << "a.4\na.5\na.6\n";
  std::ofstream(folder.at("K.xyz")) << "a 0 0\n";
  const a_run r("[matrix]\nstiffness = \"" + folder.at("K.mtx") + "\"\ndofs = \"" + folder.at("K.dof") +
                "\"\ncoordinates = \"" + folder.at("K.xyz") +
                "\"\n[[step]]\npoint = [ { dof = \"a.5\", value = 2.0 } ]\n");
  const nlohmann::json data = embedded_in(run_page(r.finished()));
  CHECK(data["frames"].back()["largest"]["w"] == 0.0);
}
