// Tests beams against textbook formulas: displacements, moments, shears and reactions, also with hinges and
// under loads between nodes.
#include <cmath>

#include "catch.hpp"
#include "contct/kernel/call.hpp"
#include "structure/closed_forms.hpp"

using namespace contct;

TEST_CASE("beams have the displacements, moments, shears and reactions of textbook formulas") {
  check_beams("A cantilever under a tip load P has w = P L^3 / 3 EI and linear moments; hogging is negative",
              {even_beam(2.0, 4, 50.0)}, held({0}, {0}), tip_load(4, -3), "u8 u9 m0.0 m1.1 v0.0 v3.1 r0 r1",
              {-3.0 * 8 / 150, -3.0 * 4 / 100, -6, -3, 3, 3, 3, 6});
  check_beams("A simple beam under q is exact at nodes, and has q L^2 / 8 in the middle; sagging is positive",
              {even_beam(10.0, 6, 7.0)}, held({0, 6}), uniform(-2), "u6 m2.1 m3.0 v0.0 v5.1 v2.1 m0.0 r0 r1",
              {-5.0 * 2 * 1e4 / (384 * 7), 25, 25, 10, -10, 0, 0, 10, 10}, 1e-12);
  beam two_stiffnesses = bar({0, 1, 2}, 1);
  two_stiffnesses.EI = {2, 1};
  check_beams("EI may differ from element to element: w is the integral of (2 - x)^2 / EI from 0 to 2",
              {two_stiffnesses}, held({0}, {0}), tip_load(2, 1), "u4", {7.0 / 6 + 1.0 / 3});
  check_beams("A rotational spring k at the root of a cantilever increases the tip deflection by F L^2 / k",
              {bar({0, 1}, 1)}, {{0, 0, true}, {0, 1, false, 2.0}}, tip_load(1, 1), "u2",
              {1.0 / 3 + 1.0 / 2});
  check_beams("A propped cantilever has its sagging moment at 5/8 of the length, 9 q L^2 / 128",
              {bar({0, 3, 6}, 1e4)}, held({0, 2}, {0}), uniform(-1000), "m> xm> m< xm< v> v<",
              {9.0 / 128 * 36000, 6.0 * 5 / 8, -36000.0 / 8, 0, 5.0 / 8 * 6000, -3.0 / 8 * 6000}, 1e-13,
              1e-12);
  check_beams("One element between two supports has 5 q L^4 / 384 EI at midspan, where there is no node",
              {bar({0, 2}, 10)}, held({0, 1}), uniform(-3), "w< xw< w>", {-5.0 / 384 * 3 * 16 / 10, 1, 0});
  check_beams("One element between two clamps has q L^4 / 384 EI at midspan", {bar({0, 2}, 10)},
              held({0, 1}, {0, 1}), uniform(-3), "w<", {-1.0 / 384 * 3 * 16 / 10});
  const double R = 40 * 3 * 0.65;  // the middle of the load is 6.5 from the right end
  check_beams("Under a load q from a to b, a simple beam has the moment R (a + R / 2q) at x = a + R / q",
              {bar({0, 10}, 1e4), bar({0, 1, 3, 4.5, 8, 10}, 1e4)}, held({0, -1}),
              placed({{load_kind::force, 2, 5, {-40}}}), "m> xm> v> v<",
              {R * (2 + R / 80), 2 + R / 40, R, R - 120});
  check_beams("Its least moment is that of its ends", {bar({0, 10}, 1e4), bar({0, 1, 3, 4.5, 8, 10}, 1e4)},
              held({0, -1}), placed({{load_kind::force, 2, 5, {-40}}}), "m<", {0}, 1e-12);
  check_beams("Under a force P between nodes, a simple beam has the moment P a b / L", {bar({0, 10}, 1e4)},
              held({0, 1}), placed({{load_kind::point, 3.3, 3.3, {-75}}}), "m> xm> v> v<",
              {75 * 3.3 * 6.7 / 10, 3.3, 75 * 0.67, -75 * 0.33}, 1e-13, 0);
  check_beams("Under a moment m, a simple beam has the shear m / L, and the bending moment jumps by m",
              {bar({0, 8}, 50)}, held({0, 1}), placed({{load_kind::moment, 3, 3, {16}}}),
              "m> m< xm> xm< v> v<", {6, -10, 3, 3, 2, 2}, 1e-13, 0);
  const std::vector<beam> soft = {bar({0, 4}, 7e3), bar({0, 1, 2.5, 4}, 7e3)};
  const load warm = curved(1.2e-3, 0, 4);
  check_beams("An imposed curvature c deflects a simple beam by c L^2 / 8", soft, held({0, -1}), warm,
              "w< xw<", {-1.2e-3 * 16 / 8, 2});
  check_beams("An imposed curvature c deflects a cantilever by c L^2 / 2", soft, held({0}, {0}), warm, "w>",
              {1.2e-3 * 16 / 2});
  for (const auto& supports : {held({0, -1}), held({0}, {0})})
    check_beams("An imposed curvature makes no moments if supports do not prevent it", soft, supports, warm,
                "m> m< v> v<", {0, 0, 0, 0}, 8e-13);
  check_beams("A curvature c from a to b rotates the rest of a cantilever by c (b - a) about the middle",
              {bar({0, 2, 5}, 10)}, held({0}, {0}), curved(0.02, 1, 3.5), "u4 u5 u2",
              {0.02 * 2.5 * (5 - 2.25), 0.02 * 2.5, 0.02 * 0.5});
  const std::vector<beam> stiff = {bar({0, 4}, 50), bar({0, 1, 2.5, 4}, 50)};
  check_beams("An imposed curvature c of a beam with clamped ends makes the moment -EI c", stiff,
              held({0, -1}, {0, -1}), curved(0.03, 0, 4), "m< m>", {-1.5, -1.5});
  check_beams("It makes no deflection", stiff, held({0, -1}, {0, -1}), curved(0.03, 0, 4), "w< w>", {0, 0},
              1e-16);
  check_beams("It makes no shear", stiff, held({0, -1}, {0, -1}), curved(0.03, 0, 4), "v< v>", {0, 0}, 1e-14);
  // u2 = -(q a^4 / 8 + R a^3 / 3) / EI; the theta of the hinge is that of the right part.
  check_beams("A propped cantilever with a hinge at x = a has the reaction q (L - a) / 2 at the prop",
              {bar({0, 2, 4}, 100, {1})}, held({0, 2}, {0}), uniform(-6), "u2 u3 m0.0 m0.1 m1.0 r0 r1 r2",
              {-0.28, 0.12, -24, 0, 0, 18, 6, 24}, 1e-12);
  check_beams("At the hinge, the left element has a moment of exactly 0", {bar({0, 2, 4}, 100, {1})},
              held({0, 2}, {0}), uniform(-6), "m0.1", {0}, 0.0);
  check_beams("An element between two hinges sags as a simple beam supported by two cantilevers",
              {bar({0, 1, 3, 4}, 1, {1, 2})}, held({0, 3}, {0, 3}), uniform(-2, {1}), "u2 u3 w< xw<",
              {-2.0 / 3, -2.0 * 8 / 24, -2.0 / 3 - 5.0 / 384 * 2 * 16, 2});
  check_beams("A hinge over a support makes two simple beams of a beam with two spans",
              {bar({0, 1, 2}, 1, {1})}, held({0, 1, 2}), uniform(-8), "r0 r1 u3", {4, 8, -8.0 / 24});
  check_beams(
      "A linear load on a propped element with a hinge at the prop has the clamp moment 7 q0 L^2 / 120",
      {bar({0, 3, 5}, 7, {1})}, held({0, 1, 2}, {0}), {{}, {{{0.0, -2.0}, {0}}}}, "r3", {7.0 * 6 * 9 / 120});
  // Without a moment the spans turn by q L^3 / 12 EI against each other; a moment M turns them back by
  // 2 M L / 3 EI.
  const double L = 2;
  check_beams("A semi-rigid hinge of stiffness 3 EI / 2 L over a support halves the moment q L^2 / 8 there",
              {bar({0, L, 2 * L}, 5, {1}, {1.5 * 5 / L}), bar({0, L, 3, 2 * L}, 5, {1}, {1.5 * 5 / L})},
              held({0, 1, -1}), uniform(-8), "m<", {-8 * L * L / 16}, 1e-12);
  for (const auto& [stiffness, share] : {std::pair(1e-300, 0.0), {1e300, 1.0}})
    check_beams("A hinge of no stiffness to speak of has no moment there, and a very stiff one the whole",
                {bar({0, L, 2 * L}, 5, {1}, {stiffness})}, held({0, 1, -1}), uniform(-8), "m0.1",
                {-share * 8 * L * L / 8}, 1e-12);
  const load grows{{}, {{{0.0, -2.0}, {}}}};  // q = -2 x: w0 = 2 L
  const std::vector<beam> divided = {even_beam(4, 1, 50), even_beam(4, 2, 50), even_beam(4, 7, 50)};
  check_beams("Under a load that grows with x, the largest moment is where the shear is zero, at L / sqrt 3",
              divided, held({0, -1}), grows, "m> xm>", {128 / 9.0 / std::sqrt(3.0), 4 / std::sqrt(3.0)},
              1e-12, 2e-7);
  check_beams("Its least w is 0.00652 w0 L^4 / EI at 0.519 L", divided, held({0, -1}), grows, "w< xw<",
              {-0.00652 * 2 * 1024 / 50, 0.519 * 4}, 1e-3, 2e-3);
  check_beams("A beam on two springs k sinks by F / 2k, and each spring reacts with half of F",
              {even_beam(4, 2, 1e6)}, {{0, 0, false, 10.0}, {2, 0, false, 10.0}}, tip_load(1, -4), "u0 r0 r1",
              {-0.2, 2, 2}, 1e-9);
}

