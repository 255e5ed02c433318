// Tests `contct run`: its table, its result, its messages and its exit status.
#include <sstream>

#include "app/process.hpp"
#include "catch.hpp"
#include "read/good_problem.hpp"

using namespace contct;

namespace {

const std::string near_tie = "@problems/divergences/near-tie.toml";
const std::string pb5 = "@problems/pb05-cantilever-over-flat-obstacle.toml";

const std::string mtx = "%%MatrixMarket matrix coordinate real symmetric\n";

}  // namespace

TEST_CASE("the table of contct run has share, s, load, events, extremes and the comparison of kernels") {
  const workplace here({{"pb.toml", good_problem}});
  here.check("run pb.toml --kernels fortran,cpp", 0,
             {"1.1  0.25", "equal    w -15 at node 3    make 1: node 3 below",
              "   end  1 of 1 in contact; 10+ digits; certified\n"
              "        w             -0.00483721       node 3, x = 2\n"
              "        moment        -36.2791          node 1, x = 0\n"
              "        shear         18.1395           node 1, x = 0\n"
              "        contact force 41.8605           pair 1, node 3 below\n"
              "        reaction      18.1395           node 1\n"
              "        sums          loads -60, reactions 18.1395, contact 41.8605\n",
              "fortran and cpp are equal to the bit; 2 calls, 8 values compared, 0 mismatches"});
  CHECK(here.files() == texts{"pb.toml"});  // no fort.26
  here.check("run pb.toml --kernels fortran,cpp", 0,
             {"  incr  share      s          kernels\n"
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
              "    reaction 18.1395, node 1\n"},
             {}, {"", {{"COLUMNS", "40"}}});
}

TEST_CASE("without --kernels, contct run gives the corrected answer and compares the 1989 rule") {
  const workplace here;
  here.check("run " + near_tie + " --strict --json o.json", 0,
             {"kernels corrected, fortran, cpp; engine condensed\n",
              "  incr  share      s          1989     load               events\n",
              "0.25       same     w -15 at node 3    make 1: node 3 below\n",
              "0.0119444  other    w -15.5375         make 2: node 3 below\n" + std::string(58, ' ') +
                  "1989: make 2 at 0.25\n",
              "fortran and cpp are equal to the bit; 7 calls, 42 values compared",
              "the 1989 rule is wrong in step 2: the deflection of node 3 is 0.000133333\n"
              "instead of 0: off by 0.000133, 3 % of the largest of its kind\n",
              "both final states are certified"});
  const auto r = here.json("o.json");
  check_like(r, R"({"kernels": ["corrected", "fortran", "cpp"], "certified": true, "lockstep": {"calls": 7},
      "rule_1989": {"same_events": false, "wrong_steps": {"1": {"step": 2, "quantity": "w",
      "value": 0.00013333333333333, /* 0.5 L^3 / 3 EI */ "right": 0}}}})");
  CHECK(r["lockstep"] == r["rule_1989"]["lockstep"]);
}

TEST_CASE("contct run --refine reports no change for a beam without a bed, and doubles the pairs of a bed") {
  const workplace here({{"pb.toml", good_problem}});
  here.check(
      "run pb.toml --refine --json o.json", 0,
      {"half the element size changes the deflection by ", " % of 0.00", "beams are exact between nodes"});
  // The pressures of 20 and 40 elements, 3.327786 and 3.312101, follow from w at the edge in
  // reference/verification.toml.
  here.check("run @problems/pb11a-strip-footing-n20.toml --kernels corrected --refine", 0,
             {"        sums          loads -1, reactions 0, contact 1\n"
              "        bed 1         force 1, pressure 0 to 3.3121, largest at node 1, x = 0;\n"
              "        0.625 in contact\n",
              "the largest pressure of the bed by 0.0157 (0.47 % of 3.328)", "the changes come from the bed"},
             {"^"});
  check_like(here.json("o.json"), R"({"refined": {"w": {}, "force": {}, "shear": {}, "reaction": {},
      "moment": {"of": 36.2790697674, "change": "< 1e-11"}}})");
}

