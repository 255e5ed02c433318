// Tests `contct check`, which describes a problem without solving it.
#include <string>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/bad_plates.hpp"
#include "read/good_problem.hpp"

using namespace contct;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string by_coordinates =
    "title = \"Over two stops\"\n[units]\nlength = \"m\"\nforce = \"kN\"\n[beam]\nlength = 10\nelement_size "
    "= 0.5\n"
    "EI = 1e3\n[[support]]\nx = [0, 10]\nfix = \"w\"\n[[support]]\nx = 5\nspring = { theta = 2 }\n"
    "[[contact]]\nx = [2, 3.1]\nsurface = \"below\"\nface = [0, -1]\nstiffness = 5\n[[bed]]\nmodulus = "
    "4\nface = -1\n"
    "[[step]]\nname = \"dead load\"\nuniform = -1\n[[step]]\npoint = [ { x = 2, w = 1 } ]\n"
    "settlement = [ { x = 0, w = -0.1 }, { x = 10, w = -0.1 } ]\n";

}  // namespace

TEST_CASE("contct check describes the structure, mesh, supports, pairs, beds, steps and units of a problem") {
  const scratch_folder dir;
  dir.write("p.toml", by_coordinates);
  const finished f = contct_program(dir.path(), {"check", "p.toml"});
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK(f.out ==
        "title      Over two stops\n"
        "structure  beam from x = 0 to 10 m\n"
        "mesh       22 nodes, 21 elements\n"
        "x          node 1 at 0, node 5 at 2, node 8 at 3.1, node 12 at 5, node 22 at 10;\n"
        "           equal distances between\n"
        "supports   2 dofs fixed, 1 spring\n"
        "pairs      22, 1 in contact before any load\n"
        "bed 1      modulus 4, below, pairs 3 to 22\n"
        "step 1     \"dead load\", 1 distributed load\n"
        "step 2     1 point load, 2 settlements\n"
        "units      m, kN\n"
        "warnings   none\n");
  CHECK(dir.files() == std::vector<std::string>{"p.toml"});
}

TEST_CASE("contct check describes a plate, and also a matrix with a step that has no load") {
  const scratch_folder dir;
  dir.write("plate.toml", good_plate);
  const finished plate = contct_program(dir.path(), {"check", "plate.toml"});
  CHECK_THAT(plate.out,
             StartsWith("structure  plate from x = 0 to 1, y = 0 to 1\nmesh       6 nodes, 2 elements\n"
                        "x          column 1 at 0, column 3 at 1; equal distances between\n"
                        "y          row 1 at 0, row 2 at 1\n") &&
                 Contains("units      none given\n"));
  dir.write("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 2.0\n2 1 -1.0\n2 2 2.0\n");
  dir.write("zero.mtx", "%%MatrixMarket matrix array real general\n2 1\n0\n0\n");
  dir.write("m.toml", "[matrix]\nstiffness = \"K.mtx\"\n[[step]]\nload = \"zero.mtx\"\n");
  const finished matrix = contct_program(dir.path(), {"check", "m.toml"});
  CHECK(matrix.exit == 0);
  CHECK_THAT(matrix.out,
             StartsWith("structure  matrix K.mtx\nmesh       2 dofs\n") && Contains("step 1     no load\n"));
}

TEST_CASE("contct check writes warnings to standard error, and the number of warnings to standard output") {
  const scratch_folder dir;
  dir.write("p.toml", with("node = 3\nsurface", "node = 1\nsurface"));
  const finished f = contct_program(dir.path(), {"check", "p.toml"});
  CHECK(f.exit == 0);
  CHECK_THAT(f.err, StartsWith("contct: warning: p.toml:7: contact[1]: node 1 is fixed in w"));
  CHECK_THAT(f.out, Contains("warnings   1\n"));
  const finished quiet = contct_program(dir.path(), {"check", "p.toml", "--quiet"});
  CHECK(quiet.out.empty());
  CHECK(quiet.err == f.err);
}
