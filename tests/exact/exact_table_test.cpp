// Tests exact equations, paths and the exact 1989 rule against fractions that were calculated by hand or
// published, most of them in exact.txt.
#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/results/random_problem.hpp"
#include "contct/structure/elements.hpp"
#include "read/good_problem.hpp"
#include "support/judged_run.hpp"
#include "support/rows.hpp"

using namespace contct;

namespace {

/// Returns the first condition of equilibrium under the full load that does not hold exactly, or an empty
/// text. Uses only K, the loads and the pairs, and no solve.
std::string wrong_with(const exact_problem& p, const exact_step& acting, const exact_step_end& e) {
  if (e.fraction != 1) return "the load is not reached";
  rational_vector rest = acting.force;
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    for (const auto& [column, k] : p.stiffness[dof]) rest[dof] -= k * e.displacement[column];
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const exact_pair& c = p.pairs[i];
    const rational gap = c.surface * (c.face + acting.moved[c.dof] - e.displacement[c.dof]);
    const rational force = gap < 0 ? rational(-c.stiffness * gap) : rational(0);
    rest[c.dof] -= c.surface * force;
    if (e.gap[i] < 0 || e.force[i] < 0 || e.force[i] != force || (e.isep[i] == separated && e.gap[i] != gap))
      return "pair " + std::to_string(i + 1) + " is not on its side of its face";
  }
  for (std::size_t i = 0; i < p.supports.size(); ++i)
    if (p.supports[i].fixed) rest[p.supports[i].dof] += e.reactions[i];
  for (std::size_t dof = 0; dof < p.dofs(); ++dof) {
    if (rest[dof] != 0) return "dof " + std::to_string(dof + 1) + " is not in balance";
    if (p.fixed[dof] != 0 && e.displacement[dof] != acting.settlement[dof])
      return "dof " + std::to_string(dof + 1) + " is not where its support holds it";
  }
  return "";
}

/// Checks that every final state under the full load is in equilibrium, and returns the number of these
/// states.
int check_ends(const exact_problem& e, const exact_path& path) {
  int checked = 0;
  for (std::size_t step = 0; step < path.steps.size(); ++step) {
    if (path.steps[step].fraction != 1) continue;
    CHECK(wrong_with(e, e.steps[step], path.steps[step]).empty());
    ++checked;
  }
  return checked;
}

std::string words_of(const rational_vector& all) {
  std::string words;
  for (const rational& x : all) words += (words.empty() ? "" : " ") + fraction_words(x);
  return words;
}

/// Returns a step's increments in the form "1/10: +1; 1:".
std::string events_of(const exact_step_end& s) {
  std::string words;
  for (const exact_increment& i : s.increments) {
    words += (words.empty() ? "" : "; ") + fraction_words(i.fraction) + ":";
    for (const event& e : i.events)
      words += (e.what == change::make ? " +" : " -") + std::to_string(e.pair + 1);
    if (i.snaps) words += " snap";
  }
  return words;
}

std::string words_of(path_status s) {
  return s == path_status::solved ? "solved" : s == path_status::mechanism ? "mechanism" : "other";
}

/// A key of exact.txt: a word, and numbers from 1 separated by a dot.
struct asked {
  explicit asked(const std::string& key) {
    const std::size_t at = std::min(key.find_first_of("123456789"), key.size());
    word = key.substr(0, at);
    if (at == key.size()) return;
    for (const std::string& n : split(key.substr(at), ".")) numbers.push_back(std::stoul(n) - 1);
  }
  std::string word;
  std::vector<std::size_t> numbers;
};

/// Returns a number of a path in words: the share, the events e, the status, w of a node, the force f or gap
/// g of a pair, or the reaction r of a support in a step; or the status, motion or work of the path.
std::string answer_of(const exact_path& path, const asked& a, std::size_t per_node) {
  if (a.word == "motion") return words_of(path.mechanism.value().motion);
  if (a.word == "work") return fraction_words(path.mechanism.value().work);
  if (a.numbers.empty()) return words_of(path.status());
  const exact_step_end& s = path.steps.at(a.numbers[0]);
  if (a.word == "e") return events_of(s);
  if (a.word == "status") return words_of(s.status);
  if (a.word == "share") return fraction_words(s.fraction);
  const std::size_t i = a.numbers.at(1);
  return fraction_words(a.word == "w"   ? s.displacement.at(per_node * i)
                        : a.word == "f" ? s.force.at(i)
                        : a.word == "g" ? s.gap.at(i)
                                        : s.reactions.at(i));
}

