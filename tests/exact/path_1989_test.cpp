// Tests the exact 1989 rule in one call and on a path.
#include <algorithm>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;
using contct::parse_problem;
using contct::read_problem;

namespace {

listing_pair open_pair(const rational& c, const rational& d, const rational& d_star) {
  return {c, d, d_star, false, face_below};
}

rational ten_to_minus(unsigned n) {
  return {integer(1), boost::multiprecision::pow(integer(10), n)};
}

exact_path listed(const std::string& text) {
  return follow_1989_path(exact_problem_of(parse_problem(text, "problem.toml")));
}

const std::string one_span = "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n";

std::string stop(int node, const std::string& face, const std::string& k) {
  return "[[contact]]\nnode = " + std::to_string(node) + "\nsurface = \"below\"\nface = " + face +
         "\nstiffness = " + k + "\n";
}

}  // namespace

TEST_CASE(
    "the exact 1989 rule gives the right s to a pair without a response, an advancing and a stationary "
    "pair") {
  const rational d_star(-1, 3);
  const std::vector<listing_pair> pairs = {
      open_pair(-1, 0, 0),                // no response
      open_pair(rational(-1, 7), 0, -1),  // advancing
      open_pair(0, 0, d_star),            // at its face, and pressed against it
      {0, 0, d_star, true, face_below},   // in contact at its face, and still pressed
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

TEST_CASE("by the exact 1989 rule, a single stop makes contact exactly when the beam reaches the face") {
  const exact_path path =
      listed(one_span + stop(2, "-1", "3") + "[[step]]\npoint = [ { node = 2, w = -9 } ]\n");
  REQUIRE(path.steps[0].increments.size() == 2);
  CHECK(path.steps[0].increments[0].fraction == rational(1, 3));
  CHECK(path.steps[0].displacement[2] == -2);
}

TEST_CASE(
    "by the exact 1989 rule, a pair within EPSMUL is toggled too early, and the displacements keep the "
    "error") {
  // Of two stops at one node, the face at -1 is reached at s = 1/3, and the face at -1.001 within 1/256 of
  // this s.
  const exact_path path = listed(one_span + stop(2, "-1", "3") + stop(2, "-1.001", "6") +
                                 "[[step]]\npoint = [ { node = 2, w = -9 } ]\n");
  // Pair 2 is in contact too early, so it breaks when it meets its face at -1.001, and then makes contact
  // again.
  REQUIRE(path.steps[0].increments.size() == 4);
  CHECK(path.steps[0].increments[0].events.size() == 2);
  // -9 = 3 w + 3 (w + 1) + 6 (w + 1): the second spring acts from -1 instead of -1.001, and keeps the
  // extra force.
  CHECK(abs(path.steps[0].displacement[2] + rational(3, 2)) < ten_to_minus(19));
}

TEST_CASE("the exact 1989 rule toggles a stationary pair after DELTA of the residual load") {
  const exact_path path =
      listed(one_span + stop(2, "0", "3") + "[[step]]\npoint = [ { node = 2, w = 6 } ]\n");
  REQUIRE(path.steps[0].increments.size() == 2);
  // d* = 6 / (3 + 3) = 1, so s = 1E-20.
  CHECK(path.steps[0].increments[0].fraction == ten_to_minus(20));
  CHECK(path.steps[0].displacement[2] == 2 - ten_to_minus(20));
}

TEST_CASE(
    "for the exact 1989 rule, a gap of 1e-11 is stationary, although the gap closes only at 1/20 of the "
    "load") {
  const exact_path path =
      listed(one_span + stop(2, "-1e-11", "3") + "[[step]]\npoint = [ { node = 2, w = -6e-10 } ]\n");
  // Contact is made at a share of DELTA / d*, and not at the true share of 1/20.
  REQUIRE(path.steps[0].increments.size() == 2);
  CHECK(path.steps[0].increments[0].fraction < rational(1, 1000000));
}

TEST_CASE(
    "the exact 1989 rule has the errors and the ended paths that are expected for each file of "
    "DIVERGENCES.md") {
  struct divergence {
    const char* name;
    double error;  // largest error of w at the ends of steps, relative to the largest w
    bool ends_early;
  };
  for (const auto& [name, error, ends_early] :
       {divergence{"near-tie", 0.03, false}, divergence{"small-unit", 0.769, false},
        divergence{"stiff-stop", 2.0, false}, divergence{"single-precision", 0.0, false},
        divergence{"event-at-full-load", 1.92e-18, false}, divergence{"mark-toggled", 0.0, false},
        divergence{"locked-in-forces", 0.00247, true}, divergence{"standstill", 0.0, true}}) {
    INFO(name);
    const std::string file = CONTCT_REFERENCE "/problems/divergences/" + std::string(name) + ".toml";
    const exact_problem e = exact_problem_of(read_problem(file));
    const exact_path truly = follow_corrected_path(e);
    const exact_path listed_path = follow_1989_path(e);
    CHECK(truly.status == contct::path_status::solved);
    CHECK((listed_path.status == contct::path_status::mechanism) == ends_early);
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

TEST_CASE("by the exact 1989 rule, a free beam that is above its stops is a mechanism") {
  const exact_path path = listed("[beam]\nx = [0, 1]\nEI = 1\n" + stop(1, "-1", "1") + stop(2, "-1", "1") +
                                 "[[step]]\nuniform = -1\n");
  CHECK(path.status == contct::path_status::mechanism);
  CHECK(path.steps[0].fraction == 0);
}
