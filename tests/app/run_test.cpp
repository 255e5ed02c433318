// Tests `contct run`: its output, files and exit status.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/good_problem.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

const char* const freed =
    "[beam]\nx = [0, 1, 2, 3, 4]\nEI = 100\n[[contact]]\nnode = 2\nsurface = \"below\"\nface = 0\nstiffness "
    "= 10\n"
    "[[contact]]\nnode = 4\nsurface = \"below\"\nface = 0\nstiffness = 10\n[[step]]\n"
    "point = [ { node = 3, w = -4 }, { node = 5, w = -6 } ]\n";

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(lines, line);) longest = std::max(longest, line.size());
  return longest;
}

}  // namespace

TEST_CASE(
    "the table of contct run has share, s, load, events with node and surface, and the comparison of the "
    "kernels") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const finished f = contct_program(dir.path(), {"run", "pb.toml", "--kernels", "fortran,cpp"});
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK_THAT(f.out, Contains("1.1  0.25"));
  CHECK_THAT(f.out, Contains("equal    w -15 at node 3    make 1: node 3 below"));
  CHECK_THAT(f.out, Contains("   end  1 of 1 in contact; 10+ digits; certified\n"
                             "        w             -0.00483721       node 3, x = 2\n"
                             "        moment        -36.2791          node 1, x = 0\n"
                             "        shear         18.1395           node 1, x = 0\n"
                             "        contact force 41.8605           pair 1, node 3 below\n"
                             "        reaction      18.1395           node 1\n"
                             "        sums          loads -60, reactions 18.1395, contact 41.8605\n"));
  CHECK_THAT(f.out,
             Contains("fortran and cpp are equal to the bit; 2 calls, 8 values compared, 0 mismatches"));
  CHECK(dir.files() == std::vector<std::string>{"pb.toml"});  // no fort.26
}

TEST_CASE(
    "without --kernels, contct run gives the corrected rule's answer, and compares the 1989 rule in every "
    "row") {
  const scratch_folder dir;
  const std::string near = CONTCT_ROOT "/reference/problems/divergences/near-tie.toml";
  const finished f = contct_program(dir.path(), {"run", near, "--strict", "--json", "o.json"});
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK_THAT(f.out, Contains("kernels corrected, fortran, cpp; engine condensed\n") &&
                        Contains("  incr  share      s          1989     load               events\n"));
  CHECK_THAT(f.out, Contains("0.25       same     w -15 at node 3    make 1: node 3 below\n") &&
                        Contains("0.0119444  other    w -15.5375         make 2: node 3 below\n" +
                                 std::string(58, ' ') + "1989: make 2 at 0.25\n"));
  CHECK_THAT(f.out, Contains("fortran and cpp are equal to the bit; 7 calls, 42 values compared") &&
                        Contains("the 1989 rule is wrong in step 2: the deflection of node 3 is 0.000133333\n"
                                 "instead of 0: off by 0.000133, 3 % of the largest of its kind\n") &&
                        Contains("both final states are certified"));
  const auto r = nlohmann::json::parse(dir.read("o.json"));
  CHECK(r["kernels"] == nlohmann::json({"corrected", "fortran", "cpp"}));
  CHECK(r["certified"] == true);
  CHECK(r["lockstep"] == r["rule_1989"]["lockstep"]);
  CHECK(r["lockstep"]["calls"] == 7);
  CHECK(r["rule_1989"]["same_events"] == false);
  const auto& unloaded = r["rule_1989"]["wrong_steps"][1];
  CHECK(unloaded["step"] == 2);
  CHECK(unloaded["quantity"] == "w");
  CHECK(unloaded["value"].get<double>() == Approx(4.0 / 30000));  // 0.5 L^3 / 3 EI
  CHECK(unloaded["right"] == 0.0);
}

TEST_CASE(
    "if the answer is certified, the table of contct run does not print errors of the 1989 rule in red") {
  const scratch_folder dir;
  const std::string near = CONTCT_ROOT "/reference/problems/divergences/near-tie.toml";
  const process_options at_terminal{"", {{"TERM", "xterm"}}, true};
  const std::string red = "\033[1;31m";
  CHECK_THAT(contct_program(dir.path(), {"run", near}, at_terminal).out, !Contains(red));
  CHECK_THAT(contct_program(dir.path(), {"run", near, "--kernels", "fortran,cpp"}, at_terminal).out,
             Contains(red));
}

