// A matrix from elsewhere, run as a person would.
#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

const std::string header = "%%MatrixMarket matrix coordinate real symmetric\n";
const std::string spring_problem =
    "[matrix]\nstiffness = \"K.mtx\"\n[[contact]]\ndof = \"2\"\nsurface = \"below\"\nface = -0.5\nstiffness "
    "= 10\n"
    "[[step]]\npoint = [ { dof = \"2\", value = -3 } ]\n";

/// A cube of points, each tied to its neighbours and to the ground; pairs along one edge: p.toml and K.mtx.
void write_cube(const scratch_folder& here) {
  constexpr int side = 12;
  std::string entries;
  int count = 0;
  const auto entry = [&](int row, int column, const char* value) {
    entries += std::to_string(row) + " " + std::to_string(column) + " " + value + "\n";
    ++count;
  };
  for (int n = 0; n < side * side * side; ++n) {
    entry(n + 1, n + 1, "6.1");
    for (const int stride : {1, side, side * side})
      if (n / stride % side + 1 < side) entry(n + stride + 1, n + 1, "-1");
  }
  const std::string rows = std::to_string(side * side * side);
  here.write("K.mtx", header + rows + " " + rows + " " + std::to_string(count) + "\n" + entries);
  std::string text = "[matrix]\nstiffness = \"K.mtx\"\n";
  for (int i = 1; i <= side; ++i)
    text += "[[contact]]\ndof = \"" + std::to_string(i) +
            "\"\nsurface = \"below\"\nface = " + std::to_string(-0.01 * i) + "\nstiffness = 2.0\n";
  text += "[[step]]\npoint = [ { dof = \"1\", value = -9.0 }, { dof = \"12\", value = -8.0 } ]\n";
  text += "[[step]]\npoint = [ { dof = \"1\", value = -1.0 }, { dof = \"12\", value = 2.0 } ]\n";
  here.write("p.toml", text);
}

}  // namespace

TEST_CASE("the frame by its matrix is solved in lockstep and certified, from any folder") {
  const scratch_folder elsewhere;
  const finished f = contct_program(elsewhere.path(),
                                    {"run", (root / "reference/structures/frame.toml").string(), "--strict"});
  INFO(f.err);
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("33 dofs, 2 pairs, 3 steps; kernels fortran, cpp"));
  CHECK_THAT(f.out, Contains("make 1: dof 6.y below"));
  CHECK_THAT(f.out, Contains("0 mismatches"));
  CHECK_THAT(f.out, Contains("all 3 final states are certified"));
}

TEST_CASE("the engines agree that the frame is certified, and so does the oracle alone") {
  for (const char* how :
       {"--engine=updated", "--engine=refactor", "--engine=auto", "--final-only", "--kernels=corrected"}) {
    const finished f = contct_program(root, {"run", "reference/structures/frame.toml", "--strict", how});
    INFO(how << "\n" << f.err);
    CHECK(f.exit == 0);
    CHECK_THAT(f.out, Contains("certified"));
  }
}

TEST_CASE(
    "the corrected rule is advised where it may prove more, and not for a matrix that may be indefinite") {
  const scratch_folder here;
  here.write("p.toml",
             "[matrix]\nstiffness = \"K.mtx\"\n[[contact]]\ndof = \"1\"\nsurface = \"below\"\nface = 0\n"
             "stiffness = 1e-9\n[[step]]\npoint = [ { dof = \"1\", value = -1e-11 } ]\n");
  here.write("K.mtx", header + "2 2 3\n1 1 1\n2 1 1.00000000001\n2 2 1\n");
  const finished f = contct_program(here.path(), {"run", "p.toml"});
  CHECK_THAT(f.err, Contains("it is not certain that the matrix is positive semidefinite"));
  CHECK_THAT(f.err, !Contains("--kernels corrected"));
}

