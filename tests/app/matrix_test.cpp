// Tests runs with an external stiffness matrix.
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

}  // namespace

TEST_CASE("contct run does not suggest the corrected rule for a matrix that may be indefinite") {
  const scratch_folder here;
  here.write("p.toml",
             "[matrix]\nstiffness = \"K.mtx\"\n[[contact]]\ndof = \"1\"\nsurface = \"below\"\nface = 0\n"
             "stiffness = 1e-9\n[[step]]\npoint = [ { dof = \"1\", value = -1e-11 } ]\n");
  here.write("K.mtx", header + "2 2 3\n1 1 1\n2 1 1.00000000001\n2 2 1\n");
  const finished f = contct_program(here.path(), {"run", "p.toml"});
  CHECK_THAT(f.err, Contains("it is not certain that the matrix is positive semidefinite"));
  CHECK_THAT(f.err, !Contains("--kernels corrected"));
  CHECK_THAT(f.err, Contains("set free_motions = 1"));
  here.write("p.toml", here.read("p.toml") + "[[support]]\ndof = \"1\"\nspring = 1e-6\n");
  CHECK(contct_program(here.path(), {"run", "p.toml", "--strict"}).exit == 0);  // now det K = 1e-6 - 2e-11
}

TEST_CASE("with every engine, contct run solves and certifies a problem on a matrix in sparse storage") {
  const scratch_folder here;
  std::filesystem::copy(root / "reference/structures", here.path());
  std::string text = here.read("frame.toml");
  text.insert(text.find("[matrix]\n") + 9, "storage = \"sparse\"\n");
  here.write("s.toml", text);
  for (const char* how : {"--engine=refactor", "--engine=updated", "--final-only", "--kernels=corrected"}) {
    const finished f = contct_program(here.path(), {"run", "s.toml", "--strict", how});
    INFO(how << "\n" << f.err);
    if (f.exit == 2) {
      CHECK_THAT(f.err, Contains("without CHOLMOD"));
      return;
    }
    CHECK(f.exit == 0);
    CHECK_THAT(f.out, Contains(", sparse\n") && Contains("all 3 final states are certified"));
  }
}

TEST_CASE(
    "a matrix without coordinates has a report page and tables, but --vtu is refused and the message says "
    "why") {
  const scratch_folder dir;
  dir.write("K.mtx", header + "2 2 3\n1 1 2\n2 1 -1\n2 2 2\n");
  dir.write("p.toml", spring_problem);
  const finished f = contct_program(dir.path(), {"run", "p.toml", "--html", "o.html", "--csv", "o.csv"});
  INFO(f.err);
  CHECK(f.exit == 0);
  CHECK_THAT(dir.read("o.html"), Contains("\"nodes\":[]") && Contains("\"dofs\":[{\"dof\":\"1\"}"));
  CHECK_THAT(dir.read("o.html"), Contains("\"engine\": \"updated\""));
  CHECK_THAT(dir.read("o.pairs.csv"), Contains("\r\n1,1,1,2,below,contact,"));
  const auto before = dir.files();
  const finished grid = contct_program(dir.path(), {"run", "p.toml", "--vtu", "o.vtu", "--json", "o.json"});
  CHECK(grid.exit == 2);
  CHECK(grid.out.empty());
  CHECK_THAT(grid.err, Contains("--vtu: found the matrix K.mtx without coordinates; allowed:"));
  CHECK_THAT(grid.err, Contains("coordinates = \"FILE\" in [matrix]") &&
                           Contains("mesh = \"FILE\" in [calculix]") && Contains("--csv and --json"));
  CHECK(dir.files() == before);
}

TEST_CASE(
    "a warning gives the number of pairs that --vtu omits because the pairs have no known coordinates") {
  const scratch_folder dir;
  const std::string two = header + "2 2 3\n1 1 2\n2 1 -1\n2 2 2\n";
  dir.write("K.mtx", two);
  dir.write("K.dof", "a.x\n2\n");
  dir.write("K.xyz", "a 1 2 3\n");
  std::string text = spring_problem;
  text.insert(text.find("[[contact]]"), "dofs = \"K.dof\"\ncoordinates = \"K.xyz\"\n");
  dir.write("p.toml", text);
  const finished lost = contct_program(dir.path(), {"run", "p.toml", "--vtu", "p.vtu", "--html", "p.html"});
  CHECK(lost.exit == 0);
  CHECK_THAT(
      lost.err,
      Contains("warning: --vtu: 1 of 1 pairs has no cell: the coordinates of their dofs are not known"));
  CHECK_THAT(dir.read("p.html"), Contains("1 of 2 dofs are not drawn: their labels"));
}