TEST_CASE("no line of contct run or contct explain is wider than the terminal, from 40 to 160 columns") {
  const std::string busy =
      "title = 'A beam of a long name, with which the narrowest of all terminals has its trouble'\n[beam]\n"
      "length = 2000\nelements = 2000\nEI = 1e9\n[[support]]\nnodes = [1, 2001]\nfix = ['w']\n[[contact]]\n"
      "nodes = '990..1010'\nsurface = 'below'\nface = -1e-5\nstiffness = 1e-9\n[[step]]\nuniform = -1e-6\n"
      "[[step]]\nuniform = 1e-6\n";
  const workplace here({{"busy.toml", busy}, {"pb.toml", good_problem}});
  for (const std::string columns : {"40", "59", "60", "80", "119", "120", "160"}) {
    for (const auto& [line, words] :
         {std::pair("run pb.toml", "make 1: node"),
          {"run busy.toml", "make 1: node"},
          {"run @problems/pb07-three-gap-supports.toml", "make 1: node"},
          {"explain @problems/pb07-three-gap-supports.toml --increment 2.1", "Step 2, increment 1"}}) {
      const finished f = here.contct(line, {"", {{"COLUMNS", columns}}});
      INFO(columns << " columns\n" << f.out << f.err);
      CHECK(f.exit == 0);
      std::istringstream lines(f.out);
      for (std::string text; std::getline(lines, text);) CHECK(text.size() <= std::stoul(columns));
      check_words(f.out, {words, "! \n"});
    }
  }
}

TEST_CASE("contct run --node selects a node by number or by x, and by default the node of the first pair") {
  const workplace here({{"pb.toml", good_problem}});
  const std::string csv = "run pb.toml --quiet --csv -";
  here.check(csv, 0, {",3,-0.004", ",3,-0.00483720930"});
  for (const std::string node : {"2", "'x = 1'", "x=1.0"})
    here.check(csv + " --node " + node, 0, {",2,-0.00125", ",2,-0.00151162790"});
}

TEST_CASE("contct run colours text only on a terminal, and only errors of the answer are red") {
  const workplace here({{"pb.toml", good_problem}});
  const process_options terminal{"", {{"TERM", "xterm"}}, true};
  const std::string red = "\033[1;31m";
  here.check("run pb.toml", 0, {"equal", "\033"}, {}, terminal);
  here.check("run " + near_tie, 0, {"!" + red}, {}, terminal);
  here.check("run " + near_tie + " --kernels fortran,cpp", 0, {red}, {"^"}, terminal);
  here.check("run pb.toml", 0, {"equal", "!\033"}, {}, {"", {{"TERM", "xterm"}}});
  here.check("run pb.toml", 0, {"equal", "!\033"}, {}, {"", {{"TERM", "xterm"}, {"NO_COLOR", "1"}}, true});
  here.check("run pb.toml", 0, {"equal", "!\033"}, {}, {"", {{"TERM", "dumb"}}, true});
}

TEST_CASE("contct run --log and --trace write unit 26 and the calls of the leading 1989 kernel") {
  const workplace here({{"pb.toml", good_problem}});
  std::vector<std::string> calls;
  for (const std::string kernels : {"--kernels fortran", "--kernels cpp", ""}) {
    here.check("run pb.toml --quiet --trace t --log l " + kernels, 0);
    CHECK(here.read("l") ==
          "  ******* MAKING CONTACT ********\n"
          "   CONTACT PAIR:   1 NODE:   3 SURFACE:  -1 SCALE FACTOR =  0.2500E+00\n"
          "  NO EVENTS. RETURNING. SCALE FACTOR =  0.100E+01\n");
    const std::string trace = here.read("t");
    calls.push_back(trace.substr(trace.find("\ncall ")));
  }
  CHECK((calls[1] == calls[0] && calls[2] == calls[0]));
}

TEST_CASE("a path that ends early has exit status 4 or 5, and message and JSON result name the cause") {
  const workplace here({{"freed.toml", freed},
                        {"pb.toml", good_problem},
                        {"loose.toml",
                         "[beam]\nx = [0, 1]\nEI = 1\n[[contact]]\nnode = 1\nsurface = 'below'\nface = -1\n"
                         "stiffness = 1\n[[step]]\nuniform = -1\n"}});
  here.check("run freed.toml --json freed.json", 4, {},
             {"step 1", "when pair 1 (node 2, below) separated, the structure became a mechanism"});
  here.check("run freed.toml --final-only", 4, {}, {"no equilibrium"});
  here.check("run pb.toml --kernels fortran,cpp --max-increments 1 --json short.json", 5, {},
             {"limit of increments"});
  here.check("run loose.toml", 4,
             {"fortran and cpp were never called, so nothing was compared", "!equal to the bit"});
  // About pair 2 the moment 6 f of the load at node 5 exceeds 4 f at node 3, so pair 1 lifts at any share f.
  check_like(here.json("freed.json"), R"({"status": "mechanism", "steps": [{"fraction": "< 1e-9"}]})");
  CHECK(here.json("short.json")["status"] == "iteration-limit");
}