TEST_CASE("if --kernels is not given, contct run writes the trace and unit 26 of the 1989 rule") {
  const scratch_folder dir;
  const std::string pb7 = CONTCT_ROOT "/reference/problems/pb07-three-gap-supports.toml";
  const auto calls = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"run", pb7, "--quiet", "--trace", "t", "--log", "l"});
    CHECK(contct_program(dir.path(), more).exit == 0);
    const std::string trace = dir.read("t");
    return trace.substr(trace.find("\ncall ")) + dir.read("l");
  };
  CHECK(calls({}) == calls({"--kernels", "fortran"}));
}

TEST_CASE("contct run --refine reports no change for a beam without a bed, and refuses a matrix") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const finished f = contct_program(dir.path(), {"run", "pb.toml", "--refine", "--json", "o.json"});
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("half the element size changes w by ") && Contains(" % of 0.00") &&
                        Contains("beams are exact between nodes"));
  const auto refined = nlohmann::json::parse(dir.read("o.json"))["refined"];
  CHECK(refined.size() == 5);
  CHECK(refined["moment"]["of"].get<double>() == Approx(36.2791).epsilon(1e-5));
  CHECK(refined["moment"]["change"].get<double>() < 1e-11);
  dir.write("K.mtx", "%%MatrixMarket matrix coordinate real symmetric\n1 1 1\n1 1 2.0\n");
  dir.write("m.toml", "[matrix]\nstiffness = \"K.mtx\"\n[[step]]\npoint = [ { dof = \"1\", value = 1 } ]\n");
  const finished matrix = contct_program(dir.path(), {"run", "m.toml", "--refine", "--json", "m.json"});
  CHECK(matrix.exit == 2);
  CHECK(matrix.out.empty());
  CHECK_THAT(matrix.err,
             Contains("--refine: found a structure given by its matrix, K.mtx; allowed: [beam] and [plate]"));
  CHECK(dir.files() == std::vector<std::string>{"K.mtx", "m.toml", "o.json", "pb.toml"});
}

TEST_CASE(
    "contct run prints a bed's pressure and contact length, and --refine warns that the bed has twice as "
    "many pairs") {
  const finished f = contct_program(
      "/", {"run", std::string(CONTCT_ROOT) + "/reference/problems/pb11a-strip-footing-n20.toml", "--kernels",
            "corrected", "--refine"});
  CHECK_THAT(f.out,
             Contains("        sums          loads -1, reactions 0, contact 1\n"
                      "        bed 1         pressure 0 to 3.3121, largest at node 1, x = 0; 0.625 in\n"
                      "        contact\n"));
  CHECK_THAT(f.out, Contains("pressure by 0.0157 (0.47 % of ") && Contains("the changes come from the bed"));
}

TEST_CASE("no line of the table of contct run is wider than the terminal, from 40 to 160 columns") {
  const scratch_folder dir;
  std::string busy =
      "title = \"A beam of a long name, with which the narrowest of all terminals has its trouble\"\n"
      "[beam]\nlength = 2000\nelements = 2000\nEI = 1e9\n[[support]]\nnodes = [1, 2001]\nfix = [\"w\"]\n";
  for (int node = 990; node <= 1010; ++node) {
    busy += "[[contact]]\nnode = " + std::to_string(node) +
            "\nsurface = \"below\"\nface = -1e-5\nstiffness = 1e-9\n";
  }
  dir.write("busy.toml", busy + "[[step]]\nuniform = -1e-6\n[[step]]\nuniform = 1e-6\n");
  dir.write("pb.toml", good_problem);
  const std::string pb7 = std::string(CONTCT_ROOT) + "/reference/problems/pb07-three-gap-supports.toml";
  for (const char* columns : {"40", "60", "80", "120", "160"}) {
    for (const std::string& file : {std::string("pb.toml"), std::string("busy.toml"), pb7}) {
      const finished f = contct_program(dir.path(), {"run", file}, {"", {{"COLUMNS", columns}}, false});
      INFO(columns << " columns\n" << f.out << f.err);
      CHECK(f.exit == 0);
      CHECK(longest_line(f.out) <= std::stoul(columns));
      CHECK_THAT(f.out, Contains("make 1: node"));
      CHECK(f.out.find(" \n") == std::string::npos);
    }
  }
}

