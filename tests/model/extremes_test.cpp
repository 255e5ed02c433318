#include "contct/model/extremes.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include "catch.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

value_range range_named(const std::vector<value_range>& all, std::string_view name) {
  for (const value_range& r : all)
    if (r.name == name) return r;
  FAIL("no range of that name");
  return {};
}

load even(double q) {
  return {{}, {{{q}, {}}}};
}

constexpr double rounding = 1e-12;

}  // namespace

TEST_CASE("A propped cantilever of two elements has its sagging moment at 5/8 of the length, 9 q L^2 / 128") {
  const beam b{{0, 3, 6}, {1e4, 1e4}};
  const double q = -1000;
  const std::vector<double> u = displaced(b, {{0, 0, true}, {0, 1, true}, {2, 0, true}}, even(q));
  const auto all = ranges_of({b}, even(q), u, {});
  const value_range m = range_named(all, "moment");
  CHECK(m.most.value == Approx(9.0 / 128 * 1000 * 36).epsilon(rounding));
  CHECK(m.most.x == Approx(6.0 * 5 / 8).epsilon(rounding));
  CHECK(m.most.node == -1);
  CHECK(m.least.value == Approx(-1000.0 * 36 / 8).epsilon(rounding));
  CHECK(m.least.x == 0.0);
  CHECK(m.least.node == 0);
  const value_range v = range_named(all, "shear");
  CHECK(v.most.value == Approx(5.0 / 8 * 6000).epsilon(rounding));
  CHECK(v.least.value == Approx(-3.0 / 8 * 6000).epsilon(rounding));
}

TEST_CASE(
    "One element between two supports has the deflection 5 q L^4 / 384 EI at midspan, where there is no "
    "node") {
  const beam b{{0, 2}, {10.0}};
  const std::vector<double> u = displaced(b, {{0, 0, true}, {1, 0, true}}, even(-3));
  const value_range w = range_named(ranges_of({b}, even(-3), u, {}), "w");
  CHECK(w.least.value == Approx(-5.0 / 384 * 3 * 16 / 10).epsilon(rounding));
  CHECK(w.least.x == Approx(1.0).epsilon(1e-7));
  CHECK(w.most.value == 0.0);
  const value_range clamped = range_named(
      ranges_of({b}, even(-3),
                displaced(b, {{0, 0, true}, {0, 1, true}, {1, 0, true}, {1, 1, true}}, even(-3)), {}),
      "w");
  CHECK(clamped.least.value == Approx(-1.0 / 384 * 3 * 16 / 10).epsilon(rounding));
}

TEST_CASE("Under a load that grows with x, the largest moment is where the shear is zero, at L / sqrt 3") {
  const double L = 4;
  const load l{{}, {{{0.0, -2.0}, {}}}};  // q = -2 x: w0 = 2 L
  for (const int elements : {1, 2, 7}) {
    beam b;
    for (int i = 0; i <= elements; ++i) b.x.push_back(L * i / elements);
    b.EI.assign(elements, 50.0);
    const std::vector<double> u = displaced(b, {{0, 0, true}, {elements, 0, true}}, l);
    const auto all = ranges_of({b}, l, u, {});
    const value_range m = range_named(all, "moment");
    CHECK(m.most.value == Approx(2 * L * L * L / 9 / std::sqrt(3.0)).epsilon(rounding));
    CHECK(m.most.x == Approx(L / std::sqrt(3.0)).epsilon(1e-7));
    const value_range w = range_named(all, "w");
    CHECK(w.least.value == Approx(-0.00652 * 2 * std::pow(L, 5) / 50).epsilon(1e-3));
    CHECK(w.least.x == Approx(0.519 * L).epsilon(1e-3));
  }
}

TEST_CASE("The derivatives of an element's deflection line are slope, moment, shear and load") {
  const beam b{{1.0, 1.5, 4.0}, {20.0, 50.0}};
  const load l{{{1, 0, -3.0}}, {{{1.0, -2.0, 0.5}, {1}}, {{4.0}, {}}}};
  const std::vector<double> u = displaced(b, {{0, 0, true}, {0, 1, true}, {2, 0, true}}, l);
  const beam_lines lines(b, l, u);
  const element_results ends = results_in_elements(b, l, u);
  for (int e = 0; e < 2; ++e) {
    const element_line line = lines.at(e);
    CHECK(line.left == b.x[e]);
    CHECK(polynomial_at(line.w, 1.0) == Approx(u[2 * e + 2]).epsilon(1e-10).margin(1e-14));
    CHECK(polynomial_at(line.slope, 0.0) == Approx(u[2 * e + 1]).margin(1e-15));
    CHECK(polynomial_at(line.slope, 1.0) == Approx(u[2 * e + 3]).epsilon(1e-10));
    CHECK(polynomial_at(line.moment, 1.0) == Approx(ends.at(e, 1)[1]).epsilon(1e-10).margin(1e-10));
    CHECK(polynomial_at(line.shear, 1.0) == Approx(ends.at(e, 0)[1]).epsilon(1e-10));
    const double t = 0.3, d = 1e-4;
    const auto slope_of = [&](const auto& p) {
      return (polynomial_at(p, t + d) - polynomial_at(p, t - d)) / (2 * d * line.h);
    };
    const double x = line.left + t * line.h;
    CHECK(slope_of(line.w) == Approx(polynomial_at(line.slope, t)).epsilon(1e-6));
    CHECK(b.EI[e] * slope_of(line.slope) == Approx(polynomial_at(line.moment, t)).epsilon(1e-6));
    CHECK(slope_of(line.moment) == Approx(polynomial_at(line.shear, t)).epsilon(1e-6));
    CHECK(slope_of(line.shear) == Approx(4.0 + (e == 1 ? 1 - 2 * x + 0.5 * x * x : 0.0)).epsilon(1e-6));
  }
}

