// Tests the printed tables of a run, and the words for statuses, events and certificates of the formats in
// reference/. tests/app tests whole runs of the program.
#include <cmath>
#include <sstream>

#include "catch.hpp"
#include "contct/results/step_results.hpp"
#include "contct/text/input_text.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/words.hpp"
#include "support/a_run.hpp"
#include "support/structures.hpp"
#include "support/words.hpp"

using namespace contct;

namespace {

std::string printed(const std::string& text, const std::string& leads = "fortran", int columns = 100) {
  return table_of(a_run(text, leads).result, {columns, false}, false).text;
}

const std::string near_tie = read_input(CONTCT_REFERENCE "/problems/divergences/near-tie.toml");

/// Returns the warning of a plate on supports along its edges, with these tables for its middle, node 13.
std::string warned_of(
    const std::string& tables,
    const std::string& supported = "1, 2, 3, 4, 5, 6, 10, 11, 15, 16, 20, 21, 22, 23, 24, 25") {
  const a_run r(
      "[plate]\nsize = [1, 1]\nelements = [4, 4]\nE = 10.92\nnu = 0.3\nthickness = 1\n[[support]]\n"
      "nodes = [" +
          supported + "]\nfix = 'w'\n" + tables,
      "corrected");
  return concentration_warning(r.what, r.result.record.steps);
}

}  // namespace

TEST_CASE("a share of the step takes at most nine characters, and is printed as 1 only if it is exactly 1") {
  for (const auto& [share, text] : {std::pair(1.0, "1"),
                                    {0.25, "0.25"},
                                    {0.0789473684210526, "0.0789474"},
                                    {0.9999999, "0.9999999"},
                                    {0.99999999, "1-1e-08"},
                                    {1 - 1e-16, "1-1e-16"}})
    CHECK(share_words(share) == text);
  for (const double x : {1.0 / 3, 1e-300 / 3, 0.99999994, 0.99999996, 1 - 4e-12, 2.0 / 3e5}) {
    INFO(x);
    CHECK(share_words(x).size() <= 9);
    CHECK(share_words(x) != "1");
  }
}

TEST_CASE("many pairs that separate at the start of the load have one printed row, a few one row each") {
  check_words(printed(lying_beam(40)), {" at first load"});
  check_words(printed(lying_beam(3)), {"break 4: node 4 below", "! at first load"});
}

TEST_CASE("if several kernels run, the legend of the printed table explains the column of kernels") {
  const std::pair<std::string, std::vector<std::string>> rows[] = {
      {"fortran", {"kernels: whether their bits are equal"}}, {"cpp", {"!kernels:", "share:"}}};
  for (const auto& [leads, words] : rows) {
    std::string legend;
    for (const std::string& line : table_of(a_run(good_problem, leads).result, {100, false}, false).legend)
      legend += line + "\n";
    check_words(legend, words);
  }
}

TEST_CASE("in the printed table, the largest values have units, and are aligned if there is space") {
  const std::string text = "[units]\nlength = 'm'\nforce = 'kN'\n" + std::string(good_problem);
  check_words(printed(text), {"moment        -36.2791 kN m     node 1, x = 0\n"});
  check_words(printed(text, "fortran", 44), {"moment -36.2791 kN m, node 1, x = 0\n"});
}

TEST_CASE("the printed table gives the new position of each face that moved, below the end of the step") {
  const std::string text = printed(
      "[beam]\nlength = 2\nelements = 2\nEI = 1e4\n[[support]]\nnode = 1\nfix = ['w', 'theta']\n"
      "[[contact]]\nnodes = [2, 3]\nsurface = 'below'\nface = -1\nstiffness = 1e5\n"
      "[[step]]\nuniform = -1\n[[step]]\nmove = [ { node = 3, w = 0.25 } ]\n",
      "fortran", 80);
  const std::string line = "moved face    -0.75             pair 2, node 3 below\n";
  check_words(text, {line});
  CHECK(text.find("moved face") == text.find(line));
  CHECK(text.find("   2.1  ") < text.find(line));
}

TEST_CASE("the detailed printed tables are within 80 columns") {
  std::istringstream lines(table_of(a_run(good_problem).result, {80, false}, true).text);
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 80);
}

TEST_CASE("a value is printed as 0, without a place, only if it is 0, however large earlier values were") {
  check_words(
      printed(propped_cantilever + "[[step]]\nuniform = -8e-15\n[[step]]\nuniform = 0\n", "corrected"),
      {"        moment        -4e-15            node 1, x = 0\n",
       "        reaction      1e-14             node 1\n", "        moment        0\n",
       "        reaction      0\n"});
}

