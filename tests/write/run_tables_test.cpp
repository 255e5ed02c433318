// The tables of what a run came to: the ends of steps, and the envelope.
#include "contct/write/run_tables.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/pictures.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/page_rows.hpp"

using namespace contct::app;

TEST_CASE("the table of step ends has the largest values, their places and the verdict") {
  const a_run r(propped_cantilever);
  const nlohmann::json data = page_data(r.finished());
  const auto& t = data["ends"][0];
  CHECK(t["head"] == nlohmann::json({"Step", "Share", "w", "Moment", "Shear", "Reaction", "Certificate"}));
  const auto& row = t["rows"][0];
  const load now = load_path(r.what).at(1, 1.0);
  const std::vector<double>& u = r.kept.frames().back().displacement;
  const auto ranges = ranges_of(r.what.geometry, now, u, deflecting_nodes(r.what));
  CHECK(row[1] == 1.0);
  CHECK(row[2] == nlohmann::json({{ranges[0].least.value, "x = 1.15693"}}));
  CHECK(row[3] ==
        nlohmann::json({{ranges[1].least.value, "node 1, x = 0"}, {ranges[1].most.value, "x = 1.25"}}));
  CHECK(row[5][0][1] == "w at node 1");
  CHECK(row[6] == "certified");
  const std::vector<double> reacting = reactions(r.what.geometry, now, r.what.supports, u);
  CHECK(rows_of(data["ends"], "Reactions") ==
        nlohmann::json(
            {{"1", 0.0, "w", reacting[0]}, {"1", 0.0, "theta", reacting[1]}, {"3", 2.0, "w", reacting[2]}}));
}

TEST_CASE("contact forces and reactions of many steps stand in tables of six steps each") {
  std::string text = good_problem;
  for (int i = 0; i < 7; ++i) text += "[[step]]\npoint = [ { node = 3, w = -60.0 } ]\n";
  const a_run r(text);
  const nlohmann::json ends = page_data(r.finished())["ends"];
  REQUIRE(ends.size() == 5);
  CHECK(ends[0]["rows"].size() == 8);
  CHECK(ends[1]["head"].back() == "Step 6");
  CHECK(ends[2]["head"].back() == "Step 8");
  CHECK(ends[2]["rows"][0].size() == 6);
  const frame& last = r.kept.frames().back();
  CHECK(ends[2]["rows"][0][5] == reading_of(r.what, last, 0).force);
}

TEST_CASE("a number that is only rounding beside others of its kind is marked, and kept to its last bit") {
  // Bent to a cylinder: held along two edges, with nothing along y but what rounding leaves.
  const a_run r(
      "[plate]\nx = [0.0, 1.0, 2.0]\ny = [0.0, 1.0]\nD = 3.0\nnu = 0.0\n[[support]]\n"
      "at = [[0.0, 0.0], [0.0, 1.0], [2.0, 0.0], [2.0, 1.0]]\nfix = \"w\"\n[[step]]\npoint = [ { node = 2, w "
      "= -0.7 }, { node = 5, w = -0.7 } ]\n");
  const nlohmann::json ends = page_data(r.finished())["ends"];
  const nlohmann::json& head = ends[0]["head"];
  const std::vector<double>& u = r.kept.frames().back().displacement;
  const auto ranges = ranges_of(r.what.geometry, load_path(r.what).at(1, 1.0), u, deflecting_nodes(r.what));
  int marked = 0;
  for (std::size_t q = 0; q < ranges.size(); ++q) {
    const nlohmann::json& cell = ends[0]["rows"][0][2 + q][0];
    CAPTURE(head[2 + q].get<std::string>(), cell.dump());
    CHECK(cell[0] == ranges[q].largest().value);
    const bool mostly = ranges[q].name == "w" || ranges[q].name == "mx";
    CHECK(cell.size() == (mostly || cell[0] == 0.0 ? 2 : 3));
    marked += cell.size() == 3 ? 1 : 0;
  }
  CHECK(marked > 0);
}

