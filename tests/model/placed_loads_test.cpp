// Tests loads between nodes against textbook formulas.
#include "contct/model/placed_loads.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "catch.hpp"
#include "contct/model/extremes.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

load placed(std::vector<placed_load> all) {
  load l;
  l.placed = std::move(all);
  return l;
}

load uniform(double q, double from, double to) {
  return placed({{load_kind::force, from, to, {q}}});
}

load curved(double curvature, double from, double to) {
  return placed({{load_kind::curvature, from, to, {curvature}}});
}

/// Returns a beam of length L, with nodes at the ends and at `inside`.
beam bar(double L, double EI, std::vector<double> inside = {}) {
  beam b;
  b.x = std::move(inside);
  b.x.insert(b.x.begin(), 0.0);
  b.x.push_back(L);
  b.EI.assign(b.x.size() - 1, EI);
  return b;
}

std::vector<support> on_two_supports(const beam& b) {
  return {{0, 0, true}, {b.nodes() - 1, 0, true}};
}

const std::vector<support> held_left = {{0, 0, true}, {0, 1, true}};

/// Returns the ranges of w, moment and shear.
std::vector<value_range> solved(const beam& b, const std::vector<support>& supports, const load& l) {
  return ranges_of({b}, l, displaced(b, supports, l), {});
}

constexpr double few_roundings = 1e-13;

}  // namespace

TEST_CASE(
    "Under a load q from a to b, a simple beam with left reaction R has the largest moment R (a + R / 2q) at "
    "x = a + R / q") {
  for (const beam& b : {bar(10, 1e4), bar(10, 1e4, {1.0, 3.0, 4.5, 8.0})}) {
    const auto r = solved(b, on_two_supports(b), uniform(-40, 2, 5));
    const double R = 40 * 3 * 0.65;  // the middle of the load is 6.5 from the right end
    CHECK(r[1].most.value == Approx(R * (2 + R / 80)).epsilon(few_roundings));
    CHECK(r[1].most.x == Approx(2 + R / 40).epsilon(1e-7));
    CHECK(r[2].most.value == Approx(R).epsilon(few_roundings));
    CHECK(r[2].least.value == Approx(-(120 - R)).epsilon(few_roundings));
    CHECK(r[1].least.value == Approx(0.0).margin(1e-12));
  }
}

TEST_CASE(
    "One element as a simple beam is exact under a force P between nodes, and has the moment P a b / L") {
  const beam b = bar(10, 1e4);
  const load l = placed({{load_kind::point, 3.3, 3.3, {-75}}});
  const auto u = displaced(b, on_two_supports(b), l);
  const auto r = ranges_of({b}, l, u, {});
  CHECK(r[1].most.value == Approx(75 * 3.3 * 6.7 / 10).epsilon(few_roundings));
  CHECK(r[1].most.x == 3.3);
  CHECK(r[2].most.value == Approx(75 * 0.67).epsilon(few_roundings));
  CHECK(r[2].least.value == Approx(-75 * 0.33).epsilon(few_roundings));
  const std::vector<element_line> pieces = beam_lines(b, l, u).pieces(0);
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].right == 3.3);
  CHECK(pieces[1].left == 3.3);
  const double under_it = -75 * 3.3 * 3.3 * 6.7 * 6.7 / (3 * 1e4 * 10);
  CHECK(pieces[1].w[0] == Approx(under_it).epsilon(few_roundings));
  CHECK(polynomial_at(pieces[0].w, 1.0) == Approx(under_it).epsilon(few_roundings));
  CHECK(polynomial_at(pieces[1].w, 1.0) == Approx(0.0).margin(1e-14));
}

TEST_CASE(
    "Under a moment m, a simple beam of length L has the shear m / L, and the bending moment jumps by m") {
  const beam b = bar(8, 50);
  const load l = placed({{load_kind::moment, 3, 3, {16}}});
  const auto r = solved(b, on_two_supports(b), l);
  CHECK(r[1].most.value == Approx(16.0 * 3 / 8).epsilon(few_roundings));
  CHECK(r[1].least.value == Approx(-16.0 * 5 / 8).epsilon(few_roundings));
  CHECK((r[1].most.x == 3 && r[1].least.x == 3));
  CHECK(r[2].most.value == Approx(2.0).epsilon(few_roundings));
  CHECK(r[2].least.value == Approx(2.0).epsilon(few_roundings));
}

