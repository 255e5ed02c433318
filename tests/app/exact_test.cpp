// contct exact: the path in fractions, and the digits of kernels.
#include <nlohmann/json.hpp>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

const std::string three_gaps = "reference/problems/pb07-three-gap-supports.toml";

const std::string cantilever =
    "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";

finished exactly(const std::string& problem, const std::vector<std::string>& more = {}) {
  const scratch_folder dir;
  dir.write("p.toml", problem);
  std::vector<std::string> arguments = {"exact", "p.toml"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return contct_program(dir.path(), arguments);
}

}  // namespace

TEST_CASE("the tie of the three gap supports is printed as the fraction that it is") {
  const finished f =
      contct_program(root, {"exact", three_gaps, "--kernels", "fortran,cpp,fortran-r4,corrected"});
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK_THAT(f.out, StartsWith("PB7") &&
                        Contains("share 3/38, load -2400/19: pair 1 (node 5, below) makes, pair 3"));
  for (const char* kernel : {"\nfortran: 1", "\ncpp: 1", "\nfortran-r4: ", "\ncorrected: 1"})
    CHECK_THAT(f.out, Contains(kernel));
}

TEST_CASE("the document is written beside the text, and alone where it takes standard output") {
  const finished f = contct_program(root, {"exact", three_gaps, "--json", "-"});
  CHECK(f.exit == 0);
  const auto document = nlohmann::json::parse(f.out);
  CHECK(document["format"] == "contct-exact-1");
  CHECK(document["steps"][1]["increments"][0]["fraction"] == "3/38");
}

TEST_CASE("a mechanism is exit 4, with its proof") {
  const finished f = exactly(
      "[beam]\nx = [0, 1, 2]\nEI = 1\n[[step]]\npoint = [ { node = 2, w = -2 } ]\n"
      "[[contact]]\nnode = 2\nsurface = \"above\"\nface = 1\nstiffness = 1\n");
  CHECK(f.exit == 4);
  CHECK_THAT(f.out,
             Contains("no equilibrium: ") && Contains("does work 2 on it") && Contains("w -1, -1, -1"));
  CHECK_THAT(f.err, Contains("p.toml: step 1, at share 0 of its load: no equilibrium"));
}

TEST_CASE("the 1989 rule is followed where --rule asks for it") {
  const std::string close = cantilever +
                            "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1\nstiffness = 3\n"
                            "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1.001\nstiffness = 6\n"
                            "[[step]]\npoint = [ { node = 2, w = -9 } ]\n";
  CHECK_THAT(exactly(close).out, Contains("share 1/3, load -3: pair 1 (node 2, below) makes\n"));
  CHECK_THAT(exactly(close, {"--rule", "1989"}).out,
             Contains("share 1/3, load -3: pair 1 (node 2, below) makes, pair 2 (node 2, below) makes\n"));
}

TEST_CASE("the option --digits says how long a fraction may be") {
  const std::string third = cantilever + "[[step]]\npoint = [ { node = 2, w = -1 } ]\n";
  CHECK_THAT(exactly(third).out, Contains("largest w -1/3 at node 2"));
  CHECK_THAT(exactly(third, {"--digits", "1"}).out, Contains("largest w -0.3 at node 2"));
}

TEST_CASE("exact --quiet prints nothing, and what cannot be is refused with exit 2") {
  const finished quiet = contct_program(root, {"exact", three_gaps, "--quiet"});
  CHECK(quiet.exit == 0);
  CHECK(quiet.out.empty());
  CHECK(contct_program(root, {"exact", three_gaps, "--rule", "1990"}).exit == 2);
  const finished unknown = contct_program(root, {"exact", three_gaps, "--kernels", "nobody"});
  CHECK(unknown.exit == 2);
  CHECK_THAT(unknown.err, Contains("nobody"));
}

TEST_CASE("a matrix with a free motion that the load drives is a mechanism") {
  const scratch_folder dir;
  dir.write("k.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 2\n2 2 4\n");
  dir.write(
      "p.toml",
      "[matrix]\nstiffness = \"k.mtx\"\nfree_motions = 1\n[[contact]]\ndof = \"1\"\nsurface = \"below\"\n"
      "face = 0\nstiffness = 1\n[[step]]\npoint = [ { dof = \"1\", value = 3 } ]\n");
  const finished f = contct_program(dir.path(), {"exact", "p.toml"});
  CHECK(f.exit == 4);
  CHECK_THAT(f.out, Contains("no equilibrium"));
}

TEST_CASE("an indefinite matrix and a structure that is too large are refused") {
  const scratch_folder dir;
  dir.write("k.mtx", "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 2\n2 2 1\n");
  dir.write("indefinite.toml",
            "[matrix]\nstiffness = \"k.mtx\"\n[[step]]\npoint = [ { dof = \"1\", value = 3 } ]\n");
  const finished indefinite = contct_program(dir.path(), {"exact", "indefinite.toml"});
  CHECK(indefinite.exit == 2);
  CHECK_THAT(indefinite.err, Contains("not positive semidefinite"));
  const finished large = exactly("[beam]\nlength = 1\nelements = 30000\nEI = 1\n[[step]]\nuniform = 1\n");
  CHECK(large.exit == 2);
  CHECK_THAT(large.err, Contains("found 60002 dofs; allowed: at most 50000"));
}

TEST_CASE("numbers of absurd size are solved like others") {
  const finished f = exactly(
      "[beam]\nx = [0, 1]\nEI = 1e-300\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[contact]]\nnode = "
      "2\n"
      "surface = \"below\"\nface = -1e-300\nstiffness = 1e308\n[[step]]\npoint = [ { node = 2, w = -1e308 } "
      "]\n",
      {"--digits", "6"});
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("pair 1 (node 2, below) makes") && Contains("w -1.00000, force 1.00000e308"));
}
