// The tables of a run's page: the input, and the ends of steps.
#include "contct/write/run_tables.hpp"

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/pictures.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// The rows of the first table whose title begins so.
nlohmann::json rows_of(const nlohmann::json& tables, const std::string& title) {
  for (const auto& t : tables)
    if (t["title"].get<std::string>().starts_with(title)) return t["rows"];
  return nullptr;
}

}  // namespace

TEST_CASE("the input is on the page: stiffness by pieces, supports, pairs, beds and loads with their names") {
  a_run r(
      "[beam]\nlength = 4.0\nelements = 4\nEI = [1.0, 1.0, 2.0, 2.0]\n[[support]]\nnode = 1\nfix = [\"w\", "
      "\"theta\"]\n"
      "[[support]]\nnodes = \"2..4\"\nspring = { w = 0.5 }\n"
      "[[contact]]\nnode = 5\nsurface = \"below\"\nface = -0.1\nstiffness = 7.0\n"
      "[[bed]]\nmodulus = 3.0\nface = -0.2\n[[step]]\nuniform = -0.01\n");
  r.what.units = {"m", "kN"};
  r.what.beds = {{3.0, {1.0, 1.0, 1.0, 0.5}, 1}};  // none where w is fixed
  r.what.steps[0].name = "dead load";
  r.what.steps[0].settlements = {{0, 0, -0.25}};
  const nlohmann::json data = page_data(r.finished());
  const auto& input = data["input"];
  CHECK(rows_of(input, "Beam") ==
        nlohmann::json({{"1..2", 0.0, 2.0, 1.0, 1.0}, {"3..4", 2.0, 4.0, 2.0, 1.0}}));
  CHECK(input[0]["head"][3] == "EI [kN m²]");
  CHECK(rows_of(input, "Supports") ==
        nlohmann::json({{"1", 0.0, "fixed", "fixed"}, {"2..4", "1 to 3", 0.5, nullptr}}));
  CHECK(rows_of(input, "Candidate pairs") ==
        nlohmann::json({{"1", "5", 4.0, "below", -0.1, 7.0, "separated"}}));
  CHECK(rows_of(input, "Beds") == nlohmann::json({{"2..5", 4, "1 to 4", "below", -0.2, 3.0}}));
  CHECK(rows_of(input, "Loads") ==
        nlohmann::json({{"1, dead load", "per length [kN/m]", "all elements", -0.01},
                        {"1, dead load", "settlement w [m]", "node 1, x = 0", -0.25}}));
  CHECK(data["units"]["moment"] == "kN m");
  CHECK(data["ends"][0]["rows"][0][0] == "1, dead load");
}

TEST_CASE("long tables have their first rows, say of how many, and are among what the page leaves out") {
  std::string text =
      "[beam]\nlength = 60.0\nelements = 60\nEI = 1.0\n[[contact]]\nnodes = \"all\"\nsurface = "
      "\"below\"\nface = 0.0\nstiffness = 3.0\n[[step]]\nuniform = -0.01\n";
  const a_run r(text);
  const nlohmann::json data = page_data(r.finished());
  CHECK(data["input"][1]["title"] == "Candidate pairs (first 40 of 61)");
  CHECK(data["input"][1]["rows"].size() == 40);
  const std::string said = data["thinned"].dump();
  CHECK_THAT(said, Contains("Candidate pairs: the table has the first 40 of 61 rows.") &&
                       Contains("Contact forces: the table has the largest 40 of 61 rows.") &&
                       Contains("Of 61 pairs' s in each call the first 8 are listed."));
}

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

TEST_CASE("a unit goes with the powers of force and length") {
  const unit_labels u{"m", "kN"};
  CHECK(unit_words(u, 1, 2) == "kN m²");
  CHECK(unit_words(u, 1, -3) == "kN/m³");
  CHECK(unit_words(u, 1, 0) == "kN");
  CHECK(unit_words(u, 0, 1) == "m");
  CHECK(unit_words({}, 1, 1).empty());
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
    for (const auto& words : page_data(r)["thinned"]) all += words.get<std::string>() + "\n";
    return all;
  };
  std::string often = loaded_and_freed;
  for (int i = 0; i < 4; ++i)
    often += "[[step]]\npoint = [ { node = 3, w = -60 } ]\n[[step]]\npoint = [ { node = 3, w = 60 } ]\n";
  const a_run few(often, {}, {.most_frames = 4});
  envelope all(few.what);
  for (const frame& f : few.kept.frames()) all.take(f);
  finished_run with_all = few.finished();
  with_all.all_increments = &all;
  CHECK_THAT(omissions_of(with_all), !Catch::Matchers::Contains("The envelope is that of the"));
}