TEST_CASE("An imposed curvature c deflects a simple beam by c L^2 / 8, and a cantilever by c L^2 / 2") {
  for (const beam& b : {bar(4, 7e3), bar(4, 7e3, {1.0, 2.5})}) {
    const auto r = solved(b, on_two_supports(b), curved(1.2e-3, 0, 4));
    CHECK(r[0].least.value == Approx(-1.2e-3 * 16 / 8).epsilon(few_roundings));
    CHECK(r[0].least.x == Approx(2.0).epsilon(1e-7));
    const auto free = solved(b, held_left, curved(1.2e-3, 0, 4));
    CHECK(free[0].most.value == Approx(1.2e-3 * 16 / 2).epsilon(few_roundings));
    for (const auto& all : {r, free})
      for (std::size_t name : {1, 2})
        CHECK(std::max(-all[name].least.value, all[name].most.value) < 1e-13 * 7e3 * 1.2e-3);
  }
}

TEST_CASE(
    "A curvature c from a to b rotates the rest of a cantilever by c (b - a) about the middle between a and "
    "b") {
  const beam b = bar(5, 10, {2.0});
  const auto u = displaced(b, held_left, curved(0.02, 1, 3.5));
  CHECK(u[4] == Approx(0.02 * 2.5 * (5 - 2.25)).epsilon(few_roundings));
  CHECK(u[5] == Approx(0.02 * 2.5).epsilon(few_roundings));
  // The deflection is c / 2 at a distance of 1 from the start of the curvature.
  CHECK(u[2] == Approx(0.02 * 0.5).epsilon(few_roundings));
}

TEST_CASE("An imposed curvature c of a beam with clamped ends makes the moment -EI c, but no deflection") {
  for (const beam& b : {bar(4, 50), bar(4, 50, {1.0, 2.5})}) {
    const int last = b.nodes() - 1;
    const auto r =
        solved(b, {{0, 0, true}, {0, 1, true}, {last, 0, true}, {last, 1, true}}, curved(0.03, 0, 4));
    CHECK(r[1].least.value == Approx(-50 * 0.03).epsilon(few_roundings));
    CHECK(r[1].most.value == Approx(-50 * 0.03).epsilon(few_roundings));
    CHECK(std::max(-r[0].least.value, r[0].most.value) < 1e-16);
    CHECK(std::max(-r[2].least.value, r[2].most.value) < 1e-14);
  }
}

TEST_CASE("A load has the same nodal forces if given by coordinates and if given by elements") {
  const beam b = bar(3, 2, {0.7, 1.1, 2.0});
  const std::vector<double> q = {0.3, -2.0, 0.5};
  std::vector<double> by_place(8);
  std::vector<double> by_elements(8);
  add_consistent_loads(b, placed({{load_kind::force, 0.7, 2.0, q}}), by_place);
  add_consistent_loads(b, {{}, {{q, {1, 2}}}}, by_elements);
  for (std::size_t dof = 0; dof < 8; ++dof)
    CHECK(by_place[dof] == Approx(by_elements[dof]).epsilon(1e-15).margin(1e-16));
}

TEST_CASE("The factor of a load multiplies the force, the moment and the resultant of the load") {
  const beam b = bar(10, 1e4);
  load l = placed({{load_kind::force, 2, 5, {-40}}, {load_kind::point, 6, 6, {-10}}});
  l.placed[0].factor = 1.35;
  l.placed[1].factor = 1.5;
  const resultant r = resultant_of(b, l);
  CHECK(r.force == -177.0);          // 1.35 * 120 + 15
  CHECK(r.moments.at(0) == -657.0);  // 162 * 3.5 + 15 * 6
  const auto u = displaced(b, on_two_supports(b), l);
  const auto forces = reactions(b, l, on_two_supports(b), u);
  CHECK(forces[0] == Approx(162 * 0.65 + 15 * 0.4).epsilon(few_roundings));
  CHECK(forces[1] == Approx(162 * 0.35 + 15 * 0.6).epsilon(few_roundings));
}