/// Returns a number of equations: an entry of K, a pair's stiffness k or face, whether it is closed, the
/// spring of a support, the nodal loads F of a step, or a settlement.
std::string answer_of(const exact_problem& e, const asked& a) {
  if (a.word == "dofs") return std::to_string(e.dofs());
  if (a.word == "fixed") return words_of(rational_vector(e.fixed.begin(), e.fixed.end()));
  const std::size_t i = a.numbers.at(0);
  if (a.word == "K") return fraction_words(e.stiffness.at(i).at(static_cast<int>(a.numbers.at(1))));
  if (a.word == "k") return fraction_words(e.pairs.at(i).stiffness);
  if (a.word == "face") return fraction_words(e.pairs.at(i).face);
  if (a.word == "closed") return std::to_string(e.pairs.at(i).closed ? 1 : 0);
  if (a.word == "spring") return fraction_words(e.supports.at(i).spring);
  if (a.word == "settled") return fraction_words(e.steps.at(i).settlement.at(a.numbers.at(1)));
  return a.numbers.size() == 1 ? words_of(e.steps.at(i).force)
                               : fraction_words(e.steps.at(i).force.at(a.numbers[1]));
}

listing_pair open_pair(const rational& c, const rational& d, const rational& d_star) {
  return {c, d, d_star, separated, face_below};
}

rational ten_to_minus(unsigned n) {
  return {integer(1), boost::multiprecision::pow(integer(10), n)};
}

}  // namespace

TEST_CASE("exact equations and paths have the fractions of exact.txt, and every state is in equilibrium") {
  std::map<std::string, std::string> bases;
  const std::string problems = CONTCT_REFERENCE "/problems/";
  for (const std::string rule : {"corrected ", "1989 ", "either ", "equations "}) {
    bases[rule + "beam"] = good_problem;
    bases[rule + "plate"] = good_plate;
    bases[rule + "cantilever"] =
        "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[contact]]\nnode = 2\n"
        "surface = \"below\"\nface = -1\nstiffness = 3\n[[step]]\npoint = [ { node = 2, w = -9 } ]\n";
    bases[rule + "free"] =
        "[beam]\nx = [0, 1, 2]\nEI = 1\n[[contact]]\nnodes = [1, 3]\nsurface = \"below\"\nface = 0\n"
        "stiffness = 1\n[[step]]\npoint = [ { node = 2, w = -2 } ]\n";
    bases[rule + "pb01"] = read_input(problems + "pb01-cantilever-tip-stop.toml");
    bases[rule + "pb07"] = read_input(problems + "pb07-three-gap-supports.toml");
  }
  const auto rows = rows_of("exact/exact.txt", bases);
  CHECK(rows.size() >= 40);
  for (const table_row& row : rows) {
    INFO(row.fact << "\n" << row.base << ": " << row.row);
    const problem p = parse_problem(row.text, "problem.toml");
    const exact_problem e = exact_problem_of(p);
    const std::string rule = row.base.substr(0, row.base.find(' '));
    std::vector<exact_path> paths;
    if (rule == "corrected" || rule == "either") {
      paths.push_back(follow_corrected_path(e));
      check_ends(e, paths[0]);
    }
    if (rule == "1989" || rule == "either") paths.push_back(follow_1989_path(e));
    for (const std::string& expected : split(row.expected, " | ")) {
      const std::string key = expected.substr(0, expected.find(':'));
      if (rule == "equations") CHECK(key + ": " + answer_of(e, asked(key)) == expected);
      for (const exact_path& path : paths)
        CHECK(key + ": " + answer_of(path, asked(key), dofs_per_node(p.geometry)) == expected);
    }
  }
}

TEST_CASE(
    "the exact deflections of a nearly rigid plate on springs are the published fractions -208/58875 and "
    "176/153075") {
  problem p = read_problem(CONTCT_REFERENCE "/problems/pb09b-plate-on-springs-ei-4e8.toml");
  for (double& EI : std::get<beam>(p.geometry.kind).EI) EI = 1e40;
  const exact_step_end end = follow_corrected_path(exact_problem_of(p)).steps.at(0);
  const rational tiny(integer(1), boost::multiprecision::pow(integer(10), 36U));
  CHECK(abs(end.displacement[0] - rational(-208, 58875)) < tiny);
  CHECK(abs(end.displacement[32] - rational(176, 153075)) < tiny);
  CHECK(std::ranges::count(end.isep, in_contact) == 13);
}

TEST_CASE("the exact final states of 100 random problems satisfy equilibrium and all contact conditions") {
  int steps = 0;
  for (std::uint64_t number = 0; number < 100; ++number) {
    INFO(number);
    const exact_problem e =
        exact_problem_of(make_random_problem(2026, number, {.most_elements = 8, .most_lines = 2}));
    steps += check_ends(e, follow_corrected_path(e));
  }
  CHECK(steps > 230);
}