TEST_CASE("the nodal forces of a polynomial load have the exact resultant and moment on any mesh") {
  const beam b = bar({0.0, 0.3, 1.0, 1.1, 2.0}, 1);
  const std::vector<double> f =
      nodal_loads(b, {{}, {{{20.0, -20.0, 5.0}, {}}}}).force;  // the load 5 (x - 2)^2 of SSNL130
  double force = 0.0;
  double moment = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    force += f[2 * i];
    moment += f[2 * i] * b.x[i] + f[2 * i + 1];
  }
  CHECK(force == Approx(40.0 / 3).epsilon(1e-14));
  CHECK(moment == Approx(20.0 / 3).epsilon(1e-14));
}

TEST_CASE("distributed loads add up, and may be given by coordinates or by elements") {
  const std::vector<double> q = {0.3, -2.0, 0.5};
  const std::pair<load, load> rows[] = {
      {uniform(-1), {{}, {{{-1.0, 0.0}, {0, 1}}, {{-0.25}, {2}}, {{-0.75}, {2}}}}},
      {placed({{load_kind::force, 0.7, 2.0, q}}), {{}, {{q, {1, 2}}}}}};
  for (const auto& [one, other] : rows) {
    const std::vector<double> f = nodal_loads(bar({0, 0.7, 1.1, 2.0}, 2), one).force;
    const std::vector<double> g = nodal_loads(bar({0, 0.7, 1.1, 2.0}, 2), other).force;
    for (std::size_t dof = 0; dof < 8; ++dof) CHECK(f[dof] == Approx(g[dof]).epsilon(1e-15).margin(1e-16));
  }
}

