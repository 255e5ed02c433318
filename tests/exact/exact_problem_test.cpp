// Tests exact problems made from the decimals of problem files.
#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;
using contct::parse_problem;

namespace {

exact_problem of(const std::string& text) {
  return exact_problem_of(parse_problem(text, "problem.toml"));
}

const std::string clamped = "[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";
const std::string unloaded = "[[step]]\nuniform = 0\n";

}  // namespace

TEST_CASE(
    "in exact arithmetic, three equal elements of a beam have a stiffness from exact thirds of the length") {
  const exact_problem e = of("[beam]\nlength = 1\nelements = 3\nEI = 0.1\n" + clamped + unloaded);
  CHECK(e.stiffness[2].at(0) == -12 * rational(1, 10) * 27);
  CHECK(e.stiffness[2].at(2) == 24 * rational(1, 10) * 27);
  CHECK(e.stiffness[3].at(2) == 0);
}

TEST_CASE("in exact arithmetic, the pairs of a bed have the modulus times exact tributary lengths") {
  const exact_problem e = of("[beam]\nlength = 1\nelements = 3\nEI = 1\n" + clamped +
                             "[[contact]]\nnode = 2\nsurface = \"above\"\nface = 0.1\nstiffness = 0.7\n"
                             "[[bed]]\nmodulus = 0.3\nface = 0\n" +
                             unloaded);
  REQUIRE(e.pairs.size() == 4);
  CHECK(e.pairs[0].stiffness == rational(7, 10));
  CHECK(e.pairs[1].stiffness == rational(1, 10));
  CHECK(e.pairs[3].stiffness == rational(1, 20));
}

TEST_CASE("in exact arithmetic, the pairs of a bed under a plate have exact tributary areas") {
  const exact_problem e =
      of("[plate]\nsize = [1, 1]\nelements = [3, 1]\nD = 1\nnu = 0.3\n"
         "[[bed]]\nmodulus = 1\nface = 0\n" +
         unloaded);
  CHECK(e.pairs[0].stiffness == rational(1, 12));
  CHECK(e.pairs[1].stiffness == rational(1, 6));
}

TEST_CASE("the exact stiffness matrix contains springs of elastic supports, but not fixed supports") {
  const exact_problem e = of("[beam]\nx = [0, 1]\nEI = 1\n" + clamped +
                             "[[support]]\nnode = 2\nspring = { theta = 0.2 }\n" + unloaded);
  CHECK(e.stiffness[3].at(3) == rational(42, 10));
  CHECK(e.fixed == std::vector<char>{1, 1, 0, 0});
  CHECK(e.supports[2].spring == rational(1, 5));
}

TEST_CASE(
    "a plate's pressure becomes exact consistent nodal loads, and a settlement is the exact decimal of the "
    "file") {
  contct::problem p = parse_problem(
      "[plate]\nsize = [1, 1]\nelements = [1, 1]\nD = 1\nnu = 0.3\n[[support]]\nnode = 1\nfix = [\"w\"]\n"
      "[[step]]\nuniform = 0.6\n",
      "problem.toml");
  p.steps[0].settlements = {{0, 0, -0.01}};
  const exact_problem e = exact_problem_of(p);
  CHECK(e.steps[0].force[0] == rational(15, 100));
  CHECK(e.steps[0].force[1] == rational(1, 40));
  CHECK(e.steps[0].settlement[0] == rational(-1, 100));
}

TEST_CASE(
    "in exact arithmetic, a list of coordinates is used as written, even if doubles would show equal "
    "elements") {
  const rational third = decimal_of(0.3333333333333333);
  const exact_problem list =
      of("[beam]\nx = [0, 0.3333333333333333, 0.6666666666666666, 1]\nEI = 1\n" + clamped + unloaded);
  CHECK(list.stiffness[1].at(0) == 6 / (third * third));
  CHECK(of("[beam]\nlength = 1\nelements = 3\nEI = 1\n" + clamped + unloaded).stiffness[1].at(0) == 54);
  const std::string plate = "D = 1\nnu = 0.3\n[[bed]]\nmodulus = 1\nface = 0\n" + unloaded;
  CHECK(of("[plate]\nx = [0, 0.3333333333333333, 1]\ny = [0, 1]\n" + plate).pairs[0].stiffness == third / 4);
}

TEST_CASE("in exact arithmetic, element_size makes equal elements between the coordinates of the file") {
  const exact_problem e =
      of("[beam]\nlength = 1\nelement_size = 0.25\nEI = 1\n" + clamped +
         "[[contact]]\nx = 0.7\nsurface = \"below\"\nface = -1\nstiffness = 1\n" + unloaded);
  const rational h = rational(7, 30);  // three elements to x = 0.7 and two beyond
  CHECK(e.dofs() == 12);
  CHECK(e.stiffness[1].at(0) == 6 / (h * h));
  CHECK(e.stiffness[10].at(11) == -6 / (rational(3, 20) * rational(3, 20)));
}

TEST_CASE(
    "in exact arithmetic, a polynomial face of a bed has its exact value, and is 0 only if this value is 0") {
  const std::string bed = clamped + "[[bed]]\nmodulus = 1\n";
  const exact_problem e = of("[beam]\nx = [0, 0.1, 1]\nEI = 1\n" + bed +
                             "face = { polynomial = [0, -0.001, 0, -0.02] }\n" + unloaded);
  CHECK(e.pairs[0].face == rational(-12, 100000));
  CHECK_FALSE(e.pairs[0].closed);
  // In doubles 0.3 - 0.1 x - 0.2 x^2 is -5.6e-17 at x = 1.
  const std::string at_1 = "[beam]\nx = [0, 1]\nEI = 1\n" + bed;
  const exact_problem touches = of(at_1 + "face = { polynomial = [0.3, -0.1, -0.2] }\n" + unloaded);
  CHECK(touches.pairs[0].face == 0);
  CHECK(touches.pairs[0].closed);
  CHECK_FALSE(of(at_1 + "state = \"separated\"\nface = { polynomial = [0.3, -0.1, -0.2] }\n" + unloaded)
                  .pairs[0]
                  .closed);
}