TEST_CASE("contct run --free-run compares kernels on their own paths, and one kernel with none") {
  const workplace here(
      {{"pb.toml", good_problem},
       // Step 1 ends with the node 1e-5 before its face, and step 2 with the node 1e-5 beyond the face.
       // Single precision cannot resolve the share at which the node reaches the face.
       {"near.toml",
        "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = ['w', 'theta']\n[[contact]]\nnode = 2\n"
        "surface = 'below'\nface = -1\nstiffness = 1e-3\n[[step]]\npoint = [ { node = 2, w = -2.99997 } ]\n"
        "[[step]]\npoint = [ { node = 2, w = -3.00003 } ]\n"}});
  here.check("run pb.toml --kernels fortran-r4 --json one.json", 0, {"!equal"});
  here.check("run pb.toml --free-run --kernels fortran,cpp,fortran-r4,cpp-r4 --json free.json", 0,
             {"cpp in free run: the same events", "bound 1e-09", "bound 1e-04"});
  here.check("run near.toml --free-run --kernels fortran,fortran-r4 --json near.json --log near.log", 1,
             {"the same events"},
             {"fortran-r4: a share of the step differs by", "allowed: 1e-04", "!first difference"});
  CHECK(here.json("one.json")["lockstep"].is_null());
  check_like(here.json("free.json"), R"({"lockstep": null, "free_run": [{"displacement": 0,
      "fraction": 0}, {"displacement": "> 0", "within_bound": true}, {}]})");
  CHECK(here.json("near.json")["status"] == "kernels-disagree");
  check_words(here.read("near.log"), {"MAKING"});
}

TEST_CASE("contct run --strict has exit status 3 for an uncertified state, and names the early toggle") {
  const workplace here;
  const std::string both = "run " + pb5 + " --kernels fortran,cpp";
  here.check(both, 0, {}, {"pair 1"});
  here.check(both + " --strict --json s.json", 3,
             {"step 4 is NOT certified: a slope may be off by 0.00017, 0.92 % of the largest of"},
             {"in increment 4.2 pair 1 (node 41, below) broke contact",
              "contct run " + words_of(pb5)[0] + " --kernels corrected"});
  here.check("run " + pb5 + " --strict --kernels corrected", 0, {}, {"^"});
  here.check(both + " --strict --quiet --junit -", 3,
             {"tests=\"3\" failures=\"1\"", "name=\"certificate\"", "NOT certified", "listing sha256"},
             {"certified"});
  check_like(here.json("s.json"), R"({"status": "solved", "steps": {"0": {"certificate": {"certified": true}},
      "3": {"certificate": {"certified": false}}}})");
}

TEST_CASE("contct run uses the engine refactor if a 1989 kernel leads, and otherwise the fastest engine") {
  const workplace here({{"pb.toml", good_problem},
                        {"plate.toml",
                         "[plate]\nsize = [1, 1]\nelements = [2, 2]\nD = 1\nnu = 0.3\n"
                         "[[bed]]\nmodulus = 4\nface = 0\n[[step]]\nuniform = -1\n"}});
  for (const auto& [arguments, engine] : {std::pair("pb.toml --kernels fortran,cpp", "refactor"),
                                          {"pb.toml", "condensed"},
                                          {"pb.toml --kernels corrected", "condensed"},
                                          {"pb.toml --engine auto", "condensed"},
                                          {"pb.toml --engine updated", "updated"},
                                          {"pb.toml --kernels corrected --engine refactor", "refactor"},
                                          {"plate.toml --kernels corrected", "updated"}}) {
    const auto result = here.printed_json("run --json - " + std::string(arguments));
    INFO(arguments);
    check_like(result, {{"engine", engine}, {"engine_work", {{"factors", ">= 1"}}}});
  }
}

