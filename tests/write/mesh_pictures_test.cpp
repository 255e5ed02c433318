// Pictures of structures from elsewhere: drawn where coordinates are known, told in tables where they are
// not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "catch.hpp"
#include "contct/outside/registry.hpp"
#include "contct/text/input_text.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/mesh_numbers.hpp"
#include "contct/write/page_data.hpp"
#include "contct/write/page_sampling.hpp"
#include "contct/write/run_csv.hpp"
#include "contct/write/run_svg.hpp"
#include "contct/write/run_vtu.hpp"
#include "support/a_run.hpp"
#include "support/scratch_folder.hpp"
#include "support/well_formed.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

const std::string structures = CONTCT_REFERENCE "/structures/";

/// A problem of reference/structures, its files named from wherever the test runs; `replaced` are lines.
std::string problem_in(const std::string& folder, const std::string& name,
                       const std::vector<std::pair<std::string, std::string>>& replaced = {}) {
  std::string text = read_input(structures + folder + name + ".toml");
  const auto put = [&text](const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  for (const auto& [from, to] : replaced) {
    REQUIRE(text.find(from) != std::string::npos);
    put(from, to);
  }
  for (const char* file : {"frame.mtx", "frame.dof", "frame.xyz", "wind.mtx"})
    put(std::string("\"") + file, "\"" + structures + folder + file);
  put("job = \"", "job = \"" + structures + folder);
  return text;
}

const std::vector<std::pair<std::string, std::string>> nowhere = {{"coordinates = \"frame.xyz\"", ""}};

std::vector<double> whole_of(const nlohmann::json& list) {
  return list.get<std::vector<double>>();
}

placed_nodes at_places(const std::vector<in_space>& at, const std::vector<int>& directions) {
  placed_nodes places;
  for (const in_space& p : at) places.nodes.push_back({std::to_string(places.nodes.size()), p});
  for (const int direction : directions) places.dofs.push_back({0, direction});
  return places;
}

}  // namespace

TEST_CASE("a flat structure that stays flat is looked at straight on, any other from the front and above") {
  const std::vector<in_space> in_xy = {{0, 0, 1}, {1, 0, 1}, {0, 2, 1}};
  const std::vector<in_space> in_xz = {{0, 5, 1}, {1, 5, 0}, {0, 5, 2}};
  const std::vector<in_space> in_yz = {{3, 5, 1}, {3, 4, 0}, {3, 5, 2}};
  const auto view = [](const std::vector<in_space>& at, const std::vector<int>& directions) {
    return std::string(view_at(fitting_view(at_places(at, directions))).name);
  };
  CHECK(view(in_xy, {1, 2, 6}) == "xy");
  CHECK(view(in_xy, {3, 4, 5}) == "oblique");
  CHECK(view(in_xz, {1, 3}) == "xz");
  CHECK(view(in_yz, {2, 3, 4}) == "yz");
  CHECK(view({{0, 0, 0}, {1, 1, 1}}, {1}) == "oblique");
  CHECK(view({{0, 0, 0}, {1, 0, 0}}, {3}) == "xz");  // a beam along x
  CHECK(view({{0, 0, 0}, {1, 0, 0}}, {2}) == "xy");
  for (int i = 0; i < views; ++i) {
    const structure_view& v = view_at(i);
    INFO(v.name);
    CHECK(length_of(v.right) == Approx(1).epsilon(1e-3));
    CHECK(length_of(v.up) == Approx(1).epsilon(1e-3));
    CHECK(std::abs(v.x_of(v.up)) < 1e-3);
  }
}

TEST_CASE("the frame's page has its nodes, edges, and displacements to a hundred-thousandth of the largest") {
  const a_run r(problem_in("", "frame"));
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
  const a_run r(problem_in("calculix/", "console"));
  const nlohmann::json page = page_data(r.finished());
  const auto& g = page["geometry"];
  CHECK(g["names"].size() == 54);
  CHECK(g["edges"].size() == 2 * 111);
  CHECK(g["still"] == std::vector<int>{0, 1, 2, 3, 4, 5});
  CHECK(g["view"] == 3);
  CHECK(g["watched"] == "51.3");
  CHECK(page["pairs"][2]["at"] == 48);
  CHECK(page["pairs"][2]["direction"] == 3);
  CHECK_THAT(page["thinned"].dump(), Contains("144 of 288 dofs have no known node") && Contains("55.1"));
}