TEST_CASE(
    "A plate's largest moments are found at corners of elements, and its largest deflection at a node") {
  const plate p{{0, 1, 2}, {0, 2, 4}, 10.0, 0.3};
  std::vector<double> u(p.dofs(), 0.0);
  for (std::size_t node = 0; node < 9; ++node) {  // for w = x^2, mx = 2 D and my = 2 nu D
    const double x = p.x[node % 3];
    u[3 * node] = x * x;
    u[3 * node + 1] = 2 * x;
  }
  const auto all = ranges_of({p}, {}, u, {});
  REQUIRE(all.size() == 4);
  CHECK(range_named(all, "w").most.value == 4.0);
  CHECK(range_named(all, "w").most.x == 2.0);
  CHECK(range_named(all, "w").most.node == 2);
  CHECK(range_named(all, "mx").least.value == Approx(20.0));
  CHECK(range_named(all, "mx").most.value == Approx(20.0));
  CHECK(range_named(all, "my").most.value == Approx(6.0));
  CHECK(range_named(all, "mxy").largest().value == Approx(0.0).margin(1e-12));
}

TEST_CASE("the largest and the least deflection of a plate have the x and y of the node") {
  const plate p{{0, 1, 3}, {0, 2, 5, 9}, 10.0, 0.3};
  std::vector<double> u(p.dofs(), 0.0);
  u[21] = 2.0;   // middle node of the third line
  u[15] = -1.0;  // last node of the second line
  const value_range w = range_named(ranges_of({p}, {}, u, {}), "w");
  CHECK((w.most.node == 7 && w.most.x == 1.0 && w.most.y == 5.0));
  CHECK((w.least.node == 5 && w.least.x == 3.0 && w.least.y == 2.0));
}

TEST_CASE(
    "if a plate's moment grows along x, the least is at the left side of an element and the largest at the "
    "right") {
  const plate p{{0, 2}, {0, 3}, 10.0, 0.0};
  std::vector<double> u(p.dofs(), 0.0);
  for (std::size_t node = 0; node < 4; ++node) {  // w = x^3: mx = 6 D x
    const double x = p.x[node % 2];
    u[3 * node] = x * x * x;
    u[3 * node + 1] = 3 * x * x;
  }
  const value_range mx = range_named(ranges_of({p}, {}, u, {}), "mx");
  CHECK(mx.least.value == Approx(0.0).margin(1e-10));
  CHECK(mx.least.x == 0.0);
  CHECK(mx.most.value == Approx(6 * 10.0 * 2));
  CHECK(mx.most.x == 2.0);
}

TEST_CASE("if the deflection grows between two nodes, the largest deflection is that of the second node") {
  const beam b{{0, 1, 2, 4}, {1.0, 1.0, 1.0}};
  std::vector<double> u;
  for (const double x : b.x) u.insert(u.end(), {x * x, 2 * x});
  const beam_lines lines(b, {}, u);
  const value_range w = deflections_between(lines, u, 1, 3);
  CHECK(w.least.value == 1.0);
  CHECK(w.least.node == 1);
  CHECK(w.most.value == 16.0);
  CHECK(w.most.x == 4.0);
  CHECK(w.most.node == 3);
}

TEST_CASE(
    "if shear and moment at element ends are given, the polynomials of each element begin with these "
    "values") {
  const beam b{{0, 1, 2, 3}, {1.0, 1.0, 1.0}};
  const std::vector<double> given = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
  const std::vector<double> u(8, 0.0);
  const beam_lines lines(b, {}, u, given);
  for (int e = 0; e < 3; ++e) {
    CHECK(lines.at(e).shear[0] == given[std::size_t{4} * e]);
    CHECK(lines.at(e).moment[0] == given[std::size_t{4} * e + 2]);
    CHECK(lines.ends().at(e, 1)[1] == given[std::size_t{4} * e + 3]);
  }
}