TEST_CASE("the page's envelope is that of all increments, each value with its place, step and increment") {
  a_run r(loaded_and_freed);
  const nlohmann::json data = page_data(r.finished());
  REQUIRE(data["envelope"].size() == 3);
  envelope all(r.what);
  for (const frame& f : r.kept.frames()) all.take(f);
  const nlohmann::json& w = data["envelope"][0]["rows"][0];
  CHECK(w[0] == "w");
  CHECK(w[1][0][0] == all.ranges()[0].least.at.value);
  CHECK(w[1][0][1] == "node 3, x = 2; step 1, increment 2");
  CHECK(w[2][0][0] == all.ranges()[0].most.at.value);
  CHECK(data["envelope"][1]["rows"][0].back()[0][0] == all.pairs()[0].force);
  CHECK(data["envelope"][1]["rows"][0].back()[0][1] == "step 1, increment 2");
  CHECK(data["envelope"][2]["rows"][1].back()[0][0] == all.reactions()[1].most);
}

TEST_CASE("a path of which not all states are kept says whose envelope the page has") {
  const auto omissions_of = [](const finished_run& r) {
    std::string all;
    const nlohmann::json data = page_data(r);
    for (const auto& words : data["thinned"]) all += words.get<std::string>() + "\n";
    return all;
  };
  std::string often = loaded_and_freed;
  for (int i = 0; i < 4; ++i)
    often += "[[step]]\npoint = [ { node = 3, w = -60 } ]\n[[step]]\npoint = [ { node = 3, w = 60 } ]\n";
  const a_run few(often, {}, {.most_frames = 4});
  envelope all(few.what);
  for (const frame& f : few.kept.frames()) all.take(f);
  CHECK_THAT(omissions_of(few.finished()), Catch::Matchers::Contains("The envelope is that of the"));
  finished_run with_all = few.finished();
  with_all.all_increments = &all;
  CHECK_THAT(omissions_of(with_all), !Catch::Matchers::Contains("The envelope is that of the"));
}

TEST_CASE("a quantity that is 0 everywhere has one value in its cell, and one of two signs has two") {
  const a_run r(std::string(propped_cantilever) + "[[step]]\nuniform = 0.0\n");
  const nlohmann::json rows = page_data(r.finished())["ends"][0]["rows"];
  CHECK(rows[0][3].size() == 2);  // the moment under load
  CHECK(rows[1][3].size() == 1);
  CHECK(rows[1][2].size() == 1);
}

TEST_CASE("a path of which a single state is not kept says whose envelope the page has") {
  int of_one_or_two = 0;
  std::string often = loaded_and_freed;
  for (int more = 0; more < 6; ++more) {
    const std::size_t states = a_run(often).kept.frames().size();
    for (std::size_t most = 4; most <= states; ++most) {
      const a_run r(often, {}, {.most_frames = most});
      std::string all;
      const nlohmann::json data = page_data(r.finished());
      for (const auto& words : data["thinned"]) all += words.get<std::string>();
      const std::size_t missing = states - r.kept.frames().size();
      CAPTURE(states, most, missing);
      CHECK((all.find("The envelope is that of the") != std::string::npos) == (missing > 0));
      of_one_or_two += missing == 1 || missing == 2 ? 1 : 0;
    }
    often += "[[step]]\npoint = [ { node = 3, w = -60 } ]\n[[step]]\npoint = [ { node = 3, w = 60 } ]\n";
  }
  CHECK(of_one_or_two >= 1);
}

TEST_CASE("pairs without a force at any end are counted where as many have one as a table has rows") {
  for (const int pressed : {39, 40, 41}) {
    std::string text =
        "[beam]\nlength = 50.0\nelements = 50\nEI = 1e-3\n[[support]]\nnodes = [1, 51]\nfix = [\"w\", "
        "\"theta\"]\n"
        "[[contact]]\nnodes = \"2..50\"\nsurface = \"below\"\nface = 0\nstiffness = 1e3\n"
        "[[step]]\npoint = [";
    for (int node = 2; node < 2 + pressed; ++node)
      text += fmt::format("{}{{ node = {}, w = -1 }}", node == 2 ? "" : ", ", node);
    const a_run r(text + "]\n");
    int with_force = 0;
    const frame& end = r.kept.frames().back();
    for (int i = 0; i < 49; ++i) with_force += reading_of(r.what, end, i).force != 0.0 ? 1 : 0;
    const nlohmann::json data = page_data(r.finished());
    std::string thinned;
    for (const auto& words : data["thinned"]) thinned += words.get<std::string>() + "\n";
    CAPTURE(pressed, with_force, thinned);
    const std::string zeros = fmt::format("{} that are 0 at all of these ends have no row", 49 - with_force);
    CHECK((thinned.find(zeros) != std::string::npos) == (with_force < 49));
  }
}