TEST_CASE("contct run --node selects a node by number or by x, and refuses an unknown node") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  for (const char* node : {"2", "x = 1", "x=1.0"})
    CHECK_THAT(contct_program(dir.path(), {"run", "pb.toml", "--quiet", "--csv", "-", "--node", node}).out,
               Contains(",2,-0.00125") && Contains(",2,-0.00151162790"));
  CHECK_THAT(contct_program(dir.path(), {"run", "pb.toml", "--quiet", "--csv", "-"}).out,
             Contains(",3,-0.004") && Contains(",3,-0.00483720930"));
  for (const char* node : {"0", "4", "x = 0.5", "x", "three"}) {
    const finished f = contct_program(dir.path(), {"run", "pb.toml", "--csv", "run.csv", "--node", node});
    CHECK(f.exit == 2);
    CHECK_THAT(f.err,
               Contains("--node: found") &&
                   Contains("a node from 1 to 3, or x = .. with the coordinate of a node, from 0 to 2"));
  }
  CHECK(dir.files() == std::vector<std::string>{"pb.toml"});
}

TEST_CASE("on a terminal of 40 columns, the events of an increment are on lines below the increment") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const finished f = contct_program(dir.path(), {"run", "pb.toml", "--kernels", "fortran,cpp"},
                                    {"", {{"COLUMNS", "40"}}, false});
  CHECK_THAT(f.out, Contains("  incr  share      s          kernels\n"
                             "   1.1  0.25       0.25       equal\n"
                             "    make 1: node 3 below\n"
                             "   1.2  1          1          equal\n"
                             "end 1 of 1 in contact; 10+ digits\n"
                             "    certified\n"
                             "    w -0.00483721, node 3, x = 2\n"
                             "    moment -36.2791, node 1, x = 0\n"
                             "    shear 18.1395, node 1, x = 0\n"
                             "    contact force 41.8605, pair 1, node\n"
                             "    3 below\n"
                             "    reaction 18.1395, node 1\n"));
}

TEST_CASE("contct run colours text only on a terminal, and neither with NO_COLOR nor with TERM=dumb") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const auto escapes = [&](const process_options& o) {
    const finished f = contct_program(dir.path(), {"run", "pb.toml"}, o);
    CHECK(f.exit == 0);
    CHECK_THAT(f.out, Contains("equal"));
    return std::count(f.out.begin(), f.out.end(), '\033');
  };
  CHECK(escapes({"", {{"TERM", "xterm"}}, true}) > 0);
  CHECK(escapes({"", {{"TERM", "xterm"}}, false}) == 0);
  CHECK(escapes({"", {{"TERM", "xterm"}, {"NO_COLOR", "1"}}, true}) == 0);
  CHECK(escapes({"", {{"TERM", "dumb"}}, true}) == 0);
}

TEST_CASE("contct run reads a problem from standard input and writes only the result to standard output") {
  const scratch_folder dir;
  const finished f = contct_program(dir.path(), {"run", "-", "--json", "-"}, {good_problem, {}, false});
  CHECK(f.exit == 0);
  const auto result = nlohmann::json::parse(f.out);
  CHECK(result["status"] == "solved");
  CHECK(dir.files().empty());
}

TEST_CASE(
    "contct run --log writes unit 26 of the leading kernel, and the file is the same for FORTRAN and C++") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  CHECK(contct_program(dir.path(), {"run", "pb.toml", "--kernels", "fortran", "--log", "fortran.log"}).exit ==
        0);
  CHECK(contct_program(dir.path(), {"run", "pb.toml", "--kernels", "cpp", "--log", "cpp.log"}).exit == 0);
  CHECK(dir.read("fortran.log") ==
        "  ******* MAKING CONTACT ********\n"
        "   CONTACT PAIR:   1 NODE:   3 SURFACE:  -1 SCALE FACTOR =  0.2500E+00\n"
        "  NO EVENTS. RETURNING. SCALE FACTOR =  0.100E+01\n");
  CHECK(dir.read("cpp.log") == dir.read("fortran.log"));
}

TEST_CASE(
    "if the structure becomes a mechanism, contct run names the pair that separated, with exit status 4") {
  const scratch_folder dir;
  dir.write("freed.toml", freed);
  const finished f = contct_program(dir.path(), {"run", "freed.toml", "--json", "out.json"});
  CHECK(f.exit == 4);
  CHECK_THAT(f.err, Contains("step 1") &&
                        Contains("when pair 1 (node 2, below) separated, the structure became a mechanism"));
  const auto result = nlohmann::json::parse(dir.read("out.json"));
  CHECK(result["status"] == "mechanism");
  // About pair 2 the moment 6 f of the load at node 5 exceeds 4 f at node 3, so pair 1 lifts at any share f.
  CHECK(result["steps"][0]["fraction"].get<double>() < 1e-9);
}

