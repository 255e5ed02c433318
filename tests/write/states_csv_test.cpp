// Tests the tables of the states at the ends of steps, and of the envelope.
#include <cstdlib>
#include <sstream>

#include "catch.hpp"
#include "contct/session/step_results.hpp"
#include "contct/write/outputs.hpp"
#include "read/bad_plates.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"

using namespace contct;

namespace {

using csv_rows = std::vector<std::vector<std::string>>;

/// Returns the fields of each line; no field may be quoted.
template <class Write>
csv_rows csv_table(const a_run& r, Write write) {
  std::string text;
  output_file out(&text);
  write(r.result, out);
  csv_rows rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    REQUIRE(line.back() == '\r');
    line.back() = ',';
    rows.emplace_back();
    for (std::size_t from = 0, to = 0; (to = line.find(',', from)) != std::string::npos; from = to + 1)
      rows.back().push_back(line.substr(from, to - from));
  }
  return rows;
}

double value_in(const std::string& field) {
  return std::strtod(field.c_str(), nullptr);
}

}  // namespace

TEST_CASE("the table of states has a row inside an element with the extreme moment, 9 q L^2 / 128") {
  const a_run r(propped_cantilever, "corrected");
  const csv_rows rows = csv_table(r, write_states_csv);
  const step_results read = results_of(r.what, r.what.steps[0], r.result.record.steps[0].end);
  const placed_value& most = read.ranges[1].most;
  CHECK(rows[0] == csv_rows::value_type{"step", "name", "element", "node", "x", "w", "slope", "moment",
                                        "shear", "pressure"});
  int found = 0;
  for (const auto& row : rows) {
    if (value_in(row[4]) != most.x) continue;
    CHECK(row[3].empty());
    CHECK(value_in(row[7]) == most.value);
    CHECK(value_in(row[7]) == Approx(9.0 * 8 * 4 / 128).epsilon(1e-12));
    CHECK(value_in(row[8]) == Approx(0.0).margin(1e-12));
    CHECK(value_in(row[4]) == Approx(2 * 5.0 / 8).epsilon(1e-12));
    ++found;
  }
  CHECK(found == 1);
  CHECK(value_in(rows.back()[8]) == Approx(-6.0).epsilon(1e-12));  // 3 q L / 8
}

TEST_CASE("at a node with a point load, the table of states has two rows with the shear on either side") {
  const a_run r(
      "[beam]\nlength = 4\nelements = 2\nEI = 10\n[[support]]\nnodes = [1, 3]\nfix = \"w\"\n[[step]]\nname = "
      "\"load\"\npoint = [ { node = 2, w = -6 } ]\n",
      "corrected");
  const csv_rows rows = csv_table(r, write_states_csv);
  REQUIRE(rows.size() == 5);  // no row inside an element, because the extreme moment is at the node
  CHECK(rows[2] == csv_rows::value_type{"1", "load", "1", "2", "2", rows[2][5], rows[2][6], "6", "3", ""});
  CHECK(rows[3][8] == "-3");
  CHECK(value_in(rows[2][5]) == Approx(-6.0 * 64 / (48 * 10)).epsilon(1e-14));  // P L^3 / 48 EI
  CHECK(value_in(rows[1][6]) == Approx(-6.0 * 16 / (16 * 10)).epsilon(1e-14));  // P L^2 / 16 EI
}

TEST_CASE("at the nodes of a bed, the table of states has the pressure, which is modulus times settlement") {
  const a_run r(
      "[beam]\nlength = 2\nelements = 2\nEI = 1e3\n[[bed]]\nmodulus = 50\nface = 0\n[[step]]\nuniform = "
      "-10\n",
      "corrected");
  const csv_rows rows = csv_table(r, write_states_csv);
  REQUIRE(rows.size() >= 5);
  for (const auto& row : rows)
    if (!row[3].empty() && row[3] != "node")
      CHECK(value_in(row[9]) == Approx(-50 * value_in(row[5])).epsilon(1e-12));
}

TEST_CASE("the table of states of a plate has a row for each node, and that of a matrix a row for each dof") {
  const a_run r(std::string(good_plate), "corrected");
  const csv_rows rows = csv_table(r, write_states_csv);
  REQUIRE(rows.size() == 1 + 6);
  CHECK(rows[0] ==
        csv_rows::value_type{"step", "name", "node", "x", "y", "w", "wx", "wy", "pressure", "von_mises"});
  const std::vector<double>& u = r.result.record.steps[0].end.displacement;
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t dof = 0; dof < 3; ++dof) CHECK(value_in(rows[1 + i][5 + dof]) == u[3 * i + dof]);
  CHECK(rows[6][3] == "1");
  CHECK(rows[6][4] == "1");
  const csv_rows of_frame = csv_table(a_run(portal_frame(), "cpp"), write_states_csv);
  CHECK(of_frame.size() == 1 + 3 * 33);
  CHECK(of_frame[0][2] == "dof");
}

TEST_CASE("if a beam has a section modulus W, each row of the table of states has the stress M / W") {
  const a_run r(
      "[beam]\nlength = 4\nelements = 2\nsection = { E = 10, I = 1, W = 0.5 }\n[[support]]\nnodes = [1, 3]\n"
      "fix = \"w\"\n[[step]]\npoint = [ { node = 2, w = -6 } ]\n",
      "corrected");
  const csv_rows rows = csv_table(r, write_states_csv);
  REQUIRE(rows.size() == 5);
  CHECK(rows[0].back() == "stress");
  CHECK(value_in(rows[2].back()) == Approx(6.0 * 4 / 4 / 0.5).epsilon(1e-14));  // P L / 4 W
  CHECK(value_in(rows[4].back()) == Approx(0.0).margin(1e-13));
}

TEST_CASE("in pure bending, the table of states of a plate has the von Mises stress 6 m / t^2") {
  const a_run r(
      "[plate]\nsize = [2, 1]\nelements = [2, 1]\nnu = 0\nE = 1e7\nthickness = 0.1\n[[support]]\n"
      "nodes = [1, 4]\nfix = [\"w\", \"wx\"]\n[[step]]\n"
      "point = [ { node = 3, wx = 1.5 }, { node = 6, wx = 1.5 } ]\n",
      "corrected");
  const csv_rows rows = csv_table(r, write_states_csv);
  REQUIRE(rows.size() == 1 + 6);
  CHECK(rows[0].back() == "von_mises");
  for (std::size_t node = 1; node <= 6; ++node)
    CHECK(value_in(rows[node].back()) == Approx(6 * 3 / 0.01).epsilon(1e-9));
}

TEST_CASE("the table of an envelope has the least and the largest value of each quantity at each place") {
  const a_run r(loaded_and_freed, "corrected");
  const csv_rows rows = csv_table(r, write_envelope_csv);
  const envelope_curves curves = curves_of(r.result);
  REQUIRE(rows.size() == 1 + curves.x.size());
  CHECK(rows[0][7] == "moment_max");
  for (std::size_t i = 0; i < curves.x.size(); ++i) {
    CHECK(value_in(rows[1 + i][0]) == curves.x[i]);
    CHECK(value_in(rows[1 + i][1]) == curves.curves[0].at[i].least.value);
    CHECK(value_in(rows[1 + i][7]) == curves.curves[1].at[i].most.value);
    CHECK(rows[1 + i][8] == std::to_string(curves.curves[1].at[i].most.step));
  }
}
