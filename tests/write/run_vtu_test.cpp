// Tests grids for ParaView. tests/app/break_out.py tests that the grids are XML, and tests/vtk that VTK reads
// the grids.
#include <fmt/format.h>

#include <algorithm>

#include "catch.hpp"
#include "contct/session/step_results.hpp"
#include "contct/write/outputs.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"

using namespace contct;
using Catch::Matchers::Contains;

TEST_CASE("a VTU grid has a point for each node, and a cell for each element and each pair") {
  for (const std::string& text : {loaded_and_freed, std::string(good_plate)}) {
    const a_run r(text);
    const std::string vtu = vtu_of_state(r.what, pictures_of(r.result).back());
    const auto cells = static_cast<std::size_t>(elements(r.what.geometry)) + r.what.pairs.size();
    CHECK_THAT(vtu, Contains("NumberOfPoints=\"" + std::to_string(nodes(r.what.geometry)) +
                             "\" NumberOfCells=\"" + std::to_string(cells) + "\""));
  }
}

TEST_CASE("the collection of VTU files lists the files in order, by names relative to the collection") {
  const std::string pvd = pvd_of_states("a&b", 11);
  CHECK_THAT(pvd, Contains("timestep=\"0\" part=\"0\" file=\"a&amp;b.000.vtu\""));
  CHECK_THAT(pvd, Contains("timestep=\"10\" part=\"0\" file=\"a&amp;b.010.vtu\""));
}

TEST_CASE(
    "the VTU grid of a matrix has points at nodes, and a cell for each edge and for each pair at a known "
    "node") {
  const a_run r(structure_problem("", "frame", {{"dof       = \"8.x\"", "dof = \"8.r\""}}));
  const std::string vtu = vtu_of_state(r.what, pictures_of(r.result).back());
  CHECK_THAT(vtu, Contains("NumberOfPoints=\"11\" NumberOfCells=\"12\""));
  CHECK_THAT(vtu, Contains("Name=\"rotation\" NumberOfComponents=\"3\""));
  CHECK_THAT(
      vtu,
      Contains("Name=\"direction\" NumberOfComponents=\"1\" format=\"ascii\">\n0 0 0 0 0 0 0 0 0 0 2 6\n"));
  const a_run solid(structure_problem("calculix/", "console", {{"dof       = \"49.3\"", "dof = \"55.1\""}}));
  const std::string bricks = vtu_of_state(solid.what, pictures_of(solid.result).back());
  CHECK_THAT(bricks, Contains("NumberOfPoints=\"54\" NumberOfCells=\"114\"") && !Contains("rotation"));
}

TEST_CASE("the points of a VTU grid have the reactions of supports and the pressure of a bed") {
  problem p = parse_problem(good_problem, "pb.toml");
  p.beds = {{4.0, {0.5}, 0}};
  const a_run r(p);
  const structure_state s = pictures_of(r.result).back();
  const std::string vtu = vtu_of_state(r.what, s);
  const std::vector<double> at = reactions(r.what.geometry, r.what.steps[0], r.what.supports, s.displacement);
  CHECK_THAT(vtu, Contains(fmt::format(
                      "Name=\"reaction\" NumberOfComponents=\"2\" format=\"ascii\">\n{} {} 0 0 0 0\n", at[0],
                      at[1])));
  CHECK_THAT(vtu,
             Contains(fmt::format("Name=\"pressure\" NumberOfComponents=\"1\" format=\"ascii\">\n0 0 {}\n",
                                  results_of(r.what, r.what.steps[0], s).pairs[0].force / 0.5)));
}

TEST_CASE("of several states at the very start of a load, only one is drawn") {
  // Each end of a beam on springs separates at the start of the load.
  const a_run r(
      "[beam]\nlength = 10.0\nelements = 40\nEI = 1.0\n[[contact]]\nnodes = \"all\"\nsurface = \"below\"\n"
      "face = 0\nstiffness = 1e3\n[[step]]\npoint = [ { node = 21, w = -1.0 } ]\n");
  const auto begun = [](const auto& states) {
    return std::ranges::count_if(states,
                                 [](const auto& s) { return s.number > 0 && s.fraction <= first_load; });
  };
  CHECK(begun(r.result.record.steps[0].increments) > 3);
  CHECK(begun(pictures_of(r.result)) == 1);
}
