// Tests exact paths against fractions that were calculated by hand or published.
#include <algorithm>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;
using contct::change;
using contct::parse_problem;
using contct::read_problem;

namespace {

exact_path followed(const std::string& text) {
  return follow_corrected_path(exact_problem_of(parse_problem(text, "problem.toml")));
}

exact_path reference(const std::string& name) {
  return follow_corrected_path(
      exact_problem_of(read_problem(CONTCT_REFERENCE "/problems/" + name + ".toml")));
}

/// Returns the first condition of equilibrium under the full load that does not hold exactly, or an empty
/// text. Uses only K, the loads and the pairs, and no solve.
std::string wrong_with(const exact_problem& p, const exact_step& acting, const exact_step_end& e) {
  if (e.fraction != 1) return "the load is not reached";
  rational_vector rest = acting.force;
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    for (const auto& [column, k] : p.stiffness[dof]) rest[dof] -= k * e.displacement[column];
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const exact_pair& c = p.pairs[i];
    const rational gap = c.surface * (c.face - e.displacement[c.dof]);
    const rational force = gap < 0 ? rational(-c.stiffness * gap) : rational(0);
    rest[c.dof] -= c.surface * force;
    if (e.gap[i] < 0 || e.force[i] < 0 || e.force[i] != force || (e.closed[i] == 0 && e.gap[i] != gap))
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
int check_ends(const contct::problem& p) {
  const exact_problem e = exact_problem_of(p);
  const exact_path path = follow_corrected_path(e);
  int checked = 0;
  for (std::size_t step = 0; step < path.steps.size(); ++step) {
    if (path.steps[step].fraction != 1) continue;
    CHECK(wrong_with(e, e.steps[step], path.steps[step]).empty());
    ++checked;
  }
  return checked;
}

/// Returns a step's increments in the form "1/10: +1; 1:".
std::string told(const exact_step_end& s) {
  std::string words;
  for (const exact_increment& i : s.increments) {
    words += (words.empty() ? "" : "; ") + fraction_words(i.fraction) + ":";
    for (const auto& e : i.events)
      words += (e.what == change::make ? " +" : " -") + std::to_string(e.pair + 1);
    if (i.snaps) words += " snap";
  }
  return words;
}

/// Returns a dof's displacement at the end of a step. Dofs and steps count from 0.
rational at(const exact_path& path, std::size_t step, std::size_t dof) {
  return path.steps.at(step).displacement.at(dof);
}

std::string pair(int node, const std::string& surface, const std::string& face, const std::string& k) {
  return "[[contact]]\nnode = " + std::to_string(node) + "\nsurface = \"" + surface + "\"\nface = " + face +
         "\nstiffness = " + k + "\n";
}

const std::string cantilever =
    "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";
const std::string free_beam = "[beam]\nx = [0, 1, 2]\nEI = 1\n";

}  // namespace

TEST_CASE(
    "the exact path of a cantilever over a stop (PB1) makes contact at share 1/10 and breaks contact at "
    "3/10") {
  const exact_path path = reference("pb01-cantilever-tip-stop");
  REQUIRE(path.steps.size() == 4);
  CHECK(told(path.steps[0]) == "1:");
  CHECK(told(path.steps[1]) == "1/10: +1; 1:");
  CHECK(told(path.steps[3]) == "3/10: -1; 1:");
  CHECK(at(path, 1, 4) == rational(-26, 5375));
  CHECK(path.steps[1].force[0] == 50000 * (rational(26, 5375) - rational(4, 1000)));
}

TEST_CASE(
    "the exact path of a beam over three stops (PB7) reaches both outer stops at exactly 3/38 of the step") {
  const exact_path path = reference("pb07-three-gap-supports");
  CHECK(told(path.steps[1]) == "3/38: +1 +3; 1:");
  CHECK(told(path.steps[3]) == "231/730: -2; 84/95: -1 -3; 1:");
}

TEST_CASE(
    "the exact deflections of a nearly rigid plate on springs are the published fractions -208/58875 and "
    "176/153075") {
  contct::problem p = read_problem(CONTCT_REFERENCE "/problems/pb09b-plate-on-springs-ei-4e8.toml");
  for (double& EI : std::get<contct::beam>(p.geometry.kind).EI) EI = 1e40;
  const exact_path path = follow_corrected_path(exact_problem_of(p));
  const rational tiny(integer(1), boost::multiprecision::pow(integer(10), 36U));
  CHECK(abs(at(path, 0, 0) - rational(-208, 58875)) < tiny);
  CHECK(abs(at(path, 0, 32) - rational(176, 153075)) < tiny);
  CHECK(std::count(path.steps[0].closed.begin(), path.steps[0].closed.end(), 1) == 13);
}

TEST_CASE("in the exact path, an event exactly at full load is counted in the next step") {
  const std::string stop = cantilever + pair(2, "below", "-1", "3");
  const std::string step = "[[step]]\npoint = [ { node = 2, w = ";
  const exact_path path =
      followed(stop + step + "-3 } ]\n" + step + "-6 } ]\n" + step + "-3 } ]\n" + step + "0 } ]\n");
  CHECK(told(path.steps[0]) == "1:");
  CHECK(told(path.steps[1]) == "0: +1; 1:");
  CHECK(told(path.steps[2]) == "1:");
  CHECK(told(path.steps[3]) == "0: -1; 1:");
  CHECK(at(path, 1, 2) == rational(-3, 2));
}

TEST_CASE(
    "in the exact path, one complementarity problem gives the statuses of all pairs that are at their "
    "faces") {
  // Both pairs start in contact. The moment at node 1 presses the beam on pair 1 and lifts its end off pair
  // 2.
  const exact_path path = followed("[beam]\nx = [0, 1, 2]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\"]\n" +
                                   pair(2, "below", "0", "1e6") + pair(3, "below", "0", "1e6") +
                                   "[[step]]\npoint = [ { node = 1, theta = -1 } ]\n");
  CHECK(told(path.steps[0]) == "0: -2; 1:");
}

TEST_CASE(
    "in the exact path, a free beam falls onto two faces at constant load, first onto one and then onto the "
    "other") {
  const exact_path path = followed(free_beam + pair(1, "below", "-1", "2") + pair(3, "below", "-2", "2") +
                                   "[[step]]\npoint = [ { node = 2, w = -4 } ]\n");
  CHECK(path.status == contct::path_status::solved);
  CHECK(told(path.steps[0]) == "0: snap; 0: +1 snap; 0: +2; 1:");
  CHECK(at(path, 0, 0) == -2);
  CHECK(at(path, 0, 4) == -3);
  CHECK(at(path, 0, 2) == rational(-5, 2) - 4 * rational(8, 48));
}

TEST_CASE(
    "the exact path proves a mechanism by a rigid-body motion and the positive work of the load on it") {
  const exact_path path =
      followed(free_beam + pair(1, "below", "0", "1") + pair(2, "below", "0", "1") +
               "[[step]]\npoint = [ { node = 2, w = -1 }, { node = 2, theta = -4e-13 } ]\n");
  REQUIRE(path.status == contct::path_status::mechanism);
  REQUIRE(path.mechanism);
  CHECK(path.steps[0].fraction == 0);
  // The beam rotates about the pair in the middle.
  CHECK(path.mechanism->motion == rational_vector{1, -1, 0, -1, -1, -1});
  CHECK(path.mechanism->work == rational(4, 10000000000000));
}

TEST_CASE(
    "if a step removes the last contact, the exact path ends in a mechanism at the share of this event") {
  const exact_path path =
      followed(free_beam + pair(1, "below", "0", "1") + pair(3, "below", "0", "1") +
               "[[step]]\npoint = [ { node = 2, w = -2 } ]\n[[step]]\npoint = [ { node = 2, w = 3 } ]\n");
  REQUIRE(path.status == contct::path_status::mechanism);
  CHECK(path.steps[1].fraction == rational(2, 5));
  CHECK(path.mechanism->motion == rational_vector{1, 0, 1, 0, 1, 0});
  CHECK(path.mechanism->work == 3);
}

TEST_CASE(
    "if the load does no work on a rigid-body motion, the exact path does not move the structure along it") {
  const exact_path path = followed(free_beam + pair(2, "below", "0", "1") +
                                   "[[step]]\npoint = [ { node = 1, w = -1 }, { node = 3, w = -1 } ]\n");
  REQUIRE(path.status == contct::path_status::solved);
  CHECK(at(path, 0, 2) == -2);
  CHECK(at(path, 0, 0) == at(path, 0, 4));
}

TEST_CASE("the exact path reaches a face at 1/5 of a settlement, and ends with the exact displacements") {
  contct::problem p = parse_problem(
      "[beam]\nx = [0, 1, 2]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[support]]\nnode = "
      "3\n"
      "fix = [\"w\"]\n" +
          pair(2, "below", "-0.1", "6") + "[[step]]\nuniform = 0\n",
      "problem.toml");
  p.steps[0].settlements = {{2, 0, -1.6}};
  const exact_problem e = exact_problem_of(p);
  const exact_path path = follow_corrected_path(e);
  // Without the pair, w2 is 5/16 of the settlement, so that node 2 reaches the face at a share of 1/5.
  CHECK(told(path.steps[0]) == "1/5: +1; 1:");
  CHECK(at(path, 0, 4) == rational(-8, 5));
  CHECK(wrong_with(e, e.steps[0], path.steps[0]).empty());
  CHECK(path.steps[0].reactions[2] < 0);
}

TEST_CASE(
    "in the exact path, an elastic support and pairs above and below a node follow a load that reverses") {
  const std::string text =
      "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[support]]\nnode = 2\n"
      "spring = { w = 1 }\n" +
      pair(2, "below", "-0.5", "4") + pair(2, "above", "0.25", "4") +
      "[[step]]\npoint = [ { node = 2, w = -4 } ]\n[[step]]\npoint = [ { node = 2, w = 3 } ]\n";
  const exact_path path = followed(text);
  // The load is 4 w between the faces, and 4 w + 4 (w - face) beyond a face.
  CHECK(told(path.steps[0]) == "1/2: +1; 1:");
  CHECK(told(path.steps[1]) == "2/7: -1; 5/7: +2; 1:");
  CHECK(at(path, 0, 2) == rational(-3, 4));
  CHECK(at(path, 1, 2) == rational(1, 2));
  CHECK(path.steps[1].reactions[2] == rational(-1, 2));
}

TEST_CASE("the exact path solves problems with numbers from 1e-300 to 1e308") {
  const exact_path path =
      followed("[beam]\nx = [0, 1]\nEI = 1e-300\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n" +
               pair(2, "below", "-1e-300", "1e300") + "[[step]]\npoint = [ { node = 2, w = -1e308 } ]\n");
  CHECK(path.status == contct::path_status::solved);
  CHECK(length_in_bits(path.steps[0].displacement[2]) > 1000);
}

TEST_CASE("the exact final states of 300 random problems satisfy equilibrium and all contact conditions") {
  contct::random_problem_kind kind;
  kind.most_elements = 8;
  kind.most_lines = 2;
  int steps = 0;
  for (std::uint64_t number = 0; number < 300; ++number) {
    INFO(number);
    steps += check_ends(contct::make_random_problem(2026, number, kind));
  }
  CHECK(steps > 700);
}