TEST_CASE("contct run that reaches --max-increments has exit status 5, and the JSON result names the limit") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const finished f = contct_program(dir.path(), {"run", "pb.toml", "--kernels", "fortran,cpp",
                                                 "--max-increments", "1", "--json", "out.json"});
  CHECK(f.exit == 5);
  CHECK_THAT(f.err, Contains("limit of increments"));
  CHECK(nlohmann::json::parse(dir.read("out.json"))["status"] == "iteration-limit");
}

TEST_CASE("contct run with a single kernel makes no comparison, and does not report equality") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const finished f =
      contct_program(dir.path(), {"run", "pb.toml", "--kernels", "fortran-r4", "--json", "out.json"});
  CHECK(f.exit == 0);
  CHECK(f.out.find("equal") == std::string::npos);
  CHECK(nlohmann::json::parse(dir.read("out.json"))["lockstep"].is_null());
}

TEST_CASE(
    "in a free run each kernel follows its own path, and single precision is compared with a larger bound") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const finished f = contct_program(dir.path(), {"run", "pb.toml", "--free-run", "--kernels",
                                                 "fortran,cpp,fortran-r4,cpp-r4", "--json", "out.json"});
  CHECK(f.exit == 0);
  CHECK_THAT(f.out, Contains("cpp in free run: the same events") && Contains("bound 1e-09") &&
                        Contains("bound 1e-04"));
  const auto result = nlohmann::json::parse(dir.read("out.json"));
  CHECK(result["lockstep"].is_null());
  REQUIRE(result["free_run"].size() == 3);
  CHECK(result["free_run"][0]["displacement"] == 0.0);
  CHECK(result["free_run"][1]["displacement"] > 0.0);
}

TEST_CASE("contct run --free-run has exit status 1 if the share of an event differs by more than the bound") {
  // Step 1 ends with the node 1e-5 before its face, and step 2 with the node 1e-5 beyond the face. Single
  // precision cannot resolve the share at which the node reaches the face.
  const scratch_folder dir;
  dir.write("near.toml",
            "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
            "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1\nstiffness = 1e-3\n"
            "[[step]]\npoint = [ { node = 2, w = -2.99997 } ]\n"
            "[[step]]\npoint = [ { node = 2, w = -3.00003 } ]\n");
  const finished f =
      contct_program(dir.path(), {"run", "near.toml", "--free-run", "--kernels", "fortran,fortran-r4",
                                  "--json", "out.json", "--log", "out.log"});
  INFO(f.out << f.err);
  CHECK(f.exit == 1);
  CHECK_THAT(f.out, Contains("the same events"));
  CHECK_THAT(f.err, Contains("fortran-r4: a share of the step differs by") && Contains("allowed: 1e-04"));
  CHECK_THAT(f.err, !Contains("first difference"));
  CHECK(nlohmann::json::parse(dir.read("out.json"))["status"] == "kernels-disagree");
  CHECK_THAT(dir.read("out.log"), Contains("MAKING"));
}

TEST_CASE("contct kernels prints the listing's checksum and the result of the floating-point probe") {
  const scratch_folder dir;
  const finished kernels = contct_program(dir.path(), {"kernels"});
  CHECK(kernels.exit == 0);
  CHECK_THAT(kernels.out, Contains("fortran-r4") && Contains("cpp") && Contains("floating point: strict"));
  const finished version = contct_program(dir.path(), {"--version"});
  CHECK(version.exit == 0);
  const std::string checksum = version.out.substr(version.out.find("sha256") + 7, 64);
  CHECK(checksum.find_first_not_of("0123456789abcdef") == std::string::npos);
  CHECK_THAT(kernels.out, Contains(checksum));
}

TEST_CASE(
    "contct run --strict has exit status 3 for an uncertified state, and the message names the early "
    "toggle") {
  const scratch_folder dir;
  const std::string pb5 = CONTCT_ROOT "/reference/problems/pb05-cantilever-over-flat-obstacle.toml";
  CHECK(contct_program(dir.path(), {"run", pb5, "--kernels", "fortran,cpp"}).exit == 0);
  const finished strict =
      contct_program(dir.path(), {"run", pb5, "--kernels", "fortran,cpp", "--strict", "--json", "s.json"});
  CHECK(strict.exit == 3);
  CHECK_THAT(strict.out,
             Contains("step 4 is NOT certified: the deflections are off by 1.2e-08, 0.00012 % of the"));
  CHECK_THAT(strict.err, Contains("in increment 4.2 pair 1 (node 41, below) broke contact"));
  CHECK_THAT(strict.err,
             Contains("contct run " + pb5 + " --kernels corrected"));  // the suggested command
  const auto r = nlohmann::json::parse(dir.read("s.json"));
  CHECK(r["status"] == "solved");
  CHECK(r["steps"][0]["certificate"]["exact"] == true);
  CHECK(r["steps"][3]["certificate"]["exact"] == false);
  CHECK(contct_program(dir.path(), {"run", pb5, "--strict", "--kernels", "corrected"}).exit == 0);
}

