// The tables of what was given to a run.
#include "contct/write/input_tables.hpp"

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/pictures.hpp"
#include "support/a_run.hpp"
#include "support/page_rows.hpp"
#include "support/structures.hpp"

using namespace contct::app;

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
  for (const auto& t : input)
    if (t["title"] == "Beds")
      CHECK(t["head"].back() == "Modulus [kN/m²]");  // force per length and deflection
  CHECK(rows_of(input, "Loads") ==
        nlohmann::json({{"1, dead load", "per length [kN/m]", "all elements", -0.01},
                        {"1, dead load", "settlement w [m]", "node 1, x = 0", -0.25}}));
  CHECK(data["units"]["moment"] == "kN m");
  CHECK(data["ends"][0]["rows"][0][0] == "1, dead load");
}

TEST_CASE("of a structure given by its matrix the page has the file and the number of dofs") {
  const a_run r(portal_frame());
  const nlohmann::json data = page_data(r.finished());
  const auto& a = std::get<assembled>(r.what.geometry.kind);
  CHECK(rows_of(data["input"], "Structure from a matrix") ==
        nlohmann::json::array({nlohmann::json::array({"Stiffness matrix", a.name}),
                               nlohmann::json::array({"Dofs", a.dofs()})}));
}