TEST_CASE("a rigid-body motion of any size gives a beam no moments") {
  const beam b = even_beam(10.0, 100, 1e4);
  std::vector<double> u;
  for (const double x : b.x) u.insert(u.end(), {1000.0 + 3.0 * x, 3.0});
  const element_results forces = results_in_elements(b, {}, u);
  REQUIRE(forces.elements() == 100);
  for (std::size_t e = 0; e < 100; ++e)
    for (const double moment : forces.at(e, 1)) CHECK(std::abs(moment) < 1e-4);
}

TEST_CASE(
    "a beam whose stiffness exceeds the range of doubles is refused, and the message names the element") {
  CHECK_THROWS_WITH(build(even_beam(1e-150, 2, 1.0), held({0}, {0}), {}),
                    Catch::Matchers::Contains("element 1"));
}

TEST_CASE("a free beam with n hinges has 2 + n rigid-body motions, and none of them needs a force") {
  const linear_structure straight = build(bar({2.0, 3.0, 5.0, 6.0}, 1), {}, {});
  CHECK(straight.rigid_rows == std::vector<rigid_row>{{1, -1, 0},
                                                      {0, 0.5, 0},
                                                      {1, -0.5, 0},
                                                      {0, 0.5, 0},
                                                      {1, 0.5, 0},
                                                      {0, 0.5, 0},
                                                      {1, 1, 0},
                                                      {0, 0.5, 0}});  // about the middle
  const beam b = bar({0, 1, 2.5, 3, 4, 6, 7}, 3, {1, 2, 4});
  for (const linear_structure& s : {straight, build(b, {}, {})}) {
    REQUIRE(s.rigid_motions == (s.dofs() == 8 ? 2 : 5));
    for (int motion = 0; motion < s.rigid_motions; ++motion) {
      std::vector<double> u;
      double largest = 0.0;
      for (const rigid_row& row : s.rigid_rows) u.push_back(row[motion]);
      for (std::size_t dof = 0; dof < u.size(); dof += 2) largest = std::max(largest, std::abs(u[dof]));
      CHECK(largest > 0.0);
      for (const double force : product(s.stiffness.band(), u)) CHECK(force == Approx(0.0).margin(1e-11));
    }
  }
  const auto held_motions = [](const linear_structure& s) {
    return s.held_by([](std::size_t) { return true; }).rank();
  };
  CHECK(held_motions(build(b, held({0, 1, 2, 4, 6}), {})) == 5);
  CHECK(held_motions(build(b, held({0, 6}, {3}), {})) == 3);
  const linear_structure one = build(even_beam(2.0, 2, 1.0), held({0}), {{2, 1, 0.5, 1.0, false}});
  CHECK(one.rigid_motions == 2);
  CHECK(one.held_by([](std::size_t) { return false; }).rank() == 1);
  CHECK(held_motions(one) == 2);
  CHECK(one.pairs[0].dof == 4);
}

