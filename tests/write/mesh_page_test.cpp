// The page of a structure from elsewhere: its mesh where coordinates are known.
#include "contct/write/mesh_page.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/run_page.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

std::vector<double> whole_of(const nlohmann::json& list) {
  return list.get<std::vector<double>>();
}

}  // namespace

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
  CHECK(g["edges"].size() == 2 * 111);
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