TEST_CASE("a matrix is solved by its entries where it is told to be, and the certificate is the same") {
  const scratch_folder here;
  write_cube(here);
  CHECK_THAT(contct_program(here.path(), {"run", "p.toml", "--strict"}).out, Contains("engine refactor\n"));
  here.write("s.toml", "[matrix]\nstorage = \"sparse\"\n" + here.read("p.toml").substr(sizeof "[matrix]"));
  const finished f = contct_program(here.path(), {"run", "s.toml", "--strict"});
  INFO(f.err);
  if (f.exit == 2) {
    CHECK_THAT(f.err, Contains("without CHOLMOD"));
    return;
  }
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("engine refactor, sparse\n"));
  CHECK_THAT(f.out, Contains("make 1: dof 1 below"));
  CHECK_THAT(f.out, Contains("0 mismatches"));
  CHECK_THAT(f.out, Contains("both final states are certified"));
  CHECK_THAT(f.out, Contains("proved: "));
  for (const char* how :
       {"--engine=updated", "--engine=auto", "--final-only", "--kernels=corrected", "--free-run"}) {
    const finished other = contct_program(here.path(), {"run", "s.toml", "--strict", how});
    INFO(how << "\n" << other.err);
    CHECK(other.exit == 0);
    CHECK_THAT(other.out, Contains("certified"));
  }
}

TEST_CASE("a structure without coordinates has its page and tables, and no grid, which is said") {
  const scratch_folder dir;
  dir.write("K.mtx", header + "2 2 3\n1 1 2\n2 1 -1\n2 2 2\n");
  dir.write("p.toml", spring_problem);
  const finished f = contct_program(dir.path(), {"run", "p.toml", "--html", "o.html", "--csv", "o.csv"});
  INFO(f.err);
  CHECK(f.exit == 0);
  CHECK_THAT(dir.read("o.html"), Contains("\"nodes\":[],\"dofs\":[{\"dof\":\"1\"}"));
  CHECK_THAT(dir.read("o.html"), Contains("\"engine\": \"refactor\""));
  CHECK_THAT(dir.read("o.pairs.csv"), Contains("\r\n1,1,1,2,below,contact,"));
  const auto before = dir.files();
  const finished grid = contct_program(dir.path(), {"run", "p.toml", "--vtu", "o.vtu", "--json", "o.json"});
  CHECK(grid.exit == 2);
  CHECK(grid.out.empty());
  CHECK_THAT(grid.err,
             Contains("--vtu: found a structure given by its matrix, K.mtx, without coordinates; allowed:"));
  CHECK_THAT(grid.err, Contains("coordinates = \"FILE\" in [matrix]") &&
                           Contains("mesh = \"FILE\" in [calculix]") && Contains("--csv and --json"));
  CHECK(dir.files() == before);
}

TEST_CASE(
    "a structure with coordinates is drawn, all of it, and a pair without a place has no cell, which is "
    "said") {
  const scratch_folder dir;
  const std::string frame = std::string(CONTCT_ROOT) + "/reference/structures/";
  const finished f = contct_program(
      dir.path(), {"run", frame + "frame.toml", "--html", "o.html", "--csv", "o.csv", "--vtu", "o.vtu"});
  INFO(f.err);
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK_THAT(dir.read("o.html"), Contains("\"edges\":[["));
  CHECK_THAT(dir.read("o.vtu"), Contains("NumberOfPoints=\"11\" NumberOfCells=\"12\""));
  const std::string two = header + "2 2 3\n1 1 2\n2 1 -1\n2 2 2\n";
  dir.write("K.mtx", two);
  dir.write("K.dof", "a.x\n2\n");
  dir.write("K.xyz", "a 1 2 3\n");
  std::string text = spring_problem;
  text.insert(text.find("[[contact]]"), "dofs = \"K.dof\"\ncoordinates = \"K.xyz\"\n");
  dir.write("p.toml", text);
  const finished lost = contct_program(dir.path(), {"run", "p.toml", "--vtu", "p.vtu", "--html", "p.html"});
  CHECK(lost.exit == 0);
  CHECK_THAT(lost.err,
             Contains("warning: --vtu: 1 of 1 pairs has no cell: the places of their dofs are not known"));
  CHECK_THAT(dir.read("p.html"), Contains("1 of 2 dofs have no known node and direction"));
}

TEST_CASE("what is explained of a structure given by its matrix names dofs by their labels") {
  const scratch_folder dir;
  const std::string frame = std::string(CONTCT_ROOT) + "/reference/structures/frame.toml";
  const finished explained = contct_program(dir.path(), {"explain", frame, "--json", "why.json"});
  CHECK(explained.exit == 0);
  CHECK_THAT(explained.out, Contains("Pair 1, dof 6.y, face below"));
  CHECK_THAT(dir.read("why.json"), Contains("\"dof\":\"6.y\"") && !Contains("\"node\""));
}