TEST_CASE("without coordinates the page has the pairs and the dof that moves most, by their labels") {
  const a_run r(problem_in("", "frame", nowhere));
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

TEST_CASE("what deflects is what is known to be a length: a matrix's pairs, and what is along an axis") {
  const problem placed = parse_problem(problem_in("", "frame"), "p.toml");
  const std::vector<int> dofs = deflecting_nodes(placed);
  CHECK(dofs.size() == 22);
  CHECK(std::none_of(dofs.begin(), dofs.end(), [](int dof) { return dof % 3 == 2; }));
  problem bare = parse_problem(problem_in("", "frame", nowhere), "p.toml");
  CHECK(deflecting_nodes(bare) == std::vector<int>{16, 21});
  bare.pairs.clear();
  CHECK(deflecting_nodes(bare).size() == 33);
}

TEST_CASE(
    "the picture of a structure from elsewhere is well-formed, with a mark for every pair, or with a table") {
  for (const std::string& text :
       {problem_in("", "frame"), problem_in("calculix/", "console"), problem_in("", "frame", nowhere)}) {
    const a_run r(text);
    const std::string svg = run_svg(r.finished());
    CHECK(why_not_well_formed(svg).empty());
    CHECK_THAT(svg, !Contains("nan") && !Contains("inf"));
    const auto& a = std::get<assembled>(r.what.geometry.kind);
    for (std::size_t i = 0; i < r.what.pairs.size(); ++i) {
      const std::string label = a.label_of(r.what.pairs[i].node);
      CHECK_THAT(svg, Contains(a.places.known() ? fmt::format("<title>pair {}, dof {}, face", i + 1, label)
                                                : fmt::format(">{}</text>", label)));
    }
    CHECK((svg.find("class=\"member\"") != std::string::npos) == a.places.known());
    CHECK((svg.find("no coordinates are known") == std::string::npos) == a.places.known());
  }
}

TEST_CASE("the frame's picture has its corner where it is, and is drawn where it was when it came back") {
  const a_run r(problem_in("", "frame"));
  const std::string svg = run_svg(r.finished());
  // Unloaded at the end: both paths are the same, and 4 m are wider than 3 m are high.
  const auto path_of = [&svg](const std::string& kind) {
    const std::size_t to = svg.find("\" class=\"" + kind + "\"/>");
    const std::size_t from = svg.rfind("d=\"", to) + 3;
    return svg.substr(from, to - from);
  };
  CHECK(path_of("member") == path_of("was"));
  double x[2], y[2];
  REQUIRE(std::sscanf(path_of("was").c_str(), "M%lf %lfL%lf %lf", &x[0], &y[0], &x[1], &y[1]) == 4);
  CHECK(x[0] == x[1]);      // the left column
  CHECK(y[0] > y[1] + 50);  // goes up
  CHECK_THAT(svg, Contains("displacement × 200<"));
}

TEST_CASE("grids of structures from elsewhere: points where nodes are, edges, and pairs that have a node") {
  const a_run r(problem_in("", "frame", {{"dof       = \"8.x\"", "dof = \"8.r\""}}));
  const std::string vtu = vtu_of_frame(r.what, r.kept.frames().back());
  CHECK(why_not_well_formed(vtu).empty());
  CHECK_THAT(vtu, Contains("NumberOfPoints=\"11\" NumberOfCells=\"12\""));
  CHECK_THAT(vtu, Contains("Name=\"rotation\" NumberOfComponents=\"3\""));
  CHECK_THAT(
      vtu,
      Contains("Name=\"direction\" NumberOfComponents=\"1\" format=\"ascii\">\n0 0 0 0 0 0 0 0 0 0 2 6\n"));
  const a_run solid(problem_in("calculix/", "console", {{"dof       = \"49.3\"", "dof = \"55.1\""}}));
  const std::string bricks = vtu_of_frame(solid.what, solid.kept.frames().back());
  CHECK_THAT(bricks, Contains("NumberOfPoints=\"54\" NumberOfCells=\"114\"") && !Contains("rotation"));
}

TEST_CASE("tables of structures from elsewhere name dofs by their labels, with coordinates or without") {
  for (const auto& text : {problem_in("", "frame"), problem_in("", "frame", nowhere)}) {
    const problem p = parse_problem(text, "p.toml");
    const scratch_folder folder;
    output_file increments(folder.at("mesh.csv"));
    output_file pairs(folder.at("mesh.pairs.csv"));
    auto leader = make_kernel("cpp");
    run_csv csv(p, nullptr, increments, &pairs);
    follow(p, structure_of(p), "refactor", *leader, {&csv});
    csv.finish();
    const std::string table = folder.read("mesh.pairs.csv");
    CHECK_THAT(table, Contains("\r\n1,1,1,6.y,below,contact,") && Contains("\r\n3,3,2,8.x,above,separated,"));
  }
}

TEST_CASE("labels that are no plain words stay text in pictures and fields in tables") {
  const scratch_folder folder;
  folder.write("odd.mtx", "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 2\n");
  folder.write("odd.dof", "<b>,\"&.x\n");
  const a_run r("[matrix]\nstiffness = \"" + folder.at("odd.mtx") + "\"\ndofs = \"" + folder.at("odd.dof") +
                "\"\n[[contact]]\ndof = '<b>,\"&.x'\nsurface = "
                "\"below\"\nface = 0\nstiffness = 1\n[[step]]\n"
                "point = [ { dof = '<b>,\"&.x', value = -1 } ]\n");
  CHECK(why_not_well_formed(run_svg(r.finished())).empty());
  CHECK_THAT(run_svg(r.finished()), Contains("&lt;b&gt;,&quot;&amp;.x"));
  CHECK(csv_field(place_name(r.what.geometry, 0)) == "\"<b>,\"\"&.x\"");
}

TEST_CASE("a large mesh is drawn as far as a page stays quick: outer edges first, and it is said") {
  // A chain of springs hangs in a block of 30 x 30 x 12 bricks, whose other nodes have no dof.
  std::string inp = "*NODE\n";
  constexpr int n = 31;
  constexpr int high = 13;
  for (int i = 0; i < n * n * high; ++i)
    inp += fmt::format("{},{},{},{}\n", i + 1, i % n, i / n % n, i / n / n);
  inp += "*ELEMENT,TYPE=C3D8\n";
  for (int k = 0; k + 1 < high; ++k) {
    for (int j = 0; j + 1 < n; ++j) {
      for (int i = 0; i + 1 < n; ++i) {
        const int a = (k * n + j) * n + i + 1;
        const int b = a + n * n;
        inp += fmt::format("{0},{0},{1},{2},{3},{4},{5},{6},{7}\n", a, a + 1, a + n + 1, a + n, b, b + 1,
                           b + n + 1, b + n);
      }
    }
  }
  const scratch_folder folder;
  folder.write("block.inp", inp);
  folder.write("block.sti", "1 1 2\n1 2 -1\n2 2 2\n");
  folder.write("block.dof", "6000.3\n6001.3\n");
  const a_run r("[calculix]\njob = \"" + folder.at("block") +
                "\"\n[[step]]\npoint = [ { dof = \"6000.3\", value = -1 } ]\n");
  const auto& places = std::get<assembled>(r.what.geometry.kind).places;
  REQUIRE(places.edges.size() == 30 * 31 * 13 * 2 + 31 * 31 * 12);
  const shown_parts shown = choose_parts(r.finished());
  CHECK(shown.edges.size() == most_edges);
  const auto elements_of = [&](int i) { return places.edges[static_cast<std::size_t>(i)].elements; };
  const auto outer =
      std::count_if(places.edges.begin(), places.edges.end(), [](const auto& e) { return e.elements < 4; });
  CHECK(std::count_if(shown.edges.begin(), shown.edges.end(), [&](int i) { return elements_of(i) < 4; }) ==
        outer);
  // What is left of the inner ones is from everywhere: in each fifth of them about as many.
  std::array<int, 5> fifths{};
  for (const int i : shown.edges)
    if (elements_of(i) == 4) ++fifths.at(static_cast<std::size_t>(i) * 5 / places.edges.size());
  CHECK(*std::min_element(fifths.begin(), fifths.end()) * 2 >
        *std::max_element(fifths.begin(), fifths.end()));
  REQUIRE(shown.said.size() == 1);
  CHECK_THAT(shown.said[0],
             Contains(fmt::format("20000 of {} edges", places.edges.size())) && Contains("of 12493 nodes"));
  CHECK(std::binary_search(shown.nodes.begin(), shown.nodes.end(), 5999));  // it moves most
  CHECK(page_data(r.finished())["frames"][1]["u"].size() == shown.nodes.size());
}
