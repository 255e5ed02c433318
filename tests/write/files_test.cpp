// Tests CSV tables, the report page, and grids for ParaView. tests/app/break_out.py tests that texts of a
// problem keep the formats valid, and tests/vtk that VTK reads the grids.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <tuple>

#include "catch.hpp"
#include "contct/results/envelope.hpp"
#include "contct/results/step_results.hpp"
#include "contct/text/input_text.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/words.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/json_parts.hpp"
#include "support/structures.hpp"
#include "support/words.hpp"

using namespace contct;
using row = std::vector<std::string>;

namespace {

/// Returns the fields of each line; only the last field of a line may be quoted.
std::vector<row> rows_of(const std::string& text) {
  std::vector<row> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    REQUIRE(line.back() == '\r');
    line.back() = ',';
    row& fields = rows.emplace_back();
    for (std::size_t from = 0, to = 0; from < line.size(); from = to + 1) {
      to = line[from] == '"' ? line.size() - 1 : line.find(',', from);
      fields.push_back(line.substr(from, to - from));
    }
  }
  return rows;
}

/// Returns the rows that `write` writes.
template <class Write>
std::vector<row> rows_by(Write write, const a_run& r) {
  std::string text;
  output_file out(&text);
  write(r.result, out);
  return rows_of(text);
}

std::vector<row> states_of(const std::string& text) {
  return rows_by(write_states_csv, a_run(text, "corrected"));
}

struct tables {
  std::vector<row> increments, pairs;
  std::vector<structure_state> states;  // expected states
};

/// Returns the tables, with the deflection of the second node.
tables tables_of(const a_run& r) {
  std::string pairs;
  output_file of_pairs(&pairs);
  const auto write = [&](const run_result& result, output_file& to) { write_csv(result, 1, to, &of_pairs); };
  const std::vector<row> increments = rows_by(write, r);
  return {increments, rows_of(pairs), pictures_of(r.result)};
}

double number(const std::string& field) {
  return std::strtod(field.c_str(), nullptr);
}

/// Returns the grid of the last state of a path.
std::string grid_of(const a_run& r) {
  return vtu_of_state(r.what, pictures_of(r.result).back());
}

}  // namespace

TEST_CASE("a CSV field is quoted for a comma, a quote or a line end, and never begins like a formula") {
  for (const std::string plain : {"plain words", "", "185.3", "1-2", "a=b", "x+", "'=1"})
    CHECK(csv_field(plain) == plain);
  for (const auto& [text, field] : {std::pair("a,b", "\"a,b\""),
                                    {"say \"no\"", "\"say \"\"no\"\"\""},
                                    {"two\nlines", "\"two\nlines\""},
                                    {"a\x1b[31m", "a\\x1b[31m"}})
    CHECK(csv_field(text) == field);
  for (const std::string formula : {"=1+1", "+1", "-2.x", "@SUM(1)", "\t=1", "\r=1", " =1", "\n=1", "\uff1d1",
                                    "\uff0b1", "\uff0d1", "\uff20x"}) {
    const std::string field = csv_field(formula);
    INFO(field);
    CHECK((field.starts_with("'") || field.starts_with("\"'")));
  }
}

TEST_CASE("if a path is lost before any call, the CSV table has the state of the reference solution") {
  // The stiffness of the slope at the corner is 0 in doubles.
  const a_run r(
      "[plate]\nsize = [2, 2]\nelements = [2, 2]\nnu = 0\nD = 1\n[[support]]\nnode = 8\nspring = { wy = 1 }\n"
      "[[contact]]\nnode = 9\nsurface = 'below'\nface = -1\nstiffness = 1\n"
      "[[step]]\npoint = [ { node = 9, wy = 0.84375 } ]\n",
      "corrected");
  CHECK(r.result.end.status == path_status::solved);
  const tables t = tables_of(r);
  REQUIRE(t.increments.size() == 2);
  CHECK(t.increments[1][10].empty());  // smin
  CHECK(t.increments[1][2] == "reference");
  CHECK(t.pairs.size() == 2);
}

