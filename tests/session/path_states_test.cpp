// Tests the states along a path, which are solved for separately.
#include "contct/session/path_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "contct/session/step_results.hpp"
#include "support/a_run.hpp"

using namespace contct;

namespace {

/// Returns a simple beam of 8 elements over two stops, under these uniform loads in turn.
std::string two_stops(const std::vector<double>& uniform) {
  std::string text =
      "[beam]\nlength = 1\nelements = 8\nEI = 1\n[[support]]\nnodes = [1, 9]\nfix = \"w\"\n"
      "[[contact]]\nnodes = [4, 6]\nsurface = \"below\"\nface = [-0.01, -0.0105]\nstiffness = 1e4\n";
  for (const double q : uniform) text += fmt::format("[[step]]\nuniform = {}\n", q);
  return text;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

}  // namespace

TEST_CASE("a state within a step equals the final state of a path that ends at the same load") {
  for (const std::string leader : {"fortran", "corrected"}) {
    INFO(leader);
    const std::vector<structure_state> states = pictures_of(a_run(two_stops({-10.0, -0.3}), leader).result);
    REQUIRE(states.size() == 7);  // the start; two makes, full load; two breaks, full load
    for (const structure_state& s : states) {
      if (s.step != 1) continue;
      INFO("increment " << s.number);
      const a_run part(two_stops({-10.0 * s.fraction}), leader);
      CHECK(largest_difference(s.displacement, part.result.record.steps.back().end.displacement) < 1e-12);
      CHECK(s.displacement[8] < -1e-3);
    }
  }
}

TEST_CASE(
    "a state has the statuses after its events, and distinguishes a pair at its face from a pressed pair") {
  const a_run r(two_stops({-10.0}), "cpp");
  const std::vector<structure_state> states = pictures_of(r.result);
  REQUIRE(states.size() == 4);
  CHECK(states[1].isep == std::vector<int>{in_contact, separated});
  const auto look = [&](std::size_t state, std::size_t pair) {
    return results_of(r.what, {}, states[state]).pairs[pair].look;
  };
  CHECK(look(1, 0) == pair_state::at_face);
  CHECK(look(1, 1) == pair_state::open);
  CHECK(look(2, 0) == pair_state::closed);
}

TEST_CASE("the drawn state at the end of a step equals the state of the path, to the bit") {
  const a_run r(two_stops({-10.0, -0.3, -12.0}));
  std::size_t ends = 0;
  for (const path_moment& m : moments_of(r.result)) {
    if (!m.is_end) continue;
    CHECK(path_states(r.result).at(m).displacement == r.result.record.steps.at(ends++).end.displacement);
  }
  CHECK(ends == 3);
}

TEST_CASE("only some states of a long path are drawn, in order, and the first and the last are among them") {
  for (int steps = 30; steps < 46; ++steps) {
    INFO(steps << " steps");
    std::vector<double> there_and_back;
    for (int i = 0; i < steps; ++i) there_and_back.push_back(i % 2 == 0 ? -10.0 : -0.3);
    const a_run r(two_stops(there_and_back), "cpp");
    CHECK(moments_of(r.result).back().at == 3 * steps);
    const std::vector<structure_state> states = pictures_of(r.result, 12);
    CHECK(states.size() <= 12);
    CHECK(states.size() >= 4);
    CHECK(states.front().step == 0);
    CHECK(states.back().step == steps);
    CHECK(states.back().fraction == 1.0);
    CHECK(
        std::is_sorted(states.begin(), states.end(), [](const structure_state& x, const structure_state& y) {
          return std::pair(x.step, x.number) < std::pair(y.step, y.number);
        }));
  }
}

TEST_CASE("if a structure has many dofs, fewer states of its path are drawn, to save memory") {
  const a_run r(two_stops({-10.0, -0.3, -10.0, -0.3}), "cpp");
  CHECK(pictures_of(r.result).size() == 13);
  const std::vector<structure_state> states = pictures_of(r.result, 100, 90);
  CHECK(states.size() <= 5);
  CHECK(states.back().step == 4);
}

TEST_CASE("if a structure never moved, two equal states are drawn, for the start and for the end") {
  const a_run r(
      "[beam]\nlength = 1\nelements = 8\nEI = 1\n[[support]]\nnode = 1\nfix = \"w\"\n"
      "[[step]]\nuniform = -10\n",
      "cpp");
  CHECK(r.result.end.status == path_status::mechanism);
  const std::vector<structure_state> states = pictures_of(r.result);
  REQUIRE(states.size() == 2);
  CHECK(states.back().number == 0);
  CHECK(states.back().displacement == states.front().displacement);
}
