// Tests Hermite beams against textbook formulas.
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "catch.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

const std::vector<support> clamped_left = {{0, 0, true}, {0, 1, true}};

}  // namespace

TEST_CASE("a cantilever under a tip load P has the deflection P L^3 / 3 EI and linear moments") {
  const beam b = even_beam(2.0, 4, 50.0);
  const load l{{{4, 0, -3.0}}, {}};
  const auto u = displaced(b, clamped_left, l);
  CHECK(u[8] == Approx(-3.0 * 8 / 150).epsilon(1e-13));
  CHECK(u[9] == Approx(-3.0 * 4 / 100).epsilon(1e-13));
  const element_results forces = results_in_elements(b, l, u);
  CHECK(forces.at(0, 1)[0] == Approx(-6.0).epsilon(1e-12));  // hogging is negative
  CHECK(forces.at(1, 1)[1] == Approx(-3.0).epsilon(1e-12));
  // The shear is positive if the left part pushes the right part up.
  for (std::size_t e = 0; e < forces.elements(); ++e)
    for (const double shear : forces.at(e, 0)) CHECK(shear == Approx(3.0).epsilon(1e-12));
  const auto r = reactions(b, l, clamped_left, u);
  CHECK(r[0] == Approx(3.0).epsilon(1e-12));
  CHECK(r[1] == Approx(6.0).epsilon(1e-12));
}

TEST_CASE("a simply supported beam under uniform load is exact at nodes, and has q L^2 / 8 in the middle") {
  const beam b = even_beam(10.0, 6, 7.0);
  const std::vector<support> ends = {{0, 0, true}, {6, 0, true}};
  const load l{{}, {{{-2.0}, {}}}};
  const auto u = displaced(b, ends, l);
  CHECK(u[6] == Approx(-5.0 * 2 * 1e4 / (384 * 7)).epsilon(1e-12));
  const element_results forces = results_in_elements(b, l, u);
  CHECK(forces.at(2, 1)[1] == Approx(25.0).epsilon(1e-12));  // sagging is positive
  CHECK(forces.at(3, 1)[0] == Approx(25.0).epsilon(1e-12));
  CHECK(forces.at(0, 0)[0] == Approx(10.0).epsilon(1e-12));
  CHECK(forces.at(5, 0)[1] == Approx(-10.0).epsilon(1e-12));
  CHECK(forces.at(2, 0)[1] == Approx(0.0).margin(1e-11));
  CHECK(forces.at(0, 1)[0] == Approx(0.0).margin(1e-11));
  const auto r = reactions(b, l, ends, u);
  CHECK(r[0] == Approx(10.0).epsilon(1e-12));
  CHECK(r[1] == Approx(10.0).epsilon(1e-12));
}

TEST_CASE("the EI of a beam may differ from element to element") {
  beam b = even_beam(2.0, 2, 1.0);
  b.EI = {2.0, 1.0};
  const auto u = displaced(b, clamped_left, {{{2, 0, 1.0}}, {}});
  // w = integral of (2 - x)^2 / EI from 0 to 2 = (8 - 1) / 3 / 2 + 1 / 3.
  CHECK(u[4] == Approx(7.0 / 6 + 1.0 / 3).epsilon(1e-13));
}

TEST_CASE("the nodal forces of a polynomial load have the exact resultant and moment on any mesh") {
  beam b;
  b.x = {0.0, 0.3, 1.0, 1.1, 2.0};
  b.EI.assign(4, 1.0);
  std::vector<double> f(10, 0.0);
  add_consistent_loads(b, {{}, {{{20.0, -20.0, 5.0}, {}}}}, f);  // the load 5 (x - 2)^2 of SSNL130
  double force = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    force += f[2 * i];
    moment += f[2 * i] * b.x[i] + f[2 * i + 1];
  }
  CHECK(force == Approx(40.0 / 3).epsilon(1e-14));
  CHECK(moment == Approx(20.0 / 3).epsilon(1e-14));
}