TEST_CASE("the exact moment of a Gerber beam is 0 on both sides of its hinge, and -60 at the next support") {
  const problem p = parse_problem(
      "[beam]\nlength = 12.0\nelement_size = 2.0\nEI = 52857\n[[hinge]]\nx = 8.0\n[[support]]\n"
      "x = [0.0, 6.0, 12.0]\nfix = \"w\"\n[[step]]\nuniform = -10.0\n",
      "gerber.toml");
  const auto forces =
      elements_of<rational>(std::get<beam>(p.geometry.kind))
          .end_forces(p.steps[0], follow_corrected_path(exact_problem_of(p)).steps.at(0).displacement);
  CHECK(rational_vector{forces[3][3], forces[4][2], forces[3][2], forces[3][1]} ==
        rational_vector{0, 0, -60, 20});
}

TEST_CASE("Two cantilevers that meet press on each other with an exact fraction, by either rule") {
  const exact_problem p = exact_problem_of(two_cantilevers());
  for (const exact_path& path : {follow_1989_path(p), follow_corrected_path(p)}) {
    CHECK(path.steps.at(0).increments.at(0).fraction == rational(1, 2));
    CHECK(path.steps[0].force[0] == rational(75, 11));  // 0.002 / (1 / 3750 + 1 / 60000 + 1 / 100000)
    CHECK(path.steps[0].displacement[2] == rational(-75, 11 * 60000));
  }
}

TEST_CASE(
    "the exact 1989 rule gives the right s to a pair without a response, an advancing and a stationary "
    "pair") {
  const rational d_star(-1, 3);
  const std::vector<listing_pair> pairs = {
      open_pair(-1, 0, 0),                     // no response
      open_pair(rational(-1, 7), 0, -1),       // advancing
      open_pair(0, 0, d_star),                 // at its face, and pressed against it
      {0, 0, d_star, in_contact, face_below},  // in contact at its face, and still pressed
  };
  const listing_answer a = answer_exactly(pairs);
  CHECK(a.s == rational_vector{1, rational(1, 7), 3 * ten_to_minus(20), 1});
  CHECK(a.s_min == 3 * ten_to_minus(20));
  CHECK(a.toggled == std::vector<int>{2});
}

TEST_CASE("for the exact 1989 rule, a gap of exactly EPSGAP is not stationary, and s = 1 is no event") {
  const std::vector<listing_pair> pairs = {open_pair(-ten_to_minus(10), 0, -ten_to_minus(10))};
  const listing_answer a = answer_exactly(pairs);
  CHECK(a.s[0] == 1);
  CHECK(a.s_min == 1);
  CHECK(a.toggled.empty());
}

TEST_CASE("the exact 1989 rule toggles every pair within EPSMUL, and gives two tied pairs the same least s") {
  const std::vector<listing_pair> pairs = {
      open_pair(rational(-1, 2), 0, -1), open_pair(-2, -1, -2),
      open_pair(rational(-1, 2) - rational(1, 1024), 0, -1),  // later by 1/512, within EPSMUL
      open_pair(rational(-1, 2) - rational(1, 512), 0, -1),   // later by exactly EPSMUL
  };
  const listing_answer a = answer_exactly(pairs);
  CHECK(a.s[0] == a.s_min);
  CHECK(a.s[1] == a.s_min);
  CHECK(a.s[2] > a.s_min);
  CHECK(a.toggled == std::vector<int>{0, 1, 2});
}

TEST_CASE(
    "the exact 1989 rule has the errors and the ended paths that are expected for each file of "
    "DIVERGENCES.md") {
  // The largest error of w at the ends of steps, relative to the largest w; whether the path ends early.
  for (const auto& [name, error, ends_early] : {std::tuple("near-tie", 0.03, false),
                                                {"small-unit", 0.769, false},
                                                {"stiff-stop", 2.0, false},
                                                {"single-precision", 0.0, false},
                                                {"event-at-full-load", 1.92e-18, false},
                                                {"mark-toggled", 0.0, false},
                                                {"locked-in-forces", 0.00247, true},
                                                {"standstill", 0.0, true}}) {
    INFO(name);
    const std::string file = CONTCT_REFERENCE "/problems/divergences/" + std::string(name) + ".toml";
    const exact_problem e = exact_problem_of(read_problem(file));
    const exact_path truly = follow_corrected_path(e);
    const exact_path listed_path = follow_1989_path(e);
    CHECK(truly.status() == contct::path_status::solved);
    CHECK((listed_path.status() == contct::path_status::mechanism) == ends_early);
    rational largest;
    rational worst;
    for (std::size_t step = 0; step < listed_path.steps.size(); ++step) {
      for (std::size_t dof = 0; dof < e.dofs(); dof += 2) {
        const rational& w = truly.steps[step].displacement[dof];
        largest = std::max(largest, rational(abs(w)));
        if (listed_path.steps[step].fraction == 1)
          worst = std::max(worst, rational(abs(w - listed_path.steps[step].displacement[dof])));
      }
    }
    CHECK(rounded(worst / largest) == Approx(error).epsilon(0.01));
  }
}