TEST_CASE("contct run --final-only gives certified final states without following the path") {
  const workplace here;
  const auto by_path = here.printed_json("run " + pb5 + " --kernels corrected --json -")["steps"];
  const auto at_once = here.printed_json("run " + pb5 + " --final-only --json -");
  // The path has 55 increments.
  check_like(at_once, R"({"engine": "reference", "kernels": [], "lockstep": null,
      "engine_work": {"factors": "<= 40"}})");
  REQUIRE(at_once["steps"].size() == by_path.size());
  int compared = 0;
  for (std::size_t step = 0; step < by_path.size(); ++step) {
    const auto& a = by_path[step];
    const auto& b = at_once["steps"][step];
    check_like(b, R"({"increments": [], "certificate": {"certified": true, "independent": false}})");
    CHECK(a["certificate"]["independent"] == true);  // and the other state is the reference solution itself
    for (std::size_t node = 0; node < a["w"].size(); ++node, ++compared)
      CHECK(a["w"][node].get<double>() == Approx(b["w"][node].get<double>()).epsilon(1e-9).margin(1e-11));
    for (std::size_t pair = 0; pair < a["pairs"].size(); ++pair)
      CHECK(a["pairs"][pair]["state"] == b["pairs"][pair]["state"]);
  }
  CHECK(compared == 6 * 41);
  here.check("run " + pb5 + " --final-only", 0,
             {"all 6 final states are certified", "proved: 10 digits or more"}, {"^"});
}

TEST_CASE("if only the 1989 rule loses its path, contct run reports no mechanism and solves the problem") {
  // A pivoted beam lies on a stop below, and is then lifted onto a stop above.
  const workplace here(
      {{"p.toml",
        "[beam]\nx = [0, 1, 2]\nEI = 1000\n[[support]]\nnode = 1\nfix = 'w'\n"
        "[[contact]]\nnode = 2\nsurface = 'below'\nface = 0\nstiffness = 1e4\n"
        "[[contact]]\nnode = 3\nsurface = 'above'\nface = 0.01\nstiffness = 1e4\n"
        "[[step]]\npoint = [ { node = 3, w = -10 } ]\n[[step]]\npoint = [ { node = 3, w = 10 } ]\n"}});
  here.check("run p.toml --kernels fortran,cpp --json lost.json", 5, {},
             {"step 2, at share 0.5 of its load: the path ended: when pair 1", "There is an equilibrium",
              "--kernels corrected", "!no equilibrium"});
  here.check("run p.toml --kernels corrected", 0);
  here.check("exact p.toml --rule 1989", 5, {"!no equilibrium"}, {"!no equilibrium"});
  here.check("run p.toml --strict --json o.json", 0,
             {"the path of the 1989 rule ends early", "There is an equilibrium", "  ended    "});
  check_like(here.json("lost.json"), R"({"status": "path-ended", "end": {"reason": "path ended"}})");
  check_like(here.json("o.json"),
             R"({"status": "solved", "rule_1989": {"status": "path-ended", "wrong_steps": []}})");
}

TEST_CASE("a spring softer than rounding is no mechanism, and free_motions = 0 gives the exact answer") {
  const std::string problem =
      "[[support]]\ndof = '1'\nspring = 1e-13\n[[contact]]\ndof = '1'\n"
      "surface = 'below'\nface = -0.0396\nstiffness = 5.16e+04\n[[step]]\n"
      "point = [ { dof = '3', value = -0.556 } ]\n[[step]]\npoint = [ { dof = '2', value = -0.113 } ]\n";
  const std::string matrix = "[matrix]\nstiffness = 'K.mtx'\n";
  const workplace here({{"K.mtx", mtx + "3 3 6\n1 1 13\n2 1 2\n2 2 1\n3 1 4\n3 2 -1\n3 3 5\n"},
                        {"p.toml", matrix + problem},
                        {"known.toml", matrix + "free_motions = 0\n" + problem}});
  here.check("run p.toml --strict", 3, {},
             {"1 motion is nearly free: its stiffness is 3e-15 of the largest; set "
              "free_motions = 1, or 0 if",
              "!no equilibrium"});
  for (const std::string how : {"--kernels=corrected", "--final-only", "--kernels=fortran"}) {
    const bool in_doubles = how.ends_with("fortran");  // one digit is right, and nothing is certified
    here.check("run known.toml --json o.json " + how, 0, {"!no equilibrium"}, {"!no equilibrium"});
    const double exactly = -13842500000000.141;  // -11074000000000113 / 800
    check_like(here.json("o.json")["steps"][1]["displacement"][1], exactly, in_doubles ? 0.1 : 1e-15);
  }
}

