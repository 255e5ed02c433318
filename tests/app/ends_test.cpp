// Tests the messages and exit statuses of runs that do not reach an equilibrium.
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

/// A free beam over one pair, loaded at a node.
std::string over_one_pair(int loaded) {
  return "[beam]\nx = [0, 1, 2]\nEI = 1000\n[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.5\n"
         "stiffness = 1e4\n[[step]]\npoint = [ { node = " +
         std::to_string(loaded) + ", w = -1 } ]\n";
}

/// A pivoted beam that lies on a stop below, and is then lifted onto a stop above.
const char* const lifted =
    "[beam]\nx = [0, 1, 2]\nEI = 1000\n[[support]]\nnode = 1\nfix = \"w\"\n"
    "[[contact]]\nnode = 2\nsurface = \"below\"\nface = 0\nstiffness = 1e4\n"
    "[[contact]]\nnode = 3\nsurface = \"above\"\nface = 0.01\nstiffness = 1e4\n"
    "[[step]]\npoint = [ { node = 3, w = -10 } ]\n[[step]]\npoint = [ { node = 3, w = 10 } ]\n";

const char* const stiff_stop =
    "[beam]\nx = [0.0, 0.7, 1.3, 2.0]\nEI = 1.0e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.0037\nstiffness = 1.0e20\n"
    "[[step]]\npoint = [ { node = 4, w = -60.0 } ]\n";

const std::string mtx = "%%MatrixMarket matrix coordinate real symmetric\n3 3 6\n";

/// Writes a problem whose matrix has a rigid-body motion, held by a spring that is lost to rounding. `known`:
/// the key free_motions, or nothing.
void write_soft_matrix(const scratch_folder& dir, const std::string& known = "") {
  dir.write("K.mtx", mtx + "1 1 13\n2 1 2\n2 2 1\n3 1 4\n3 2 -1\n3 3 5\n");
  dir.write("p.toml", "[matrix]\nstiffness = \"K.mtx\"\n" + known +
                          "[[support]]\ndof = \"1\"\nspring = 1e-13\n[[contact]]\ndof = \"1\"\n"
                          "surface = \"below\"\nface = -0.0396\nstiffness = 5.16e+04\n[[step]]\n"
                          "point = [ { dof = \"3\", value = -0.556 } ]\n[[step]]\npoint = [ { dof = \"2\", "
                          "value = -0.113 } ]\n");
}

finished run_of(const std::string& text, std::vector<std::string> options, const scratch_folder& dir) {
  dir.write("p.toml", text);
  options.insert(options.begin(), {"run", "p.toml"});
  return contct_program(dir.path(), options);
}

nlohmann::json result_in(const scratch_folder& dir) {
  return nlohmann::json::parse(dir.read("out.json"));
}

}  // namespace

TEST_CASE(
    "a beam that falls on its only pair and balances there has one event, in which the pair makes contact") {
  const scratch_folder dir;
  const finished f = run_of(over_one_pair(2), {"--kernels", "corrected", "--json", "out.json"}, dir);
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("make 1: node 2 below") && !Contains("break") && !Contains("2 pairs"));
  const auto result = result_in(dir);
  std::size_t events = 0;
  for (const auto& i : result["steps"][0]["increments"]) events += i["events"].size();
  CHECK(events == 1);
}

TEST_CASE(
    "if the 1989 rule loses all supports but an equilibrium exists, contct run does not report a mechanism") {
  const scratch_folder dir;
  const finished f = run_of(lifted, {"--kernels", "fortran,cpp", "--json", "out.json"}, dir);
  CHECK(f.exit == 5);
  CHECK_THAT(f.err, Contains("step 2, at share 0.5 of its load: the path ended: when pair 1") &&
                        Contains("There is an equilibrium") && Contains("--kernels corrected") &&
                        !Contains("no equilibrium"));
  CHECK(result_in(dir)["status"] == "path-ended");
  CHECK(result_in(dir)["end"]["reason"] == "path ended");
  CHECK(run_of(lifted, {"--kernels", "corrected"}, dir).exit == 0);
  const finished exact = contct_program(dir.path(), {"exact", "p.toml", "--rule", "1989"});
  CHECK(exact.exit == 5);
  CHECK_THAT(exact.out + exact.err, !Contains("no equilibrium"));
}

TEST_CASE(
    "if only the path of the 1989 rule is lost, contct run still solves the problem and has exit status 0") {
  const scratch_folder dir;
  const finished f = run_of(lifted, {"--strict", "--json", "out.json"}, dir);
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK_THAT(f.out, Contains("the path of the 1989 rule ends early") && Contains("  ended    "));
  CHECK(result_in(dir)["status"] == "solved");
  CHECK(result_in(dir)["rule_1989"]["status"] == "path-ended");
}

