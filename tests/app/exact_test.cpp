// Tests `contct exact`: the path in fractions, and the number of correct digits of kernels.
#include <nlohmann/json.hpp>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
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

TEST_CASE(
    "contct exact prints the share at which a beam reaches both outer stops (PB7) as the fraction 3/38") {
  const finished f =
      contct_program(root, {"exact", three_gaps, "--kernels", "fortran,cpp,fortran-r4,corrected"});
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK_THAT(f.out, StartsWith("PB7") &&
                        Contains("share 3/38, load -2400/19: pair 1 (node 5, below) makes contact, pair 3"));
  for (const char* kernel : {"\nfortran: 1", "\ncpp: 1", "\nfortran-r4: ", "\ncorrected: 1"})
    CHECK_THAT(f.out, Contains(kernel));
}

TEST_CASE(
    "contct exact proves a mechanism by a rigid-body motion and the load's work on it, with exit status 4") {
  const finished f = exactly(
      "[beam]\nx = [0, 1, 2]\nEI = 1\n[[step]]\npoint = [ { node = 2, w = -2 } ]\n"
      "[[contact]]\nnode = 2\nsurface = \"above\"\nface = 1\nstiffness = 1\n");
  CHECK(f.exit == 4);
  CHECK_THAT(f.out,
             Contains("no equilibrium: ") && Contains("does work 2 on it") && Contains("w -1, -1, -1"));
  CHECK_THAT(f.err, Contains("p.toml: step 1, at share 0 of its load: no equilibrium"));
}

TEST_CASE("contct exact follows the 1989 rule if --rule names it") {
  const std::string close = cantilever +
                            "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1\nstiffness = 3\n"
                            "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1.001\nstiffness = 6\n"
                            "[[step]]\npoint = [ { node = 2, w = -9 } ]\n";
  CHECK_THAT(exactly(close).out, Contains("share 1/3, load -3: pair 1 (node 2, below) makes contact\n"));
  CHECK_THAT(exactly(close, {"--rule", "1989"}).out,
             Contains("share 1/3, load -3: pair 1 (node 2, below) makes contact, pair 2 (node 2, below) "
                      "makes contact\n"));
}

TEST_CASE("if a fraction has more digits than contct exact --digits allows, a decimal is printed") {
  const std::string third = cantilever + "[[step]]\npoint = [ { node = 2, w = -1 } ]\n";
  CHECK_THAT(exactly(third).out, Contains("largest w -1/3 at node 2"));
  CHECK_THAT(exactly(third, {"--digits", "1"}).out, Contains("largest w -0.3 at node 2"));
}

TEST_CASE("contct exact prints nothing with --quiet, and refuses invalid options with exit status 2") {
  const finished quiet = contct_program(root, {"exact", three_gaps, "--quiet"});
  CHECK(quiet.exit == 0);
  CHECK(quiet.out.empty());
  CHECK(contct_program(root, {"exact", three_gaps, "--rule", "1990"}).exit == 2);
  const finished unknown = contct_program(root, {"exact", three_gaps, "--kernels", "nobody"});
  CHECK(unknown.exit == 2);
  CHECK_THAT(unknown.err, Contains("nobody"));
}

TEST_CASE("contct exact refuses a structure with more than 50,000 dofs") {
  const finished large = exactly("[beam]\nlength = 1\nelements = 30000\nEI = 1\n[[step]]\nuniform = 1\n");
  CHECK(large.exit == 2);
  CHECK_THAT(large.err, Contains("found 60002 dofs; allowed: at most 50000"));
}