TEST_CASE("the CSV table of increments has the numbers of the states to the last digit, and the events") {
  const tables t = tables_of(a_run(loaded_and_freed));
  // The table has a heading row, and the states include the start.
  REQUIRE(t.increments.size() == t.states.size());
  CHECK(t.increments[0] == row{"step", "increment", "kind", "s", "share", "force", "events", "closed", "open",
                               "at_face", "smin", "kernels", "node", "w", "name"});
  for (std::size_t i = 1; i < t.increments.size(); ++i) {
    const row& r = t.increments[i];
    const structure_state& s = t.states[i];
    INFO("row " << i);
    REQUIRE(r.size() == 15);
    CHECK(row{r[0], r[1], r[11], r[12]} ==
          row{std::to_string(s.step), std::to_string(s.number), "equal", "2"});
    CHECK(number(r[3]) == number(r[10]));
    CHECK(number(r[4]) == s.fraction);
    CHECK(number(r[13]) == s.displacement[2]);
  }
  CHECK(t.increments[1][6] == "make 1");
  CHECK(number(t.increments[2][5]) == -60.0);
}

TEST_CASE("the CSV table of pairs has a row for each pair in each increment, with the state's numbers") {
  const tables t = tables_of(a_run(loaded_and_freed));
  REQUIRE(t.pairs.size() == 1 + 2 * (t.states.size() - 1));
  bool pressed = false;
  for (std::size_t i = 1; i < t.pairs.size(); ++i) {
    const row& r = t.pairs[i];
    const structure_state& f = t.states[(i + 1) / 2];
    const std::size_t pair = (i + 1) % 2;
    INFO("row " << i);
    REQUIRE(r.size() == 15);
    CHECK(r[2] == std::to_string(pair + 1));
    CHECK(r[5] == (f.closed(pair) ? "contact" : "separated"));
    // Within a step the table has D of the path, which equals the separately solved state.
    CHECK(number(r[7]) == Approx(f.displacement[pair == 0 ? 4 : 2]).margin(1e-14));
    pressed = pressed || number(r[9]) > 10;
  }
  CHECK(pressed);
}

TEST_CASE("a step without movement has a row with its name in the CSV table of increments") {
  const tables t =
      tables_of(a_run(with("fix = [\"w\", \"theta\"]", "fix = [\"w\"]") + "name = 'dead, live'\n"));
  REQUIRE(t.increments.size() == 2);
  CHECK(row{t.increments[1][2], t.increments[1][3], t.increments[1][11], t.increments[1].back()} ==
        row{"end", "", "", "\"dead, live\""});
}

TEST_CASE("the CSV table of pairs of a matrix names dofs by labels, with or without coordinates") {
  for (const auto& text : {portal_frame(), frame_without_coordinates()}) {
    const std::vector<row> pairs = tables_of(a_run(text, "cpp")).pairs;
    CHECK(row(pairs[1].begin(), pairs[1].begin() + 6) == row{"1", "1", "1", "6.y", "below", "contact"});
    CHECK(std::ranges::count_if(pairs, [](const row& r) {
            return row(r.begin(), r.begin() + 6) == row{"3", "3", "2", "8.x", "above", "separated"};
          }) == 1);
  }
}