TEST_CASE(
    "contct run uses the engine refactor if a 1989 kernel leads, and the fastest engine for the corrected "
    "rule") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const auto engine_of = [&dir](std::vector<std::string> more) {
    more.insert(more.begin(), {"run", "pb.toml", "--json", "-"});
    const finished f = contct_program(dir.path(), more);
    INFO(f.err);
    CHECK(f.exit == 0);
    const auto result = nlohmann::json::parse(f.out);
    CHECK(result["engine_work"]["factors"] >= 1);
    return result["engine"].get<std::string>();
  };
  CHECK(engine_of({"--kernels", "fortran,cpp"}) == "refactor");
  CHECK(engine_of({}) == "condensed");
  CHECK(engine_of({"--kernels", "corrected"}) == "condensed");
  CHECK(engine_of({"--engine", "auto"}) == "condensed");
  CHECK(engine_of({"--engine", "updated"}) == "updated");
  CHECK(engine_of({"--kernels", "corrected", "--engine", "refactor"}) == "refactor");
  dir.write("plate.toml",
            "[plate]\nsize = [1, 1]\nelements = [2, 2]\nD = 1\nnu = 0.3\n[[bed]]\nmodulus = 4\nface = 0\n"
            "[[step]]\nuniform = -1\n");
  const finished plate =
      contct_program(dir.path(), {"run", "plate.toml", "--kernels", "corrected", "--json", "-"});
  CHECK(nlohmann::json::parse(plate.out)["engine"] == "updated");
  const finished unsuited = contct_program(dir.path(), {"run", "plate.toml", "--engine", "condensed"});
  CHECK(unsuited.exit == 2);
  CHECK_THAT(unsuited.err, Contains("allowed: a beam with pairs"));
  const finished unknown = contct_program(dir.path(), {"run", "pb.toml", "--engine", "warp"});
  CHECK(unknown.exit == 2);
  CHECK_THAT(unknown.err, Contains("no engine is named \"warp\"") && Contains("condensed"));
}

TEST_CASE("contct run --final-only gives certified final states without following the path") {
  const scratch_folder dir;
  const std::string pb5 =
      std::string(CONTCT_ROOT) + "/reference/problems/pb05-cantilever-over-flat-obstacle.toml";
  const finished path = contct_program(dir.path(), {"run", pb5, "--kernels", "corrected", "--json", "-"});
  const finished end = contct_program(dir.path(), {"run", pb5, "--final-only", "--json", "-"});
  REQUIRE(path.exit == 0);
  REQUIRE(end.exit == 0);
  const auto by_path = nlohmann::json::parse(path.out);
  const auto at_once = nlohmann::json::parse(end.out);
  CHECK(at_once["engine"] == "reference");
  CHECK(at_once["kernels"].empty());
  CHECK(at_once["lockstep"].is_null());
  REQUIRE(at_once["steps"].size() == by_path["steps"].size());
  int compared = 0;
  for (std::size_t step = 0; step < by_path["steps"].size(); ++step) {
    const auto& a = by_path["steps"][step];
    const auto& b = at_once["steps"][step];
    CHECK(b["increments"].empty());
    CHECK(b["certificate"]["exact"] == true);
    CHECK(b["certificate"]["independent"] == false);  // the state is the reference solution itself
    CHECK(a["certificate"]["independent"] == true);
    for (std::size_t node = 0; node < a["w"].size(); ++node) {
      CHECK(a["w"][node].get<double>() == Approx(b["w"][node].get<double>()).epsilon(1e-9).margin(1e-11));
      ++compared;
    }
    for (std::size_t pair = 0; pair < a["pairs"].size(); ++pair)
      CHECK(a["pairs"][pair]["state"] == b["pairs"][pair]["state"]);
  }
  CHECK(compared == 6 * 41);
  CHECK(at_once["engine_work"]["factors"] <= 40);  // the path has 55 increments
  CHECK_THAT(contct_program(dir.path(), {"run", pb5, "--final-only"}).out,
             Contains("all 6 final states are certified") && Contains("proved: 10 digits or more"));

  dir.write("freed.toml", freed);
  const finished none = contct_program(dir.path(), {"run", "freed.toml", "--final-only"});
  CHECK(none.exit == 4);
  CHECK_THAT(none.err, Contains("no equilibrium"));
}