TEST_CASE("the printed table has the reactions of both signs with their supports, also of all combinations") {
  check_words(printed(loaded_span), {"        reaction      75                node 7\n        and     "
                                     "      -7.5              node 13\n"});
  std::string cases =
      loaded_span +
      "[[combination]]\nname = 'A'\nterms = { G = 1 }\n[[combination]]\nname = 'B'\nterms = { G = 2 }\n";
  cases.replace(cases.find("[[step]]"), 8, "[[case]]\nname = 'G'");
  check_words(printed(cases), {"least reaction    -15                 node 13, x = 12        B\n",
                               "largest reaction  150                 node 7, x = 6          B\n"});
  check_words(printed(cases + "[[contact]]\nx = 3\nsurface = 'below'\nface = 0\nstiffness = 1e5\n"),
              {"least reaction ", "largest reaction ", "largest force     ", " pair 1, node 4, x = 3"});
}

TEST_CASE("more than 12 combinations are printed as one row each, and then their largest values") {
  const std::string train =
      "[beam]\nlength = 24\nelements = 24\nEI = 1e4\n[[support]]\nx = [0, 24]\nfix = 'w'\n"
      "[[train]]\nname = 'HL-93'\naxles = [ { at = 0, w = -10 } ]\nfrom = 0\nto = 24\nby = ";
  CHECK_THAT(
      printed(train + "1\n", "fortran", 80),
      Contains("\nHL-93 at 7      1        0  moment 49.5833") &&
          !Contains("incr  share") &&  // 10 * 7 * 17 / 24
          Contains("largest moment    60                  node 13, x = 12        HL-93 at 12\n"));  // P L / 4
  check_words(printed(train + "8\n", "fortran", 80), {"   2.1  1", "end  HL-93 at 8;"});
}

TEST_CASE("for more than six steps, each quantity has a printed table with one row for each step") {
  std::string text = propped_cantilever;
  for (int step = 2; step <= 7; ++step) text += "[[step]]\nuniform = -" + std::to_string(8 * step) + "\n";
  // 9 q L^2 / 128 and q L^2 / 8, q = 56
  check_words(printed(text),
              {"!sums", "\nmoment           least  at                             largest  at\n",
               "step 7             -28  node 1, x = 0                    15.75  x = 1.25\n"});
}

TEST_CASE("in the printed table of a matrix, a value has a unit if its dof is known to be a length") {
  check_words(printed(portal_frame() + "[units]\nlength = 'm'\nforce = 'N'\n", "cpp"),
              {"-0.00123118 m     dof 6.y", "11558.9 N         pair 1, dof 6.y below\n",
               "4220.57 N         dof 1.y\n"});
  problem bare = parsed(frame_without_coordinates());
  problem placed = parsed(portal_frame());
  bare.units = placed.units = {"m", "N"};
  CHECK(unit_words(bare, unit::force, 0).empty());
  CHECK(unit_words(bare, unit::length, 16) == " m");    // 6.y, the dof of a pair
  CHECK(unit_words(placed, unit::force, 2) == " N m");  // 1.r
  CHECK(unit_words(placed, unit::length, 2).empty());
}

TEST_CASE("the printed sums of forces have units, and are 0 if they are only rounding") {
  // The reactions of the second step, up to 0.45 kN, cancel.
  const a_run r(read_problem(CONTCT_REFERENCE "/problems/pp06-plate-over-settling-line.toml"), "corrected");
  check_words(table_of(r.result, {100, false}, false).text,
              {"sums          loads 0 kN, reactions -4.16988 kN, contact 4.16988 kN\n",
               "sums          loads 0 kN, reactions 0 kN, contact 0 kN\n"});
}

TEST_CASE("a path that does not reach its load has one of three statuses, and a reason") {
  for (const auto& [status, name, reason] :
       {std::tuple(path_status::solved, "solved", "all load applied"),
        {path_status::mechanism, "mechanism", "mechanism"},
        {path_status::path_ended, "path-ended", "path ended"},
        {path_status::cycle, "iteration-limit", "cycle"},
        {path_status::not_factored, "iteration-limit", "not factored"},
        {path_status::iteration_limit, "iteration-limit", "iteration limit"}}) {
    CHECK(status_name(status) == name);
    CHECK(end_reason(status) == reason);
  }
}

TEST_CASE("the summary counts certified steps, but a run whose path ended early is not certified") {
  const a_run one(good_problem);
  CHECK(certificate_summary(one.result, true)[0] ==
        "the final state is certified: this beam has no mesh error");
  CHECK(certificate_complaints(one.result).empty());
  const a_run two(std::string(good_problem) + "[[step]]\npoint = [ { node = 3, w = 20.0 } ]\n");
  CHECK(certificate_summary(two.result, true)[0] ==
        "both final states are certified: this beam has no mesh error");
  const std::vector<std::string> ended = certificate_summary(one.result, false);
  REQUIRE(ended.size() == 2);
  check_words(ended[0], {"the run is NOT certified"});
  CHECK(ended[1] == "step 1 is certified");
}

