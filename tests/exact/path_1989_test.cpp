// The listing's decisions where arithmetic is exact.
#include <algorithm>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct::exact;
using contct::read::parse_problem;

namespace {

exact_path listed(const std::string& text) {
  return follow_1989_path(exact_problem_of(parse_problem(text, "problem.toml")));
}

const std::string one_span = "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";

std::string stop(int node, const std::string& face, const std::string& k) {
  return "[[contact]]\nnode = " + std::to_string(node) + "\nsurface = \"below\"\nface = " + face +
         "\nstiffness = " + k + "\n";
}

}  // namespace

TEST_CASE("a single stop is made exactly at its face by the 1989 rule too") {
  const exact_path path =
      listed(one_span + stop(2, "-1", "3") + "[[step]]\npoint = [ { node = 2, w = -9 } ]\n");
  REQUIRE(path.steps[0].increments.size() == 2);
  CHECK(path.steps[0].increments[0].fraction == rational(1, 3));
  CHECK(path.steps[0].displacement[2] == -2);
}

TEST_CASE("a pair within EPSMUL of the first is made before it touches, and its error stays in the sum") {
  // Two stops at one node: 1 is reached at a third, 1.001 within 1/256 of that.
  const exact_path path = listed(one_span + stop(2, "-1", "3") + stop(2, "-1.001", "6") +
                                 "[[step]]\npoint = [ { node = 2, w = -9 } ]\n");
  // At -1.001 it breaks, for a pair in contact has an event wherever it meets its face, and is made again.
  REQUIRE(path.steps[0].increments.size() == 4);
  CHECK(path.steps[0].increments[0].events.size() == 2);
  // -9 = 3 w + 3 (w + 1) + 6 (w + 1): the second spring acts from -1 on, not from -1.001, and keeps that
  // force.
  const rational delta(integer(1), boost::multiprecision::pow(integer(10), 19U));
  CHECK(abs(path.steps[0].displacement[2] + rational(3, 2)) < delta);
}

TEST_CASE("a pair 1/256 behind the first is not made with it") {
  const exact_path path = listed(one_span + stop(2, "-1", "3") + stop(2, "-1.00390625", "6") +
                                 "[[step]]\npoint = [ { node = 2, w = -9 } ]\n");
  CHECK(path.steps[0].increments[0].events.size() == 1);
}

TEST_CASE("a stationary pair takes DELTA of the residual load with it") {
  const exact_path path =
      listed(one_span + stop(2, "0", "3") + "[[step]]\npoint = [ { node = 2, w = 6 } ]\n");
  REQUIRE(path.steps[0].increments.size() == 2);
  // d* = 6 / (3 + 3) = 1, so s = 1E-20.
  CHECK(path.steps[0].increments[0].fraction ==
        rational(integer(1), boost::multiprecision::pow(integer(10), 20U)));
  CHECK(path.steps[0].displacement[2] < 2);
  CHECK(2 - path.steps[0].displacement[2] ==
        rational(integer(1), boost::multiprecision::pow(integer(10), 20U)));
}

TEST_CASE("a gap below EPSGAP is stationary, whatever the unit of length") {
  const exact_path path =
      listed(one_span + stop(2, "-1e-11", "3") + "[[step]]\npoint = [ { node = 2, w = -6e-10 } ]\n");
  // Made where it is not yet, at 0 but for DELTA / d*: the true path makes it at 1/20.
  REQUIRE(path.steps[0].increments.size() == 2);
  CHECK(path.steps[0].increments[0].fraction < rational(1, 1000000));
}

TEST_CASE("where the 1989 code goes wrong, its rule does, as reference/DIVERGENCES.md says") {
  struct divergence {
    const char* name;
    double error;  // of w at the ends of steps that the rule reaches, relative to the largest
    bool ends_early;
  };
  for (const auto& [name, error, ends_early] :
       {divergence{"near-tie", 0.03, false}, divergence{"small-unit", 0.769, false},
        divergence{"stiff-stop", 2.0, false}, divergence{"single-precision", 0.0, false},
        divergence{"event-at-full-load", 1.92e-18, false}, divergence{"mark-toggled", 0.0, false},
        divergence{"locked-in-forces", 0.00247, true}, divergence{"standstill", 0.0, true}}) {
    INFO(name);
    const std::string file = CONTCT_REFERENCE "/problems/divergences/" + std::string(name) + ".toml";
    const exact_problem e = exact_problem_of(contct::read::read_problem(file));
    const exact_path truly = follow_true_path(e);
    const exact_path listed_path = follow_1989_path(e);
    CHECK(truly.status == contct::path::path_status::solved);
    CHECK((listed_path.status == contct::path::path_status::mechanism) == ends_early);
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

TEST_CASE("a structure that no closed pair holds is a mechanism for the 1989 driver") {
  const exact_path path = listed("[beam]\nx = [0, 1]\nEI = 1\n" + stop(1, "-1", "1") + stop(2, "-1", "1") +
                                 "[[step]]\nuniform = -1\n");
  CHECK(path.status == contct::path::path_status::mechanism);
  CHECK(path.steps[0].fraction == 0);
}