TEST_CASE("an element under a force between its nodes has two pieces, which meet under the force") {
  const beam b = bar({0, 10}, 1e4);
  const load l = placed({{load_kind::point, 3.3, 3.3, {-75}}});
  const std::vector<element_line> pieces = beam_lines(b, l, displaced(b, held({0, 1}), l)).pieces(0);
  REQUIRE(pieces.size() == 2);
  CHECK((pieces[0].right == 3.3 && pieces[1].left == 3.3));
  const double under_it = -75 * 3.3 * 3.3 * 6.7 * 6.7 / (3 * 1e4 * 10);
  CHECK(pieces[1].w[0] == Approx(under_it).epsilon(1e-13));
  CHECK(polynomial_at(pieces[0].w, 1.0) == Approx(under_it).epsilon(1e-13));
  CHECK(polynomial_at(pieces[1].w, 1.0) == Approx(0.0).margin(1e-14));
}

TEST_CASE("the factor of a placed load multiplies its force, moment and resultant") {
  const beam b = bar({0, 10}, 1e4);
  load l = placed({{load_kind::force, 2, 5, {-40}}, {load_kind::point, 6, 6, {-10}}});
  l.placed[0].factor = 1.35;
  l.placed[1].factor = 1.5;
  const resultant r = resultant_of(b, l);
  CHECK(r.force == -177.0);          // 1.35 * 120 + 15
  CHECK(r.moments.at(0) == -657.0);  // 162 * 3.5 + 15 * 6
  const auto forces = reactions(b, l, held({0, 1}), displaced(b, held({0, 1}), l));
  CHECK(forces[0] == Approx(162 * 0.65 + 15 * 0.4).epsilon(1e-13));
  CHECK(forces[1] == Approx(162 * 0.35 + 15 * 0.6).epsilon(1e-13));
  const load at = mix(placed({{load_kind::force, 2, 5, {-40}}}),
                      placed({{load_kind::force, 2, 5, {-60}}, {load_kind::point, 1, 1, {8}}}), 0.25);
  REQUIRE(at.placed.size() == 2);
  CHECK(at.placed[0].polynomial[0] == -45);
  CHECK((at.placed[0].from == 2 && at.placed[0].to == 5));
  CHECK((at.placed[1].what == load_kind::point && at.placed[1].polynomial[0] == 2));
}