TEST_CASE("if a pair in contact pulls under the 1989 rule, the message names the pair and gives the force") {
  const a_run r(  // the exact forces are 2.75e-4 and 0
      "[beam]\nlength = 128\nelements = 128\nEI = 1e4\n[[support]]\nnodes = [1, 129]\nfix = 'w'\n"
      "[[contact]]\nnodes = [65, 33]\nsurface = 'above'\nface = [1e-4, 2e-4]\nstiffness = 1e3\n"
      "[[step]]\nuniform = -0.37252902984619140625\n[[step]]\nuniform = 3.7252902984619140625e-6\n");
  const std::vector<std::string> complaints = certificate_complaints(r.result);
  REQUIRE(complaints.size() == 1);
  check_words(complaints[0],
              {"step 2 is not certified: ", "; pair 2 (node 33, above) pulls with 0.129; in increment 2.1 "});
}

TEST_CASE("if forces are locked in, messages give the step, the error and the early toggle") {
  problem p = parsed(near_tie);
  p.units = {"m", "kN"};
  const a_run r(std::move(p));
  const std::vector<std::string> complaints = certificate_complaints(r.result);
  REQUIRE(complaints.size() == 2);
  check_words(complaints[0],
              {"^step 1 is not certified: ", "; in increment 1.", " contact ", " from its face"});
  check_words(certificate_summary(r.result, true)[0], {"step 1 is NOT certified: "});
  CHECK(r.result.early.all().front().distance > 0.0);
  // 0.5 L^3 / 3 EI = 1.3333e-4 of 4.44e-3, see near-tie.toml
  check_words(complaints[1],
              {"a deflection may be off by 0.00016 m, 3.6 % of the largest of its kind; allowed: 0.0001 %",
               "made contact 1e-05 m from its face (0.25 % of the largest deflection)"});
  check_words(complaints_of(r.result).back(), {"contct run ", " --kernels corrected"});
}

TEST_CASE("the number of proved digits of a run is that of the step with the largest error bound") {
  const a_run two(
      "[beam]\nlength = 100.0\nelements = 400\nEI = 1.0\n[[support]]\nnodes = [1, 401]\nfix = 'w'\n"
      "[[step]]\nuniform = -1.0\n[[step]]\npoint = [ { node = 200, w = 1.0 } ]\n");
  double worst = 0.0;
  for (const auto& s : two.result.record.steps) worst = std::max(worst, s.judged.value().worst_share);
  REQUIRE(worst > 1e-10);  // otherwise the summary is "10 digits or more"
  const int digits = static_cast<int>(-std::log10(worst));
  CHECK(certificate_summary(two.result, true)[1] ==
        "proved: " + std::to_string(digits) + " digits of every number");
}

TEST_CASE("a message does not name a toggle as a cause if the toggle is early only by rounding") {
  a_run r(near_tie);
  // In the first step, with almost no deflection, a pair was toggled 1e-18 too early.
  early_toggles tiny;
  const std::vector<double> dd = {0.0}, dtest = {1e-18}, cc = {2e-18};
  std::vector<double> ss = {1.0};
  const std::vector<int> id = {1}, before = {separated}, isurf = {face_above};
  std::vector<int> isep = {in_contact};
  const call<double> answered{dd, dtest, cc, ss, 1.0, id, isep, isurf, {}};
  tiny.called({answered, before, ""});
  const std::vector<event> events = {{0, change::make}};
  tiny.incremented({1, 1, 1.0, 0.5, events});
  REQUIRE(tiny.all().size() == 1);
  r.result.early = tiny;
  check_words(certificate_complaints(r.result).at(0), {"!; in increment"});
}

TEST_CASE("contct run warns if a plate's largest stress is under a point load or a pair") {
  const std::string place = " at node 13, (0.5, 0.5), under ";
  const auto stop = [](const std::string& face) {
    return "[[contact]]\nnode = 13\nsurface = 'below'\nface = " + face +
           "\nstiffness = 1e4\n[[step]]\nuniform = -1\n";
  };
  check_words(warned_of("[[step]]\npoint = [ { node = 13, w = -1 } ]\n"),
              {"^step 1: largest von Mises" + place + "a point load: "});
  check_words(warned_of(stop("0")), {place + "the force of pair 1: "});
  for (const std::string& tables :
       {std::string("[[step]]\nuniform = [ { value = -16, from = [0.375, 0.375], to = [0.625, 0.625] } ]\n"),
        std::string("[[step]]\nuniform = -1\npoint = [ { node = 13, w = 0 } ]\n"), stop("-1")})
    CHECK(warned_of(tables).empty());
  // At a free corner the twisting moment is half the force, whatever the mesh.
  CHECK(warned_of("[[step]]\npoint = [ { node = 1, w = -1 } ]\n", "5, 21, 25").empty());
}