TEST_CASE("the printed table and CSV have the same statuses and counts of pairs, however a step ends") {
  const std::string one_pair =
      "[beam]\nlength = 1\nelements = 1\nEI = 1\n[[support]]\nnode = 1\nfix = 'w'\n[[contact]]\nnode = 2\n"
      "surface = 'below'\nface = 0\nstiffness = 10\n[[step]]\npoint = [ { node = 2, w = -1 } ]\n";
  const std::string two_pairs =
      "[beam]\nx = [0, 1, 2]\nEI = 100\n[[contact]]\nnodes = [1, 3]\nsurface = 'below'\nface = 0\n"
      "stiffness = 10\n[[step]]\nuniform = -1\n[[step]]\npoint = [ { node = 3, w = 1 } ]\n";
  for (const auto& [text, count] : {std::pair<std::string, std::string>(one_pair, "1 of 1"),
                                    {one_pair + "[[step]]\npoint = [ { node = 2, w = 1 } ]\n", "0 of 1"},
                                    {two_pairs, "1 of 2"},
                                    {loaded_and_freed, "1 of 2"}}) {
    for (const std::string leads : {"fortran", "corrected"}) {
      const a_run r(text, leads);
      CAPTURE(text, leads);
      const std::string printed = table_of(r.result, {100, false}, false).text;
      CHECK(printed.substr(printed.rfind("   end  ") + 8, count.size()) == count);
      const tables t = tables_of(r);
      const auto pairs = static_cast<std::ptrdiff_t>(r.what.pairs.size());
      const auto in_csv = std::count_if(t.pairs.end() - pairs, t.pairs.end(),
                                        [](const row& of) { return of[5] == "contact"; });
      CHECK(fmt::format("{} of {}", in_csv, pairs) == count);
      CHECK(fmt::format("{} of {}", r.result.record.steps.back().pairs_in_contact(), pairs) == count);
    }
  }
}

TEST_CASE("the table of states has a row inside an element with the extreme moment, 9 q L^2 / 128") {
  const a_run r(propped_cantilever, "corrected");
  const std::vector<row> rows = rows_by(write_states_csv, r);
  const placed_value most = r.results().ranges()[1].most;
  CHECK(rows[0] == row{"step", "name", "element", "node", "x", "w", "slope", "moment", "shear", "pressure"});
  int found = 0;
  for (const auto& at : rows) {
    if (number(at[4]) != most.x) continue;
    CHECK(at[3].empty());
    CHECK(number(at[7]) == most.value);
    CHECK(number(at[7]) == Approx(9.0 * 8 * 4 / 128).epsilon(1e-12));
    CHECK(number(at[8]) == Approx(0.0).margin(1e-12));
    CHECK(number(at[4]) == Approx(2 * 5.0 / 8).epsilon(1e-12));
    ++found;
  }
  CHECK(found == 1);
  CHECK(number(rows.back()[8]) == Approx(-6.0).epsilon(1e-12));  // 3 q L / 8
}

TEST_CASE("at a point load, the table of states has the shear on either side, and stresses M / W") {
  for (const std::string stiffness : {"EI = 10", "section = { E = 10, I = 1, W = 0.5 }"}) {
    const std::vector<row> rows = states_of("[beam]\nlength = 4\nelements = 2\n" + stiffness +
                                            "\n[[support]]\nnodes = [1, 3]\nfix = 'w'\n"
                                            "[[step]]\nname = 'load'\npoint = [ { node = 2, w = -6 } ]\n");
    REQUIRE(rows.size() == 5);  // no row inside an element, because the extreme moment is at the node
    const row expected{"1", "load", "1", "2", "2", rows[2][5], rows[2][6], "6", "3", ""};
    CHECK(row(rows[2].begin(), rows[2].begin() + 10) == expected);
    CHECK(rows[3][8] == "-3");
    CHECK(number(rows[2][5]) == Approx(-6.0 * 64 / (48 * 10)).epsilon(1e-14));  // P L^3 / 48 EI
    CHECK(number(rows[1][6]) == Approx(-6.0 * 16 / (16 * 10)).epsilon(1e-14));  // P L^2 / 16 EI
    CHECK((rows[0].back() == "stress") == (stiffness != "EI = 10"));
    if (rows[0].back() != "stress") continue;
    CHECK(number(rows[2].back()) == Approx(6.0 * 4 / 4 / 0.5).epsilon(1e-14));  // P L / 4 W
    CHECK(number(rows[4].back()) == Approx(0.0).margin(1e-13));
  }
}

TEST_CASE("in pure bending, the table of states of a plate has the von Mises stress 6 m / t^2") {
  const std::vector<row> rows = states_of(
      "[plate]\nsize = [2, 1]\nelements = [2, 1]\nnu = 0\nE = 1e7\nthickness = 0.1\n[[support]]\n"
      "nodes = [1, 4]\nfix = ['w', 'wx']\n[[step]]\npoint = [ { nodes = [3, 6], wx = 1.5 } ]\n");
  REQUIRE(rows.size() == 1 + 6);
  for (std::size_t node = 1; node <= 6; ++node)
    CHECK(number(rows[node].back()) == Approx(6 * 3 / 0.01).epsilon(1e-9));
}

