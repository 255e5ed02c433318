// Tests beams with hinges against closed forms.
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "contct/kernel/call.hpp"
#include "contct/model/elements.hpp"
#include "contct/model/extremes.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

beam hinged(std::vector<double> x, std::vector<int> hinges, double EI = 1.0) {
  beam b;
  b.EI.assign(x.size() - 1, EI);
  b.x = std::move(x);
  b.hinges = std::move(hinges);
  return b;
}

load uniform_on(double q, std::vector<int> elements = {}) {
  return {{}, {{{q}, std::move(elements)}}};
}

int held_motions(const linear_structure& s) {
  return s.held_by([](std::size_t) { return true; }).rank();
}

constexpr double hinge_rounding = 1e-12;

}  // namespace

TEST_CASE(
    "A propped cantilever with a hinge at x = a has the reaction q (L - a) / 2 at the prop, and the rest at "
    "the clamp") {
  const beam b = hinged({0, 2, 4}, {1}, 100);
  const load l = uniform_on(-6);
  const std::vector<support> supports = {{0, 0, true}, {0, 1, true}, {2, 0, true}};
  const std::vector<double> u = displaced(b, supports, l);
  CHECK(u[2] == Approx(-0.28).epsilon(hinge_rounding));  // -(q a^4 / 8 + R a^3 / 3) / EI, R = 6
  CHECK(u[3] == Approx(0.12).epsilon(hinge_rounding));   // slope of the right part: 0.28 / 2 - q h^3 / 24 EI
  const auto forces = elements_of<double>(b).end_forces(l, u);
  CHECK(forces[0][2] == Approx(-24).epsilon(hinge_rounding));  // -(q a^2 / 2 + R a)
  CHECK(forces[0][3] == 0.0);
  CHECK(forces[1][2] == Approx(0.0).margin(hinge_rounding));
  const std::vector<double> held = reactions({b}, l, supports, u);
  CHECK(held[0] == Approx(18).epsilon(hinge_rounding));
  CHECK(held[1] == Approx(24).epsilon(hinge_rounding));
  CHECK(held[2] == Approx(6).epsilon(hinge_rounding));
}

TEST_CASE("An element between two hinges sags as a simple beam supported by two cantilevers") {
  const beam b = hinged({0, 1, 3, 4}, {1, 2});
  const load l = uniform_on(-2, {1});
  const std::vector<double> u = displaced(b, {{0, 0, true}, {0, 1, true}, {3, 0, true}, {3, 1, true}}, l);
  CHECK(u[2] == Approx(-2.0 / 3).epsilon(hinge_rounding));
  CHECK(u[3] == Approx(-2.0 * 8 / 24).epsilon(hinge_rounding));
  const value_range w = ranges_of({b}, l, u, {})[0];
  CHECK(w.least.value == Approx(-2.0 / 3 - 5.0 / 384 * 2 * 16).epsilon(hinge_rounding));
  CHECK(w.least.x == Approx(2.0).epsilon(1e-7));
}

TEST_CASE("A hinge over a support makes two simple beams of a beam with two spans") {
  const beam b = hinged({0, 1, 2}, {1});
  const std::vector<support> supports = {{0, 0, true}, {1, 0, true}, {2, 0, true}};
  const std::vector<double> u = displaced(b, supports, uniform_on(-8));
  const std::vector<double> held = reactions({b}, uniform_on(-8), supports, u);
  CHECK(held[0] == Approx(4).epsilon(hinge_rounding));
  CHECK(held[1] == Approx(8).epsilon(hinge_rounding));
  CHECK(u[3] == Approx(-8.0 / 24).epsilon(hinge_rounding));
}

TEST_CASE("A linearly growing load on an element with a hinge at the right end is condensed exactly") {
  // The left element is clamped, and its hinge is on a prop. Its clamp moment under q = -2 x is that of a
  // propped cantilever, 7 q0 L^2 / 120.
  const beam b = hinged({0, 3, 5}, {1}, 7);
  const load l = {{}, {{{0.0, -2.0}, {0}}}};
  const std::vector<support> supports = {{0, 0, true}, {0, 1, true}, {1, 0, true}, {2, 0, true}};
  const std::vector<double> u = displaced(b, supports, l);
  CHECK(reactions({b}, l, supports, u)[1] == Approx(7.0 * 6 * 9 / 120).epsilon(hinge_rounding));
}

TEST_CASE("A free beam with n hinges has 2 + n rigid-body motions, and none of them needs a force") {
  const beam b = hinged({0, 1, 2.5, 3, 4, 6, 7}, {1, 2, 4}, 3);
  const linear_structure s = build(b, {}, {});
  REQUIRE(s.rigid_motions == 5);
  for (std::size_t motion = 0; motion < 5; ++motion) {
    std::vector<double> u;
    for (const rigid_row& row : s.rigid_rows) u.push_back(row[motion]);
    CHECK(largest_of({u[0], u[2], u[4], u[6], u[8], u[12]}) > 0.0);
    for (const double force : product(s.stiffness.band(), u)) CHECK(force == Approx(0.0).margin(1e-11));
  }
  std::vector<support> lifted;
  for (const int node : {0, 1, 2, 4, 6}) lifted.push_back({node, 0, true});
  CHECK(held_motions(build(b, lifted, {})) == 5);
  CHECK(held_motions(build(b, std::vector<support>{{0, 0, true}, {6, 0, true}, {3, 1, true}}, {})) == 3);
}

TEST_CASE("Three hinges make a mechanism of a beam, but a load over a support is still in equilibrium") {
  const beam b = hinged({0, 1, 2, 3, 4}, {1, 2, 3});
  const linear_structure s = build(b, std::vector<support>{{0, 0, true}, {2, 0, true}, {4, 0, true}}, {});
  CHECK(held_motions(s) == 3);
  CHECK(s.has_equilibrium(s.truth->work_of({{{2, 0, -1.0}}, {}})) == true);
  CHECK(s.has_equilibrium(s.truth->work_of({{{1, 0, -1.0}}, {}})) == false);
  CHECK(s.has_equilibrium(s.truth->work_of(uniform_on(-1))) == false);
}

TEST_CASE("A hinged beam without enough supports is in equilibrium if pairs carry the load") {
  const beam b = hinged({0, 1, 2, 3}, {1, 2});
  const std::vector<support> ends = {{0, 0, true}, {3, 0, true}};
  const load down = uniform_on(-1);
  const contact_pair below{1, face_below, 0.0, 1.0, false};
  const contact_pair beside{2, face_below, -1.0, 1.0, false};
  const auto is_carried = [&](const std::vector<contact_pair>& pairs) {
    const linear_structure s = build(b, ends, pairs);
    return s.has_equilibrium(s.truth->work_of(down));
  };
  CHECK(is_carried({below}) == false);
  CHECK(is_carried({below, beside}) == true);
  CHECK(is_carried({below, {2, face_above, 1.0, 1.0, false}}) == false);
}