TEST_CASE("a polynomial load of degree 0 is a uniform load, and several distributed loads add up") {
  const beam b = even_beam(3.0, 3, 1.0);
  std::vector<double> whole(8, 0.0);
  std::vector<double> parts(8, 0.0);
  add_consistent_loads(b, {{}, {{{-1.0}, {}}}}, whole);
  add_consistent_loads(b, {{}, {{{-1.0, 0.0}, {0, 1}}, {{-0.25}, {2}}, {{-0.75}, {2}}}}, parts);
  for (std::size_t i = 0; i < 8; ++i) CHECK(parts[i] == Approx(whole[i]).margin(1e-15));
}

TEST_CASE("a rigid-body motion of any size gives a beam no moments") {
  const beam b = even_beam(10.0, 100, 1e4);
  std::vector<double> u;
  for (const double x : b.x) {
    u.push_back(1000.0 + 3.0 * x);
    u.push_back(3.0);
  }
  const element_results forces = results_in_elements(b, {}, u);
  REQUIRE(forces.elements() == 100);
  for (std::size_t e = 0; e < 100; ++e)
    for (const double moment : forces.at(e, 1)) CHECK(std::abs(moment) < 1e-4);
}

TEST_CASE("a beam on two springs k sinks by F / 2k, and each spring reacts with half of F") {
  const beam b = even_beam(4.0, 2, 1e6);
  const std::vector<support> springs = {{0, 0, false, 10.0}, {2, 0, false, 10.0}};
  const load l{{{1, 0, -4.0}}, {}};
  const auto u = displaced(b, springs, l);
  CHECK(u[0] == Approx(-0.2).epsilon(1e-9));
  const auto r = reactions(b, l, springs, u);
  CHECK(r[0] == Approx(2.0).epsilon(1e-9));
  CHECK(r[1] == Approx(2.0).epsilon(1e-9));
}

TEST_CASE("a rotational spring k at the root of a cantilever increases the tip deflection by F L^2 / k") {
  const beam b = even_beam(1.0, 1, 1.0);
  const std::vector<support> soft = {{0, 0, true}, {0, 1, false, 2.0}};
  const auto u = displaced(b, soft, {{{1, 0, 1.0}}, {}});
  CHECK(u[2] == Approx(1.0 / 3 + 1.0 / 2).epsilon(1e-13));
}

TEST_CASE(
    "a beam whose stiffness exceeds the range of doubles is refused, and the message names the element") {
  beam b = even_beam(1e-150, 2, 1.0);
  CHECK_THROWS_WITH(build(b, clamped_left, {}), Catch::Matchers::Contains("element 1"));
}

TEST_CASE("a beam has two rigid-body motions, a translation and a rotation about its middle") {
  beam b;
  b.x = {2.0, 3.0, 5.0, 6.0};
  b.EI.assign(3, 1.0);
  const linear_structure s = build(b, {}, {});
  CHECK(s.rigid_rows == std::vector<rigid_row>{{1, -1, 0},
                                               {0, 0.5, 0},
                                               {1, -0.5, 0},
                                               {0, 0.5, 0},
                                               {1, 0.5, 0},
                                               {0, 0.5, 0},
                                               {1, 1, 0},
                                               {0, 0.5, 0}});
  for (std::size_t motion = 0; motion < 2; ++motion) {
    std::vector<double> u;
    for (const rigid_row& row : s.rigid_rows) u.push_back(row[motion]);
    for (const double force : product(s.stiffness.band(), u)) CHECK(force == Approx(0.0).margin(1e-14));
  }
}

TEST_CASE("a support and a pair together remove both rigid-body motions of a beam") {
  const beam b = even_beam(2.0, 2, 1.0);
  const std::vector<support> one = {{0, 0, true}};
  const linear_structure s = build(b, one, {{2, 1, 0.5, 1.0, false}});
  CHECK(s.rigid_motions == 2);
  CHECK(s.held_by([](std::size_t) { return false; }).rank() == 1);
  CHECK(s.held_by([](std::size_t) { return true; }).rank() == 2);
  CHECK(s.dof_of_pair(0) == 4);
}
