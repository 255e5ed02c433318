// Tests the tables of steps: names, loads by coordinates, and settlements.
#include "catch.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/read/tables.hpp"
#include "read/bad_inputs.hpp"
#include "support/scratch_folder.hpp"

using namespace contct;

namespace {

load step_of(const std::string& lines) {
  return parse_problem(step_with(lines), "pb.toml").steps.at(0);
}

}  // namespace

TEST_CASE("the name of a step is optional, and is empty by default") {
  CHECK(step_of("name = \"dead load\"\nuniform = -1\n").name == "dead load");
  CHECK(step_of("uniform = -1\n").name.empty());
}

TEST_CASE("a point load with several coordinates is a load at each of the coordinates") {
  const load l = step_of("point = [ { x = [2.0, 0.0], w = -1, theta = 3 }, { nodes = [2], w = 5 } ]\n");
  REQUIRE(l.points.size() == 5);
  CHECK((l.points[1].node == 0 && l.points[1].dof == 0 && l.points[1].value == -1));
  CHECK((l.points[2].node == 2 && l.points[2].dof == 1 && l.points[2].value == 3));
  CHECK((l.points[4].node == 1 && l.points[4].value == 5));
}

TEST_CASE(
    "a point load at the coordinate of a node acts at the node, and a point load between nodes at its "
    "coordinate") {
  const load l = step_of("point = [ { x = [1.0, 1.25], w = -1, theta = 3 } ]\n");
  REQUIRE(l.points.size() == 2);
  CHECK((l.points[1].node == 1 && l.points[1].dof == 1 && l.points[1].value == 3));
  REQUIRE(l.placed.size() == 2);
  CHECK(
      (l.placed[0].what == load_kind::point && l.placed[0].from == 1.25 && l.placed[0].polynomial[0] == -1));
  CHECK((l.placed[1].what == load_kind::moment && l.placed[1].polynomial[0] == 3));
}

TEST_CASE("without `from` a load begins at the start of the beam, and without `to` it ends at the end") {
  const load l = step_of(
      "uniform = [ { value = 1, from = 0.5 }, { polynomial = [2, 3], to = 1.5 } ]\n"
      "curvature = [ { value = 4 } ]\n");
  REQUIRE(l.placed.size() == 3);
  CHECK((l.placed[0].from == 0.5 && l.placed[0].to == 2));
  CHECK((l.placed[1].from == 0 && l.placed[1].to == 1.5 && l.placed[1].polynomial[1] == 3));
  CHECK((l.placed[2].what == load_kind::curvature && l.placed[2].from == 0 && l.placed[2].to == 2));
}

TEST_CASE(
    "a load on a rectangle of a plate is given by two corners, and missing corners are those of the plate") {
  const auto read = [](const std::string& keys) {
    return parse_problem(plate_with("value = -1.0", "value = -1.0, " + keys), "pb.toml")
        .steps.at(0)
        .placed.at(0);
  };
  const placed_load part = read("from = [0.25, 0.5]");
  CHECK((part.from == 0.25 && part.to == 1.0));
  CHECK((part.across[0] == 0.5 && part.across[1] == 1.0));
  CHECK(read("to = [0.75, 0.25]").across[1] == 0.25);
}

TEST_CASE(
    "a load at the decimal of a node acts at the node, although the mesh is rounded, and loads make no "
    "node") {
  const problem p = parse_problem(
      "[beam]\nlength = 0.7\nelements = 7\nEI = 1\n[[support]]\nx = 0\nfix = [\"w\", \"theta\"]\n"
      "[[step]]\nuniform = [ { value = 1, from = 0.3, to = 0.33 } ]\npoint = [ { x = 0.62, w = 1 } ]\n",
      "pb.toml");
  const beam& b = std::get<beam>(p.geometry.kind);
  CHECK(b.nodes() == 8);
  CHECK(p.steps.at(0).placed.at(0).from == 0.3);
  CHECK(b.x.at(3) != 0.3);
  CHECK(p.steps[0].placed[0].to == 0.33);
  CHECK(p.steps[0].placed.at(1).from == 0.62);
}

TEST_CASE("a step may have settlements of fixed dofs and no loads") {
  const load l = step_of("settlement = [ { x = 0, w = -0.01, theta = 0.5 } ]\n");
  CHECK(l.points.empty());
  CHECK(l.distributed.empty());
  REQUIRE(l.settlements.size() == 2);
  CHECK((l.settlements[0].node == 0 && l.settlements[0].dof == 0 && l.settlements[0].value == -0.01));
  CHECK((l.settlements[1].dof == 1 && l.settlements[1].value == 0.5));
}

TEST_CASE("a fixed dof with a spring may settle by different lengths in several steps") {
  const problem p = parse_problem(
      with("fix = [\"w\", \"theta\"]\n", "fix = \"w\"\nspring = { w = 7 }\n") +
          "[[step]]\nsettlement = [ { node = 1, w = 1 } ]\n[[step]]\nsettlement = [ { node = 1, w = 2 } ]\n",
      "pb.toml");
  REQUIRE(p.steps.size() == 3);
  CHECK(p.steps[0].settlements.empty());
  CHECK(p.steps[2].settlements.at(0).value == 2);
}

TEST_CASE("supports of a plate at given points may settle in w and in both slopes") {
  const problem p = parse_problem(
      plate_with("[[step]]\n",
                 "[[step]]\nsettlement = [ { at = [[0, 0], [0, 1.0]], w = -1 }, { node = 1, wy = 2 } ]\n"),
      "pb.toml");
  const auto& moved = p.steps.at(0).settlements;
  REQUIRE(moved.size() == 3);
  CHECK(moved[1].node == 3);
  CHECK((moved[2].dof == 2 && moved[2].value == 2));
}

TEST_CASE("fixed dofs of a matrix settle, and are named by labels") {
  const scratch_folder here;
  (void)here.write("K.mtx",
                   "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2.0\n2 1 -1.0\n2 2 2.0\n");
  const auto read = [&](const std::string& settlement) {
    return read_problem(
        here.write("p.toml",
                   "[matrix]\nstiffness = \"K.mtx\"\n[[support]]\ndofs = [\"2\"]\nfix = true\n"
                   "[[step]]\nname = \"down\"\nsettlement = [ { " +
                       settlement + ", value = -1.5 } ]\n"));
  };
  const problem p = read("dof = \"2\"");
  CHECK(p.steps.at(0).name == "down");
  const prescribed_displacement moved = p.steps[0].settlements.at(0);
  CHECK((moved.node == 1 && moved.dof == 0 && moved.value == -1.5));
  CHECK_THAT(verdict([&] { (void)read("dof = \"1\""); }),
             Catch::Matchers::Contains("settlement[1].value: found a settlement of dof 1, which is free"));
}