TEST_CASE(
    "A mixture of two loads contains the placed loads of both, each multiplied by the factor of its load") {
  const load at =
      mix(uniform(-40, 2, 5), placed({{load_kind::force, 2, 5, {-60}}, {load_kind::point, 1, 1, {8}}}), 0.25);
  REQUIRE(at.placed.size() == 2);
  CHECK(at.placed[0].polynomial[0] == -45);
  CHECK((at.placed[0].from == 2 && at.placed[0].to == 5));
  CHECK((at.placed[1].what == load_kind::point && at.placed[1].polynomial[0] == 2));
}

namespace {

/// Returns a plate whose elements all have different sizes.
plate uneven_grid() {
  return {{-1.0, 0.2, 0.5, 2.0}, {0.0, 0.7, 1.0, 1.1, 3.0}, 2.5, 0.3};
}

load rectangle(double pressure, std::array<double, 2> x, std::array<double, 2> y) {
  return placed({{load_kind::force, x[0], x[1], {pressure}, {y[0], y[1]}}});
}

/// Returns a load's work on x^m y^n, which the elements reproduce exactly.
double work_on(const plate& p, const load& l, int m, int n) {
  std::vector<double> f(p.dofs());
  add_consistent_loads(p, l, f);
  double work = 0.0;
  for (int node = 0; node < p.nodes(); ++node) {
    const double x = p.x[node % p.columns()];
    const double y = p.y[node / p.columns()];
    const auto power = [](double of, int e) { return e < 0 ? 0.0 : std::pow(of, e); };
    const std::size_t at = 3 * static_cast<std::size_t>(node);
    work += f[at] * power(x, m) * power(y, n) + f[at + 1] * m * power(x, m - 1) * power(y, n) +
            f[at + 2] * n * power(x, m) * power(y, n - 1);
  }
  return work;
}

}  // namespace

TEST_CASE("A pressure on any rectangle of a plate does exact work on cubic polynomials, x^3 y and x y^3") {
  const plate p = uneven_grid();
  const load l = rectangle(3.0, {-0.3, 1.3}, {0.25, 1.05});
  const auto moment = [](double a, double b, int n) {
    return (std::pow(b, n + 1) - std::pow(a, n + 1)) / (n + 1);
  };
  for (const auto& [m, n] : {std::pair{0, 0},
                             {1, 0},
                             {0, 1},
                             {2, 0},
                             {1, 1},
                             {0, 2},
                             {3, 0},
                             {2, 1},
                             {1, 2},
                             {0, 3},
                             {3, 1},
                             {1, 3}}) {
    CAPTURE(m, n);
    CHECK(work_on(p, l, m, n) == Approx(3.0 * moment(-0.3, 1.3, m) * moment(0.25, 1.05, n)).epsilon(1e-13));
  }
}

TEST_CASE(
    "A pressure on a rectangle between grid lines equals a pressure on the elements inside, to the bit") {
  const plate p = uneven_grid();
  std::vector<double> by_place(p.dofs());
  std::vector<double> by_elements(p.dofs());
  add_consistent_loads(p, rectangle(-0.7, {0.2, 2.0}, {0.7, 1.1}), by_place);
  add_consistent_loads(p, {{}, {{{-0.7}, {4, 5, 7, 8}}}}, by_elements);
  CHECK(by_place == by_elements);
}

TEST_CASE(
    "The resultant of a pressure on a rectangle is pressure times area, at the centre of the rectangle") {
  const resultant r = resultant_of(uneven_grid(), rectangle(0.5, {-0.3, 1.3}, {0.25, 1.05}));
  CHECK(r.force == 0.64);
  CHECK(r.moments.at(0) == 0.32);
  CHECK(r.moments.at(1) == 0.416);
}

TEST_CASE("Pressures on a plate that cancel as decimals have nodal forces of exactly 0") {
  const plate p = uneven_grid();
  load l = placed({{load_kind::force, -1.0, 0.3, {0.1}, {0.0, 0.9}},
                   {load_kind::force, 0.3, 2.0, {0.1}, {0.0, 0.9}},
                   {load_kind::force, -1.0, 2.0, {0.1}, {0.9, 3.0}}});
  l.distributed.push_back({{-0.1}, {}});
  std::vector<double> f(p.dofs());
  add_consistent_loads(p, l, f);
  CHECK(std::all_of(f.begin(), f.end(), [](double x) { return x == 0.0; }));
}
