// The atlas as table, CSV and JSON: the same numbers everywhere.
#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "catch.hpp"
#include "contct/lab/atlas.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// All cells with counts made up, no two cells of a line alike; corrected ones with none wrong.
atlas made_up() {
  atlas a{{800, 5}, atlas_cells()};
  int number = 0;
  for (atlas_cell& c : a.cells) {
    ++number;
    c.problems = 800;
    c.wrong = c.kernel == "corrected" ? 0 : number;
    c.uncertified = c.wrong + number % 7;
    c.false_equilibrium = c.wrong / 3;
    c.false_mechanism = c.held ? 0 : number % 11;
    c.never_held = c.false_mechanism / 2;
    c.no_end = number % 3;
    for (int i = 0; i < c.wrong; ++i) c.errors.push_back(1e-3 * (i + number));
  }
  return a;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  if (!text.empty() && text.back() == at && at != '\n') parts.emplace_back();
  return parts;
}

}  // namespace

TEST_CASE("the atlas in JSON has every cell with its counts, its interval and its errors") {
  const atlas a = made_up();
  const auto read = nlohmann::json::parse(atlas_json(a));
  CHECK(read["format"] == "contct-atlas-1");
  CHECK(read["problems"] == 800);
  CHECK(read["seed"] == 5);
  CHECK(read["wrong_beyond"] == 1e-3);
  REQUIRE(read["cells"].size() == a.cells.size());
  for (std::size_t i = 0; i < a.cells.size(); ++i) {
    const atlas_cell& c = a.cells[i];
    const auto& cell = read["cells"][i];
    INFO(cell);
    CHECK(cell["structures"] == (c.held ? "held" : "free"));
    CHECK(cell["kernel"] == c.kernel);
    CHECK(cell["unit"] == c.unit);
    CHECK((c.kernel == "corrected" ? cell["epsmul"].is_null() : cell["epsmul"] == c.epsmul));
    CHECK(cell["problems"] == 800);
    CHECK(cell["wrong"] == c.wrong);
    CHECK(cell["wrong_least"] == wilson(c.wrong, 800).least);
    CHECK(cell["wrong_most"] == wilson(c.wrong, 800).most);
    CHECK((c.wrong == 0 ? cell["median_error"].is_null() : cell["median_error"] == c.median_error()));
    CHECK((c.wrong == 0 ? cell["worst_error"].is_null() : cell["worst_error"] == c.worst_error()));
    CHECK(cell["false_equilibrium"] == c.false_equilibrium);
    CHECK(cell["false_mechanism"] == c.false_mechanism);
    CHECK(cell["never_held"] == c.never_held);
    CHECK(cell["no_end"] == c.no_end);
    CHECK(cell["uncertified"] == c.uncertified);
  }
}

TEST_CASE("the atlas in CSV has the same numbers as in JSON, under the same names") {
  const atlas a = made_up();
  const auto cells = nlohmann::json::parse(atlas_json(a))["cells"];
  const std::vector<std::string> lines = split(atlas_csv(a), '\n');
  REQUIRE(lines.size() == cells.size() + 1);
  const std::vector<std::string> names = split(lines[0], ',');
  CHECK(names.size() == cells[0].size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::vector<std::string> values = split(lines[i + 1], ',');
    REQUIRE(values.size() == names.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      const auto& expected = cells[i].at(names[k]);
      INFO(names[k] << " in line " << i + 2);
      if (expected.is_string()) {
        CHECK(values[k] == expected.get<std::string>());
      } else {
        CHECK((values[k].empty() ? nlohmann::json() : nlohmann::json::parse(values[k])) == expected);
      }
    }
  }
}

TEST_CASE("the atlas's table has a row a cell with its share and interval, in 80 columns") {
  const atlas a = made_up();
  const std::string table = atlas_table(a, {80, false});
  for (const std::string& line : split(table, '\n')) CHECK(line.size() <= 80);
  CHECK_THAT(table, Contains("800 random problems a cell, seed 5"));
  // 25 of 800: 3.1 %, by Wilson from 2.1 to 4.6; errors from 0.025, 25 of them.
  REQUIRE(a.cells[24].wrong == 25);
  CHECK_THAT(table,
             Contains("\n1e4    fortran      800   3.1    2.1-4.6 3.7e-02 4.9e-02    0.0    0.1    3.6\n"));
  // The last one: 106 of 800.
  CHECK_THAT(table,
             Contains("\n1e-12  unit 100     800  13.2  11.1-15.8 1.6e-01 2.1e-01    0.9    0.1   13.4\n"));
  int rows = 0;
  for (const std::string& line : split(table, '\n')) rows += line.find("  800 ") != std::string::npos ? 1 : 0;
  CHECK(rows == static_cast<int>(a.cells.size()) + 4);  // the printed EPSMUL stands in both kinds of table
  CHECK_THAT(table, Contains("1e-3") && Contains("certificate"));  // both yardsticks are told
}