TEST_CASE(
    "if a matrix has a spring softer than rounding, no command reports that there is no equilibrium, and "
    "free_motions = 0 gives the exact answer") {
  const scratch_folder dir;
  write_soft_matrix(dir);
  const finished asked = contct_program(dir.path(), {"run", "p.toml", "--strict"});
  CHECK(asked.exit == 3);
  CHECK_THAT(asked.err, Contains("1 motion is nearly free: its stiffness is 3e-15 of the largest; set "
                                 "free_motions = 1, or 0 if") &&
                            !Contains("no equilibrium"));
  write_soft_matrix(dir, "free_motions = 0\n");
  for (const char* how : {"--kernels=corrected", "--final-only", "--kernels=fortran"}) {
    const finished f = contct_program(dir.path(), {"run", "p.toml", how, "--json", "out.json"});
    INFO(how << "\n" << f.out << f.err);
    CHECK(f.exit == 0);
    CHECK_THAT(f.out + f.err, !Contains("no equilibrium"));
    const double exactly = -13842500000000.141;  // -11074000000000113 / 800
    const double w = result_in(dir)["steps"][1]["displacement"][1];
    const bool in_doubles =
        std::string(how).ends_with("fortran");  // one digit is right, and nothing is certified
    CHECK(w == Approx(exactly).epsilon(in_doubles ? 0.1 : 1e-15));
  }
}

TEST_CASE("the JSON result and the CSV table of pairs have the same contact force of a stiff stop") {
  const scratch_folder dir;
  const finished f =
      run_of(stiff_stop, {"--kernels", "corrected", "--json", "out.json", "--csv", "out.csv"}, dir);
  CHECK(f.exit == 0);
  const double force = result_in(dir)["steps"][0]["pairs"][0]["force"];
  CHECK(force == Approx(57.938097).epsilon(1e-8));
  const std::string table = dir.read("out.pairs.csv");
  const std::string last = table.substr(table.rfind("\r\n", table.size() - 3) + 2);
  std::size_t at = 0;
  for (int column = 0; column < 9; ++column) at = last.find(',', at) + 1;
  CHECK(std::strtod(last.c_str() + at, nullptr) == force);
}

TEST_CASE(
    "contct exact gives the corrected kernel more than 15 correct digits of the force of a very stiff stop") {
  const scratch_folder dir;
  dir.write(
      "p.toml",
      "[beam]\nx = [0, 1]\nEI = 3\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[contact]]\nnode = 2\n"
      "surface = \"below\"\nface = -0.3\nstiffness = 1e17\n[[step]]\npoint = [ { node = 2, w = -9.1 } ]\n");
  const finished f =
      contct_program(dir.path(), {"exact", "p.toml", "--kernels", "corrected", "--json", "out.json"});
  CHECK(f.exit == 0);
  const auto kernel = result_in(dir)["kernels"][0];
  CHECK(kernel["name"] == "corrected");
  CHECK(kernel["force_digits"].get<double>() > 15.0);
}

TEST_CASE(
    "contct names combinations without an equilibrium, solves the later combinations, and has exit status "
    "4") {
  const scratch_folder dir;
  dir.write("p.toml",
            "[beam]\nx = [0, 1, 2]\nEI = 1000\n[[contact]]\nx = [0, 2]\nsurface = \"below\"\nface = 0\n"
            "stiffness = 1e4\n[[case]]\nname = \"down\"\nuniform = -1\n"
            "[[combination]]\nname = \"lifts\"\nterms = { down = -1 }\n"
            "[[combination]]\nname = \"rests\"\nterms = { down = 1.5 }\n"
            "[[combination]]\nname = \"flies\"\nterms = { down = -2 }\n");
  const std::vector<std::vector<std::string>> commands = {
      {"run", "p.toml", "--json", "out.json"}, {"exact", "p.toml"}, {"run", "p.toml", "--final-only"}};
  for (const auto& command : commands) {
    const finished f = contct_program(dir.path(), command);
    INFO(command.back() << "\n" << f.out << f.err);
    CHECK(f.exit == 4);
    CHECK_THAT(f.err, Contains("combination \"lifts\"") && Contains("combination \"flies\""));
    CHECK_THAT(f.err, !Contains("\"rests\", at share"));
    CHECK_THAT(f.out, Contains("rests"));
  }
  CHECK(result_in(dir)["steps"][1]["pairs"][0]["force"] == Approx(1.5));
}
