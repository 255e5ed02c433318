// Tables of a page: what they leave out is said, and headings have units.
#include "contct/write/page_table.hpp"

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "contct/write/pictures.hpp"
#include "contct/write/step_results.hpp"
#include "support/a_run.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

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

TEST_CASE("a unit goes with the powers of force and length") {
  const unit_labels u{"m", "kN"};
  CHECK(unit_words(u, 1, 2) == "kN m²");
  CHECK(unit_words(u, 1, -3) == "kN/m³");
  CHECK(unit_words(u, 1, 0) == "kN");
  CHECK(unit_words(u, 0, 1) == "m");
  CHECK(unit_words({}, 1, 1).empty());
}