TEST_CASE("the table of an envelope has the least and the largest value of each quantity at each place") {
  const a_run r(loaded_and_freed, "corrected");
  const std::vector<row> rows = rows_by(write_envelope_csv, r);
  const envelope curves = envelope_of(r.result, true);
  REQUIRE(rows.size() == 1 + curves.x.size());
  CHECK(rows[0][7] == "moment_max");
  for (std::size_t i = 0; i < curves.x.size(); ++i) {
    const row& at = rows[1 + i];
    CHECK(std::tuple(number(at[0]), number(at[1]), number(at[7]), at[8]) ==
          std::tuple(curves.x[i], curves.curves[0].at[i].least.value, curves.curves[1].at[i].most.value,
                     std::to_string(curves.curves[1].at[i].most.step)));
  }
}

TEST_CASE("the report page refers to no other file or address, and contains the parallel edition") {
  const std::string page = run_page(a_run(good_problem).result);
  for (const char* way : {"src=", "@import", "fetch(", "<link", "<img", "XMLHttp", "url("}) {
    INFO(way);
    CHECK(count(page, way) == 0);
  }
  CHECK(count(page, "http://") == count(page, "http://www.w3.org/2000/svg"));
  check_words(page, {"default-src 'none'"});
  const std::string whole = read_input(CONTCT_REFERENCE "/parallel-edition.html");
  const std::string edition =
      whole.substr(whole.find("<section"), whole.find("</body>") - whole.find("<section"));
  REQUIRE(count(edition, "<pre>") >= 20);
  CHECK(count(page, "<!DOCTYPE") == 1);
  CHECK(count(page, "<title>") == 1);
  check_words(page, {edition, "<details id=\"edition\">"});
}

TEST_CASE("a VTU grid has points for nodes and cells for elements and pairs, and a collection lists grids") {
  for (const std::string& text : {loaded_and_freed, std::string(good_plate)}) {
    const a_run r(text);
    const auto cells = static_cast<std::size_t>(elements(r.what.geometry)) + r.what.pairs.size();
    check_words(grid_of(r),
                {fmt::format("NumberOfPoints=\"{}\" NumberOfCells=\"{}\"", nodes(r.what.geometry), cells)});
  }
  // Names are relative to the collection.
  check_words(pvd_of_states("a&b", 11), {"timestep=\"0\" part=\"0\" file=\"a&amp;b.000.vtu\"",
                                         "timestep=\"10\" part=\"0\" file=\"a&amp;b.010.vtu\""});
}

TEST_CASE("the VTU grid of a matrix has points at nodes, and cells for edges and pairs at known nodes") {
  check_words(grid_of(a_run(structure_problem("", "frame", {{"dof       = \"8.x\"", "dof = \"8.r\""}}))),
              {"NumberOfPoints=\"11\" NumberOfCells=\"12\"", "Name=\"rotation\" NumberOfComponents=\"3\"",
               "Name=\"direction\" NumberOfComponents=\"1\" format=\"ascii\">\n0 0 0 0 0 0 0 0 0 0 2 6\n"});
  check_words(
      grid_of(a_run(structure_problem("calculix/", "console", {{"dof       = \"49.3\"", "dof = \"55.1\""}}))),
      {"NumberOfPoints=\"54\" NumberOfCells=\"114\"", "!rotation"});
}

TEST_CASE("of several states at the very start of a load, only one is drawn") {
  // Each end of a beam on springs separates at the start of the load.
  const a_run r(lying_beam(40));
  const auto begun = [](const auto& states) {
    return std::ranges::count_if(states,
                                 [](const auto& s) { return s.number > 0 && s.fraction <= first_load; });
  };
  CHECK(begun(r.result.record.steps[0].increments) > 3);
  CHECK(begun(pictures_of(r.result)) == 1);
}