TEST_CASE("contct names combinations without an equilibrium, solves the others, and has exit status 4") {
  const workplace here(
      {{"p.toml",
        "[beam]\nx = [0, 1, 2]\nEI = 1000\n[[contact]]\nx = [0, 2]\nsurface = 'below'\nface = 0\n"
        "stiffness = 1e4\n[[case]]\nname = 'down'\nuniform = -1\n[[combination]]\nname = 'lifts'\n"
        "terms = { down = -1 }\n[[combination]]\nname = 'rests'\nterms = { down = 1.5 }\n[[combination]]\n"
        "name = 'flies'\nterms = { down = -2 }\n"}});
  for (const std::string line :
       {"run p.toml --json o.json", "exact p.toml", "run p.toml --final-only --json f.json"})
    here.check(line, 4, {"rests"},
               {"combination \"lifts\"", "combination \"flies\"", "!\"rests\", at share"});
  check_like(here.json("o.json")["steps"], R"({"1": {"pairs": {"0": {"force": 1.5}}}})");
  check_like(here.json("f.json"),
             R"({"end": {"step": 1}, "steps": [{"step": 2, "pairs": {"0": {"force": 1.5}}}]})");
}

TEST_CASE("if a spring is too stiff, contct run names it and suggests a stiffness that is certified") {
  // The beam's stiffness for w of the tip is 12 EI / h^3 = 1.2e5.
  const auto stop = [](const std::string& stiffness) {
    return with("stiffness = 5.0e4", "stiffness = " + stiffness);
  };
  const workplace here(
      {{"stiff.toml", stop("1e30")},
       {"less.toml", stop("1e13")},
       // PB9 with so large an EI that the bed's springs are lost to rounding.
       {"beam.toml",
        "[beam]\nlength = 2.0\nelements = 40\nEI = 1e16\n[[bed]]\nmodulus = 5000.0\nface = 0.0\n"
        "[[step]]\nuniform = [ { polynomial = [-20.0, 20.0, -5.0] } ]\n"},
       {"span.toml",
        "[beam]\nlength = 1\nelements = 5000\nEI = 1\n[[support]]\nnodes = [1, 5001]\nfix = "
        "['w']\n[[step]]\nuniform = -1\n"}});
  here.check(
      "run stiff.toml --kernels corrected --strict", 3, {},
      {"the stiffness 1e+30 of pair 1 (node 3, below), 8e+24 times", "argest useful stiffness is 1e+13"});
  here.check("run less.toml --kernels corrected --strict", 0);
  here.check("run beam.toml --kernels fortran,cpp --json out.json --log out.log", 2, {"^"},
             {"too ill-conditioned"});
  here.check("run span.toml --kernels fortran,cpp --json span.json", 0, {},
             {"about 1 digit of the answer can be relied on"});
  check_like(here.json("span.json")["steps"][0]["digits"], "<= 2");
}

TEST_CASE("contct run does not suggest the corrected rule for a matrix that may be indefinite") {
  const std::string problem =
      "[matrix]\nstiffness = 'K.mtx'\n[[contact]]\ndof = '1'\nsurface = 'below'\nface = 0\n"
      "stiffness = 1e-9\n[[step]]\npoint = [ { dof = '1', value = -1e-11 } ]\n";
  const workplace here(
      {{"K.mtx", mtx + "2 2 3\n1 1 1\n2 1 1.00000000001\n2 2 1\n"},
       {"p.toml", problem},
       {"held.toml", problem + "[[support]]\ndof = '1'\nspring = 1e-6\n"}});  // det K = 1e-6 - 2e-11
  here.check("run p.toml", 0, {},
             {"it is not certain that the matrix is positive semidefinite", "set free_motions = 1",
              "!--kernels corrected"});
  here.check("run held.toml --strict", 0);
}

TEST_CASE("with every engine, contct run solves and certifies a problem on a matrix in sparse storage") {
  const workplace here;
  std::filesystem::copy(root / "reference/structures", here.path());
  std::string text = here.read("frame.toml");
  here.write("s.toml", text.insert(text.find("[matrix]\n") + 9, "storage = 'sparse'\n"));
  for (const std::string how :
       {"--engine=refactor", "--engine=updated", "--final-only", "--kernels=corrected"}) {
    if (here.contct("run s.toml " + how).exit == 2)
      here.check("run s.toml " + how, 2, {}, {"without CHOLMOD"});
    else
      here.check("run s.toml --strict " + how, 0, {", sparse\n", "all 3 final states are certified"});
  }
}
