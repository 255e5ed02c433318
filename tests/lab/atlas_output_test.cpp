// The atlas as table, CSV, JSON and picture: the same numbers everywhere.
#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "catch.hpp"
#include "contct/lab/atlas.hpp"
#include "support/well_formed.hpp"

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

int count_of(const std::string& text, const std::string& what) {
  int count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++count;
  return count;
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

TEST_CASE("the atlas's picture is well-formed, self-contained, and has every cell as a point") {
  const atlas a = made_up();
  const std::string svg = atlas_svg(a);
  CHECK(why_not_well_formed(svg).empty());
  CHECK(count_of(svg, "class=\"point\"") == static_cast<int>(a.cells.size()) + 4);
  CHECK_THAT(svg, !Contains("href") && !Contains("<script") && !Contains("<image") && !Contains("nan"));
  CHECK_THAT(svg, Contains("<rect width=\"980\" height=\"800\" fill=\"#ffffff\"/>"));  // a ground of its own
  for (const atlas_cell& c : a.cells) {
    char unit[16];
    (void)std::snprintf(unit, sizeof unit, "%.0e", c.unit);
    char wrong[64];
    (void)std::snprintf(wrong, sizeof wrong, "%.1f %% wrong (%.1f to %.1f %%) of 800", c.wrong / 8.0,
                        100 * wilson(c.wrong, 800).least, 100 * wilson(c.wrong, 800).most);
    char epsmul[40] = "";
    if (c.has_other_epsmul()) (void)std::snprintf(epsmul, sizeof epsmul, " with EPSMUL %.0e", c.epsmul);
    CHECK_THAT(svg, Contains("<title>" + c.kernel + epsmul + ", unit " + unit +
                             (c.held ? ", held: " : ", free: ") + wrong + "</title>"));
  }
  for (const char* colour : {"#0072B2", "#D55E00", "#007F5F"}) CHECK_THAT(svg, Contains(colour));
  CHECK_THAT(svg, Contains("fortran-r4: as printed") && Contains("corrected: the corrected rule"));
}

TEST_CASE("a point stands where its share is: more wrong is higher, none is lowest") {
  const auto height_at_unit_1 = [](int wrong) {
    atlas a = made_up();
    for (atlas_cell& c : a.cells) c.wrong = c.kernel == "fortran" ? wrong : 0;
    const std::string svg = atlas_svg(a);
    const std::size_t title = svg.find("<title>fortran, unit 1e+00, held");
    const std::size_t at = svg.rfind("cy=\"", title);
    REQUIRE(title != std::string::npos);
    REQUIRE(at != std::string::npos);
    return std::stod(svg.substr(at + 4));
  };
  const double all = height_at_unit_1(800);
  const double tenth = height_at_unit_1(80);
  const double hundredth = height_at_unit_1(8);
  const double none = height_at_unit_1(0);
  CHECK(all < tenth);
  CHECK(tenth < hundredth);
  CHECK(hundredth < none);
  CHECK(std::abs((tenth - all) - (hundredth - tenth)) < 0.2);  // by decades
}

TEST_CASE("the judge of well-formed XML finds what is wrong") {
  CHECK(why_not_well_formed("<?xml version=\"1.0\"?>\n<a b=\"c\"><d/>e &amp; f</a>\n").empty());
  CHECK_THAT(why_not_well_formed("<a><b></a></b>"), Contains("</a>"));
  CHECK_THAT(why_not_well_formed("<a><b/>"), Contains("never closed"));
  CHECK_THAT(why_not_well_formed("<a b=c/>"), Contains("quote"));
  CHECK_THAT(why_not_well_formed("<a b=\"1\" b=\"2\"/>"), Contains("twice"));
  CHECK_THAT(why_not_well_formed("<a>x & y</a>"), Contains("&"));
  CHECK_THAT(why_not_well_formed("<a>x < y</a>"), Contains("<"));
  CHECK_THAT(why_not_well_formed("<a/><b/>"), Contains("second"));
  CHECK_THAT(why_not_well_formed(""), Contains("no element"));
}