TEST_CASE("a moment that is constant along a beam has its extreme at the first node") {
  const beam b{{0, 1, 2, 4}, {1.0, 1.0, 1.0}};
  std::vector<double> u;
  for (const double x : b.x) u.insert(u.end(), {x * x, 2 * x});  // M = 2 everywhere
  const value_range m = range_named(ranges_of({b}, {}, u, {}), "moment");
  CHECK((m.least.value == 2.0 && m.most.value == 2.0));
  CHECK((m.least.node == 0 && m.most.node == 0));
  CHECK((m.least.x == 0.0 && m.most.x == 0.0));
}

TEST_CASE("if the largest deflection is just before the end of an element, the extreme is found there") {
  // The deflection w = -0.24 + 0.91 t - 0.24 t^4 needs only a load of -24 * 0.24.
  const beam b{{0, 1}, {1.0}};
  const std::vector<double> u = {-0.24, 0.91, 0.43, 0.91 - 4 * 0.24};
  const value_range w = range_named(ranges_of({b}, even(-24 * 0.24), u, {}), "w");
  const double t = std::cbrt(0.91 / 0.96);
  CHECK(w.most.node == -1);
  CHECK(w.most.x == Approx(t).epsilon(1e-6));
  CHECK(w.most.value == Approx(-0.24 + 0.91 * t - 0.24 * std::pow(t, 4)).epsilon(1e-12));
  CHECK(w.most.value > 0.43);
}

TEST_CASE("the place of an extreme is the first of all places whose values are equal except for rounding") {
  const auto point = [](double x, double value) { return placed_load{load_kind::point, x, x, {value}}; };
  struct expected {
    std::string_view name;
    double least, most;  // x
  };
  struct example {
    std::vector<double> x;
    load acting;
    std::vector<support> supports;
    std::vector<expected> places;
  };
  const auto loaded = [](std::vector<placed_load> placed, std::vector<point_load> points = {}) {
    load l{std::move(points), {}};
    l.placed = std::move(placed);
    return l;
  };
  const std::vector<support> ends = {{0, 0, true}, {1, 0, true}};
  const std::vector<support> three = {{0, 0, true}, {3, 0, true}};
  const std::vector<support> clamped = {{0, 0, true}, {0, 1, true}};
  std::vector<double> long_beam(6001);  // has more values than `extremes` remembers
  std::iota(long_beam.begin(), long_beam.end(), 0.0);
  const example examples[] = {
      {long_beam, loaded({}, {{6000, 0, 0.3}}), clamped, {{"w", 0, 6000}}},
      // A constant shear on both sides of a load, in one element, in several, and on an overhang without
      // shear.
      {{0, 10}, loaded({point(3.3, -7.5)}), ends, {{"shear", 3.3, 0}, {"moment", 0, 3.3}, {"w", 4.55, 0}}},
      {{0, 1.1, 2.3, 10}, loaded({point(3.3, -7.5)}), three, {{"shear", 3.3, 0}, {"moment", 0, 3.3}}},
      {{0, 0.7, 1.3, 2.9}, loaded({}, {{1, 0, 0.3}}), clamped, {{"shear", 0, 0.7}, {"moment", 0.7, 0}}},
      {{0, 0.7, 1.3, 2.9}, loaded({}, {{3, 0, 0.3}}), clamped, {{"shear", 0, 0}, {"moment", 2.9, 0}}},
      // A constant moment over several elements, from a moment at the end.
      {{0, 0.7, 1.3, 2.9}, loaded({}, {{3, 1, 0.3}}), clamped, {{"moment", 0, 0}}},
      // A constant moment between two equal loads, inside and at nodes.
      {{0, 9}, loaded({point(3.1, -7.7), point(5.9, -7.7)}), ends, {{"moment", 0, 3.1}, {"shear", 5.9, 0}}},
      {{0, 3.1, 5.9, 9}, loaded({}, {{1, 0, -7.7}, {2, 0, -7.7}}), three, {{"moment", 0, 3.1}}},
      // A rigid part, w = 0 up to a load, and extremes just inside an element.
      {{0, 1.7, 2.2, 3.9}, loaded({}, {{1, 0, -1}}), three, {{"w", 1.8735, 0}, {"moment", 0, 1.7}}},
  };
  int compared = 0;
  for (const example& e : examples) {
    const beam b{e.x, std::vector<double>(e.x.size() - 1, 1e4)};
    const auto all = ranges_of({b}, e.acting, displaced(b, e.supports, e.acting), {});
    for (const expected& at : e.places) {
      const value_range found = range_named(all, at.name);
      CAPTURE(&e - examples, at.name, found.least.value, found.most.value);
      CHECK(found.least.x == Approx(at.least).margin(0.01));
      CHECK(found.most.x == Approx(at.most).margin(0.01));
      compared += 2;
    }
  }
  CHECK(compared == 32);
}
