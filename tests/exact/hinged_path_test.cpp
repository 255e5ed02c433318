// Tests beams with hinges and sections in exact arithmetic.
#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/model/elements.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;
using contct::parse_problem;

namespace {

exact_path path_of(const contct::problem& p) {
  return follow_corrected_path(exact_problem_of(p));
}

}  // namespace

TEST_CASE("A two-span Gerber beam has no moment at the hinge, and the exact reactions 20, 80 and 20") {
  const contct::problem p = parse_problem(
      "[beam]\nlength = 12.0\nelement_size = 2.0\nsection = { E = 2.1e8, I = 2.517e-4 }\n[[hinge]]\nx = 8.0\n"
      "[[support]]\nx = [0.0, 6.0, 12.0]\nfix = \"w\"\n[[step]]\nuniform = -10.0\n",
      "gerber.toml");
  const exact_step_end end = path_of(p).steps.at(0);
  CHECK(end.reactions == rational_vector{20, 80, 20});
  const auto forces =
      elements_of<rational>(std::get<beam>(p.geometry.kind)).end_forces(p.steps[0], end.displacement);
  CHECK(forces[3][3] == 0);
  CHECK(forces[4][2] == 0);
  CHECK(forces[3][2] == -60);
  CHECK(forces[3][1] == 20);
  // The hinge is the tip of an overhang of 2 next to a span of 6, with P = q 4 / 2: -(P 2^2 8 / 3 + q 2^3 30
  // / 24 - q 6^3 2 / 24) / EI.
  CHECK(end.displacement[8] == rational(-400, 3) / 52857);
}

TEST_CASE(
    "Two cantilevers joined by a hinge over a stop press on the stop with exactly 30 under a load of 120") {
  const contct::problem p = parse_problem(
      "[beam]\nlength = 2.0\nelements = 4\nEI = 1e4\n[[hinge]]\nx = 1.0\n"
      "[[support]]\nx = [0.0, 2.0]\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nx = 1.0\nsurface = \"below\"\nface = -0.001\nstiffness = 6e4\n"
      "[[step]]\npoint = [ { x = 1.0, w = -120.0 } ]\n",
      "pair.toml");
  const exact_step_end end = path_of(p).steps.at(0);
  CHECK(end.increments.at(0).fraction == rational(1, 2));  // each tip has 3 EI / L^3 = 3e4
  CHECK(end.displacement[4] == rational(-3, 2000));
  CHECK(end.force.at(0) == 30);
}

TEST_CASE("The exact path of a beam with three hinges between two supports ends in a mechanism") {
  const exact_path path =
      path_of(parse_problem("[beam]\nlength = 4.0\nelements = 4\nEI = 1\n[[hinge]]\nx = [1, 2, 3]\n"
                            "[[support]]\nx = [0, 4]\nfix = \"w\"\n[[step]]\nuniform = -1\n",
                            "mechanism.toml"));
  REQUIRE(path.mechanism.has_value());
  CHECK(path.mechanism->motion == rational_vector{0, -1, -1, 0, -1, 0, -1, 1, 0, 1});
  CHECK(path.mechanism->work == 3);
}

TEST_CASE("The exact self-weight is weight times area, and the exact bending stiffness is E times I") {
  const contct::problem p = parse_problem(
      "[beam]\nx = [0, 1]\nsection = { E = 0.1, I = 0.3, A = 0.7, weight = 0.1 }\n"
      "[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[step]]\nself_weight = true\n",
      "own.toml");
  const exact_step_end end = path_of(p).steps.at(0);
  CHECK(end.displacement[2] == -rational(7, 100) / 8 / rational(3, 100));  // q L^4 / 8 EI
  CHECK(end.reactions[0] == rational(7, 100));
}
