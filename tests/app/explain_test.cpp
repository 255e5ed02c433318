// Tests the text and the JSON of `contct explain`.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "app/process.hpp"
#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/kernel/call.hpp"
#include "read/bad_inputs.hpp"

using namespace contct;
using Catch::Matchers::Contains;

namespace {

using json = nlohmann::json;
const std::string pb7 = "reference/problems/pb07-three-gap-supports.toml";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

finished explained(const std::vector<std::string>& more, const char* columns = "80") {
  std::vector<std::string> arguments = {"explain"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return contct_program(root, arguments, {"", {{"COLUMNS", columns}}});
}

/// Returns the 1989 rule's answer in exact arithmetic for the values of a call.
listing_answer answer_of(const json& pairs) {
  const auto number = [](const json& x) { return binary_value(x.get<double>()); };
  std::vector<listing_pair> all;
  for (const json& p : pairs)
    all.push_back({number(p["c"]), number(p["d"]), number(p["d_star"]), p["before"] == "contact",
                   p["surface"] == "above" ? face_above : face_below});
  return answer_exactly(all);
}

/// Returns the distance from |x| to the next larger number.
template <class Real>
Real ulp_of(Real x) {
  return std::nextafter(std::abs(x), std::numeric_limits<Real>::infinity()) - std::abs(x);
}

}  // namespace

TEST_CASE(
    "contct explain describes an increment pair by pair, with the listing's lines and the paper's "
    "equations") {
  const scratch_folder dir;
  dir.write("pb.toml", good_problem);
  const finished f = contct_program(dir.path(), {"explain", "pb.toml"});
  INFO(f.out << f.err);
  CHECK(f.exit == 0);
  CHECK(f.err.empty());
  CHECK_THAT(f.out,
             Contains("Step 1, increment 1\n"
                      "-------------------\n"
                      "The residual load leads from w 0 at node 3 to w -60 at node 3.\n"
                      "\n"
                      "Pair 1, node 3, face below, separated: advancing\n"
                      "  30  GAP = c - D = -0.004 - (0) = -0.004                                    (5)\n"
                      "  31  d* = -0.016, not 0: the pair responds.\n"
                      "  33  |GAP| is not less than EPSGAP = 1E-10: not stationary.\n"
                      "  38  s = GAP / d* = 0.25. Advancing: it touches its face at 25 % of the\n"
                      "      residual load.                                                         (4)\n"
                      "  40  0 < s < SMIN = 1: SMIN becomes s; this pair leads.                     (9)\n"));
  CHECK_THAT(f.out,
             Contains("\nThe smallest s\n"
                      "  42  SMIN = 0.25, not 1. Pair 1 wins.                                       (9)\n"
                      "      No other pair has an event to come.\n"));
  CHECK_THAT(f.out, Contains("\nPair 1: winner\n"
                             "  51  DIFF = 0: s is SMIN.\n"
                             "  52  DIFF is less than EPSMUL = 1/256: toggled.\n"
                             "  54  ISEP = 1: it was separated.\n"
                             "  55  ISEP = -1: in contact. Make.\n"));
  CHECK_THAT(f.out, Contains("0.25 of the residual load is applied: D + s d* is the new D (10)."));
  CHECK_THAT(f.out, Contains("  42  SMIN is still 1: no pair has an event."));
  CHECK_THAT(f.out, Contains("fortran and cpp are equal to the bit in the whole run"));
}

TEST_CASE("contct explain names both dofs of a pair between two dofs of a matrix") {
  const finished f =
      explained({"reference/problems/pb15-two-beams.toml", "--increment", "1.1", "--quiet", "--json", "-"});
  CHECK(f.exit == 0);
  const json pair = json::parse(f.out)["increments"].at(0)["pairs"].at(0);
  CHECK(pair["dof"] == "left.y");
  CHECK(pair["other"] == "right.y");
}

TEST_CASE("contct explain wraps lines at the width of the terminal, from 40 to 160 columns") {
  for (const char* columns : {"40", "59", "80", "119", "160"}) {
    const finished f = explained({pb7, "--increment", "2.1"}, columns);
    INFO(columns << " columns\n" << f.out);
    CHECK(f.exit == 0);
    for (const std::string& line : lines_of(f.out)) CHECK(line.size() <= std::stoul(columns));
    CHECK(f.out.find(" \n") == std::string::npos);
  }
}

TEST_CASE(
    "contct explain --step, --increment and --pair limit the explanation to a step, an increment or a pair") {
  const auto count = [](const std::string& text, const char* piece) {
    std::size_t n = 0;
    for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
    return n;
  };
  CHECK(count(explained({pb7}).out, ", increment ") == 8);
  CHECK(count(explained({pb7, "--step", "4"}).out, ", increment ") == 3);
  CHECK(count(explained({pb7, "--increment", "2"}).out, ", increment ") == 3);
  const finished one = explained({pb7, "--increment", "4.2", "--pair", "3"});
  CHECK(count(one.out, ", increment ") == 1);
  CHECK(count(one.out, "Step 4, increment 2\n") == 1);
  CHECK(count(one.out, ", node ") == 1);
  CHECK_THAT(one.out, Contains("Pair 3, node 13, face below, in contact: receding"));
  CHECK_THAT(one.out, Contains("58  ISEP = 1: separated. Break."));
  CHECK(explained({pb7, "--increment", "2", "--step", "4", "--pair", "3"}).out == one.out);
}

TEST_CASE(
    "contct explain refuses a step, increment or pair out of range with exit status 2, and writes no file") {
  const scratch_folder dir;
  const std::string out = (dir.path() / "out.json").string();
  const auto refused = [&](std::vector<std::string> arguments, const char* words) {
    arguments.insert(arguments.end(), {"--json", out});
    const finished f = explained(arguments);
    INFO(f.err);
    CHECK(f.exit == 2);
    CHECK(f.out.empty());
    CHECK_THAT(f.err, Contains(words));
    CHECK(dir.files().empty());
  };
  refused({pb7, "--pair", "4"}, "--pair: found 4; allowed: a pair from 1 to 3");
  refused({pb7, "--pair", "0"}, "--pair: found 0; allowed: a pair from 1 to 3");
  refused({pb7, "--step", "5"}, "--step: found 5; allowed: a step from 1 to 4");
  refused({pb7, "--step", "-1"}, "--step: found -1; allowed: a step from 1 to 4");
  refused({pb7, "--increment", "5.1"}, "--step: found 5; allowed: a step from 1 to 4");
  refused({pb7, "--increment", "4"}, "--increment: found 4; allowed: an increment from 1 to 3");
  refused({pb7, "--increment", "1.2"},
          "--increment: found 1.2; allowed: an increment from 1 to 1, in step 1");
  refused({pb7, "--increment", "two"},
          "--increment: found two; allowed: a whole number from 1, or STEP.INCREMENT");
  refused({pb7, "--increment", "0"}, "--increment: found 0");
  refused({pb7, "--increment", "2."}, "--increment: found 2.");
  refused({pb7, "--increment", "2.1", "--step", "3"}, "allowed: the same step");
  refused({pb7, "--kernels", "corrected"}, "has the corrected rule, which is not in the listing");
  refused({pb7, "--kernels", "fortran,corrected"}, "--free-run --kernels corrected,fortran");
  refused({pb7, "--kernels", "fortran,cpp-r4"}, "differ in precision");
  refused({pb7, "--kernels", "cpp,cpp"}, "named twice");
  refused({pb7, "--kernels", "cpp,fortran,cpp"}, "found 3 kernels; allowed: one or two");
  refused({pb7, "--kernels", "pipe:cat"}, "is an external kernel and cannot lead");
  refused({pb7, "--engine", "warp"}, "allowed: auto, refactor, ");
  CHECK(explained({pb7, "--engine", "auto", "--quiet"}).exit == 0);  // explain accepts auto as run does
}

TEST_CASE(
    "if the second kernel rounds differently, contct explain gives the difference in ULPs and exit status "
    "1") {
  const scratch_folder dir;
  const std::string plugin = "plugin:" CONTCT_PLUGINS "/libvariant_reassociated.so";
  const finished f =
      explained({pb7, "--kernels", "fortran," + plugin, "--json", (dir.path() / "out.json").string()});
  INFO(f.err);
  CHECK(f.exit == 1);
  CHECK_THAT(f.out, Contains("ULP") && Contains("NOT"));  // the message may be wrapped at another place
  CHECK_THAT(f.err, Contains("differs in"));
  const json all = json::parse(dir.read("out.json"));
  CHECK(all["status"] == "kernels-disagree");
  CHECK(all["lockstep"]["mismatches"] > 0);
}

TEST_CASE(
    "contct explain describes the increments up to the mechanism that ends the path, with exit status 4") {
  const scratch_folder dir;
  dir.write("freed.toml",
            "[beam]\nx = [0, 1, 2, 3, 4]\nEI = 100\n[[contact]]\nnode = 2\nsurface = \"below\"\nface = "
            "0\nstiffness = 10\n[[contact]]\nnode = 4\nsurface = \"below\"\nface = 0\nstiffness = 10\n"
            "[[step]]\npoint = [ { node = 3, w = -4 }, { node = 5, w = -6 } ]\n");
  const finished f = contct_program(dir.path(), {"explain", "freed.toml", "--json", "out.json"});
  CHECK(f.exit == 4);
  CHECK_THAT(f.err, Contains("separated, the structure became a mechanism"));
  CHECK(json::parse(dir.read("out.json"))["status"] == "mechanism");
  const finished beyond = contct_program(dir.path(), {"explain", "freed.toml", "--increment", "9"});
  CHECK(beyond.exit == 2);
}

TEST_CASE("contct explain writes each increment when the path reaches it, so that memory does not grow") {
  const std::string plate = "reference/problems/pp05c-free-plate-on-bed-n16.toml";
  const finished narrow = explained({plate, "--pair", "1", "--quiet", "--json", "/dev/null"});
  const finished all = explained({plate, "--quiet", "--json", "/dev/null"});
  CHECK(narrow.exit == 0);
  CHECK(all.exit == 0);
  CHECK(all.out.empty());
#if !defined(__SANITIZE_ADDRESS__)
  CHECK(all.peak_kib < narrow.peak_kib + 8L * 1024);  // the run writes about 30 MB of JSON
#endif
}

TEST_CASE(
    "if the driver undoes an event that is caused only by rounding near full load, contct explain reports "
    "this") {
  // When the load is removed, the pairs separate at the end of the step, or by rounding just before the end.
  const scratch_folder dir;
  int undone = 0;
  for (int elements = 4; elements <= 30; elements += 2) {
    for (const char* stiffness : {"1e5", "7.7e5"}) {
      std::ostringstream text;
      text << "[beam]\nlength = 8\nelements = " << elements << "\nEI = 1e5\n[[support]]\nnodes = [1, "
           << elements + 1 << "]\nfix = [\"w\"]\n";
      const int middle = elements / 2 + 1;
      for (const int node : {2, middle, elements})
        text << "[[contact]]\nnode = " << node
             << "\nsurface = \"below\"\nface = 0\nstiffness = " << (node == middle ? "1.3e5" : stiffness)
             << "\nstate = \"separated\"\n";
      dir.write("pb.toml", text.str() + "[[step]]\nuniform = -13.7\n[[step]]\nuniform = 0\n");
      const finished f = contct_program(dir.path(), {"explain", "pb.toml", "--json", "out.json"});
      CHECK(f.exit == 0);
      bool here = false;
      const json all = json::parse(dir.read("out.json"));
      for (const json& i : all["increments"]) {
        if (!i["left_undone"].get<bool>()) continue;
        here = true;
        CHECK(i["s"] == 1.0);
        CHECK(i["fraction"] == 1.0);
        CHECK_FALSE(i["winner"].is_null());
      }
      CHECK((f.out.find("After this event the remaining load would be only rounding") != std::string::npos) ==
            here);
      undone += here ? 1 : 0;
    }
  }
  CHECK(undone >= 1);
}

TEST_CASE(
    "every s of the problems PB1 to PB11 has an error of at most 2 ULP in single and double precision") {
  int compared = 0;
  for (const char* name :
       {"pb01-cantilever-tip-stop", "pb03c-point-load-on-bed-l6-fine", "pb05-cantilever-over-flat-obstacle",
        "pb07-three-gap-supports", "pb08d-heavy-beam-down-50", "pb11a-strip-footing-n20"}) {
    for (const bool is_long : {true, false}) {
      const finished f =
          explained({"reference/problems/" + std::string(name) + ".toml", "--quiet", "--kernels",
                     is_long ? "fortran,cpp" : "fortran-r4,cpp-r4", "--json", "-"});
      REQUIRE(f.exit == 0);
      const json all = json::parse(f.out);
      for (const json& i : all["increments"]) {
        const listing_answer exactly = answer_of(i["pairs"]);
        for (const json& p : i["pairs"]) {
          INFO(name << ' ' << p.dump());
          const std::size_t pair = p["pair"].get<std::size_t>() - 1;
          CHECK(p["toggled"] == (std::ranges::count(exactly.toggled, static_cast<int>(pair)) > 0));
          for (const json& kernel : all["kernels"]) {
            const double s = std::strtod(p["bits"][kernel].get<std::string>().c_str(), nullptr);
            const rational error = binary_value(s) - exactly.s[pair];
            // s is computed by two operations, each of which rounds once.
            CHECK(abs(error) < 2 * binary_value(is_long ? ulp_of(s) : ulp_of(static_cast<float>(s))));
            ++compared;
          }
        }
      }
    }
  }
  CHECK(compared > 10'000);
}

TEST_CASE(
    "contct explain TRACE describes a call of the trace, and shows the faulty line of a kernel that "
    "differs") {
  const std::string plugin = "plugin:" + std::string(CONTCT_PLUGINS) + "/libvariant_less_equal.so";
  const finished f =
      explained({"reference/traces/ties.trace", "--increment", "4", "--kernels", "fortran," + plugin});
  INFO(f.out << f.err);
  CHECK(f.exit == 1);
  CHECK_THAT(f.out, Contains("\nCall 4: ") && Contains("\nPair 2, node 2") && !Contains("\nCall 5"));
  CHECK_THAT(f.out, Contains("IF (DIFF.LT.EPSMUL) was false, exactly on the threshold"));
  CHECK_THAT(f.err, Contains("the trace kept ISEP; " + plugin + " took line 55, ISEP(I) = -1"));
  CHECK_THAT(f.err, Contains("at fault: line 52, IF (DIFF.LT.EPSMUL) THEN: explains all"));
  CHECK_THAT(f.err, Contains("known fault: A DIFF of exactly EPSMUL is not toggled: DIFF < EPSMUL, not <=."));
}

TEST_CASE(
    "contct explain TRACE finds no difference in a trace of the listing, and refuses the option --json") {
  const finished f = explained({"reference/traces/ties-r4.trace", "--increment", "1", "--pair", "1"});
  CHECK(f.exit == 0);
  CHECK_THAT(f.out,
             Contains("fortran-r4 gives the answers of the trace, to the bit") && !Contains("Pair 2, node"));
  CHECK(explained({"reference/traces/ties.trace", "--json", "-"}).exit == 2);
  const finished beyond = explained({"reference/traces/ties.trace", "--increment", "999"});
  CHECK(beyond.exit == 2);
  CHECK_THAT(beyond.err, Contains("--increment: found 999; allowed: the number of a call"));
}