TEST_CASE(
    "contct run and contct exact use the shortest decimal of each double, and warn if a file has a longer "
    "number") {
  const scratch_folder dir;
  dir.write(
      "p.toml",
      "[beam]\nlength = 2.0\nelements = 2\nEI = 1.0\n[[support]]\nx = [0.0, 2.0]\nfix = \"w\"\n"
      "[[contact]]\nx = 1.0\nsurface = \"below\"\nface = -1.0e-6\nstiffness = 10.0\n[[step]]\npoint = [\n"
      "{ x = 1.0, w = 1000000000000.00001 }, { x = 1.0, w = -1000000000000.0 }, { x = 1.0, w = -0.00002 } "
      "]\n");
  const std::string warning =
      "contct: warning: p.toml:15:16: step[1].point[1].w: found 1000000000000.00001; the shortest decimal of "
      "its "
      "double, 1e+12, is used everywhere\n";
  const finished exact = contct_program(dir.path(), {"exact", "p.toml", "--json", "-"});
  CHECK(exact.exit == 0);
  CHECK(exact.err == warning);
  const auto pair = nlohmann::json::parse(exact.out)["steps"][0]["pairs"][0];
  CHECK(pair["force"] == "7/800000");
  const finished run = contct_program(dir.path(), {"run", "p.toml", "--kernels", "corrected", "--json", "-"});
  CHECK(run.exit == 0);
  CHECK(run.err == warning);
  CHECK(nlohmann::json::parse(run.out)["steps"][0]["pairs"][0]["force"].get<double>() == Approx(8.75e-6));
}

TEST_CASE(
    "contct exact solves a problem on a nearly singular matrix, and refuses a barely indefinite matrix") {
  const scratch_folder dir;
  const auto with = [&dir](const std::string& corner) {
    dir.write("k.mtx",
              "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 1\n2 1 1\n2 2 " + corner + "\n");
    dir.write("p.toml",
              "[matrix]\nstiffness = \"k.mtx\"\n[[step]]\npoint = [ { dof = \"1\", value = 1 } ]\n");
    return contct_program(dir.path(), {"exact", "p.toml", "--digits", "30"});
  };
  const finished solved = with("1.0000000000000002");
  CHECK(solved.exit == 0);
  CHECK_THAT(solved.out, Contains("largest w 5000000000000001 at dof 1"));
  const finished refused = with("0.9999999999999999");
  CHECK(refused.exit == 2);
  CHECK_THAT(refused.err, Contains("k.mtx: not positive semidefinite: found u'Ku = -1e-16, exactly"));
  CHECK(with("1").exit == 4);  // semidefinite, and the load drives the rigid-body motion
}

TEST_CASE(
    "contct exact counts correct digits of kernels under settlements, several steps and pairs on both "
    "sides") {
  const finished f = exactly(
      "[beam]\nx = [0, 1, 2, 3]\nEI = 0.333333333333333333333\n"
      "[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[support]]\nnode = 4\nfix = [\"w\"]\n"
      "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.01\nstiffness = 3\n"
      "[[contact]]\nnode = 2\nsurface = \"above\"\nface = 0.01\nstiffness = 3\n"
      "[[contact]]\nnode = 4\nsurface = \"below\"\nface = 0\nstiffness = 5\n"
      "[[contact]]\nnode = 1\nsurface = \"above\"\nface = 0.5\nstiffness = 5\n"
      "[[step]]\nuniform = -1\nsettlement = [ { node = 4, w = -0.1 } ]\n"
      "[[step]]\nuniform = 2\nsettlement = [ { node = 4, w = 0.2 } ]\n"
      "[[step]]\nsettlement = [ { node = 4, w = 0 } ]\n"
      "[[step]]\npoint = [ { node = 3, w = -0.7, theta = 0.1 } ]\n",
      {"--kernels", "fortran,corrected", "--json", "-"});
  CHECK(f.exit == 0);
  const auto document = nlohmann::json::parse(f.out);
  REQUIRE(document["steps"].size() == 4);
  CHECK(document["steps"][1]["increments"][1]["fraction"] == "1/3");
  CHECK(document["steps"][0]["pairs"][2]["force"] == "1/2");
  REQUIRE(document["kernels"].size() == 2);
  for (const auto& kernel : document["kernels"]) {
    CHECK(kernel["same_events"] == true);
    for (const char* what : {"digits", "event_digits", "force_digits"}) CHECK(kernel[what] > 13.0);
  }
}
