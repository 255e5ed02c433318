#include "contct/structure/extremes.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include "catch.hpp"
#include "structure/closed_forms.hpp"

using namespace contct;

namespace {

value_range range_named(const std::vector<value_range>& all, std::string_view name) {
  for (const value_range& r : all)
    if (r.name == name) return r;
  FAIL("no range of that name");
  return {};
}

plate square(double thickness) {
  plate p;
  p.x = p.y = {0, 1};
  p.D = 1.0;
  p.thickness = thickness;
  return p;
}

}  // namespace

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
    const double t = 0.3, d = 1e-4, x = line.left + t * line.h;
    const double q = 4.0 + (e == 1 ? 1 - 2 * x + 0.5 * x * x : 0.0);
    for (const auto& [p, slope] : {std::pair(line.w, polynomial_at(line.slope, t)),
                                   {line.slope, polynomial_at(line.moment, t) / b.EI[e]},
                                   {line.moment, polynomial_at(line.shear, t)},
                                   {line.shear, q}})
      CHECK((polynomial_at(p, t + d) - polynomial_at(p, t - d)) / (2 * d * line.h) ==
            Approx(slope).epsilon(1e-6));
  }
}

TEST_CASE("the largest moments of a plate are at corners of elements, and its largest w at a node") {
  const auto extremes_of = [](const plate& p,
                              const std::function<std::array<double, 2>(double)>& w_and_slope) {
    std::vector<double> u;
    for (int node = 0; node < p.nodes(); ++node) {
      const auto [w, slope] = w_and_slope(p.x[node % p.columns()]);
      u.insert(u.end(), {w, slope, 0.0});
    }
    return ranges_of({p}, {}, u, {});
  };
  const auto square = extremes_of({{0, 1, 2}, {0, 2, 4}, 10.0, 0.3},  // w = x^2: mx = 2 D and my = 2 nu D
                                  [](double x) {
                                    return std::array{x * x, 2 * x};
                                  });
  REQUIRE(square.size() == 4);
  CHECK(range_named(square, "w").most.value == 4.0);
  CHECK((range_named(square, "w").most.x == 2.0 && range_named(square, "w").most.node == 2));
  CHECK(range_named(square, "mx").least.value == Approx(20.0));
  CHECK(range_named(square, "mx").most.value == Approx(20.0));
  CHECK(range_named(square, "my").most.value == Approx(6.0));
  CHECK(range_named(square, "mxy").largest().value == Approx(0.0).margin(1e-12));
  const value_range mx = range_named(extremes_of({{0, 2}, {0, 3}, 10.0, 0.0},  // w = x^3: mx = 6 D x
                                                 [](double x) {
                                                   return std::array{x * x * x, 3 * x * x};
                                                 }),
                                     "mx");
  CHECK(mx.least.value == Approx(0.0).margin(1e-10));
  CHECK(mx.most.value == Approx(6 * 10.0 * 2));
  CHECK((mx.least.x == 0.0 && mx.most.x == 2.0));
  const plate p{{0, 1, 3}, {0, 2, 5, 9}, 10.0, 0.3};
  std::vector<double> u(p.dofs(), 0.0);
  u[21] = 2.0;   // middle node of the third line
  u[15] = -1.0;  // last node of the second line
  const value_range w = range_named(ranges_of({p}, {}, u, {}), "w");
  CHECK((w.most.node == 7 && w.most.x == 1.0 && w.most.y == 5.0));
  CHECK((w.least.node == 5 && w.least.x == 3.0 && w.least.y == 2.0));
}

TEST_CASE("w grows to the second of two nodes, and a constant moment has its extreme at the first node") {
  const beam b{{0, 1, 2, 4}, {1.0, 1.0, 1.0}};
  std::vector<double> u;
  for (const double x : b.x) u.insert(u.end(), {x * x, 2 * x});  // M = 2 everywhere
  const value_range w = deflections_between(beam_lines(b, {}, u), u, 1, 3);
  CHECK((w.least.value == 1.0 && w.least.node == 1));
  CHECK((w.most.value == 16.0 && w.most.x == 4.0 && w.most.node == 3));
  const value_range m = range_named(ranges_of({b}, {}, u, {}), "moment");
  CHECK((m.least.value == 2.0 && m.most.value == 2.0));
  CHECK((m.least.node == 0 && m.most.node == 0));
  CHECK((m.least.x == 0.0 && m.most.x == 0.0));
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

TEST_CASE("if the largest deflection is just before the end of an element, the extreme is found there") {
  // The deflection w = -0.24 + 0.91 t - 0.24 t^4 needs only a load of -24 * 0.24.
  const beam b{{0, 1}, {1.0}};
  const std::vector<double> u = {-0.24, 0.91, 0.43, 0.91 - 4 * 0.24};
  const value_range w = range_named(ranges_of({b}, uniform(-24 * 0.24), u, {}), "w");
  const double t = std::cbrt(0.91 / 0.96);
  CHECK(w.most.node == -1);
  CHECK(w.most.x == Approx(t).epsilon(1e-6));
  CHECK(w.most.value == Approx(-0.24 + 0.91 * t - 0.24 * std::pow(t, 4)).epsilon(1e-12));
  CHECK(w.most.value > 0.43);
}

TEST_CASE("the place of an extreme is the first of all places whose values are equal except for rounding") {
  const auto check = [](const char* fact, std::vector<double> x, const std::vector<support>& supports,
                        const load& l, const std::string& keys, const std::vector<double>& places) {
    check_beams(fact, {bar(std::move(x), 1e4)}, supports, l, keys, places, 0.0, 0.01);
  };
  const auto point = [](double x, double value) { return placed_load{load_kind::point, x, x, {value}}; };
  check("A beam has more values than `extremes` remembers", even_beam(6000, 6000, 1).x, held({0}, {0}),
        tip_load(6000, 0.3), "xw< xw>", {0, 6000});
  const load one = placed({point(3.3, -7.5)});
  check("The shear is constant on both sides of a load", {0, 10}, held({0, 1}), one,
        "xv< xv> xm< xm> xw< xw>", {3.3, 0, 0, 3.3, 4.55, 0});
  check("The load is inside one of three elements", {0, 1.1, 2.3, 10}, held({0, 3}), one, "xv< xv> xm< xm>",
        {3.3, 0, 0, 3.3});
  check("An overhang has no shear", {0, 0.7, 1.3, 2.9}, held({0}, {0}), tip_load(1, 0.3), "xv< xv> xm< xm>",
        {0, 0.7, 0.7, 0});
  check("The shear is constant", {0, 0.7, 1.3, 2.9}, held({0}, {0}), tip_load(3, 0.3), "xv< xv> xm< xm>",
        {0, 0, 2.9, 0});
  check("The moment is constant", {0, 0.7, 1.3, 2.9}, held({0}, {0}), {{{3, 1, 0.3}}, {}}, "xm< xm>", {0, 0});
  check("The moment is constant between two loads", {0, 9}, held({0, 1}),
        placed({point(3.1, -7.7), point(5.9, -7.7)}), "xm< xm> xv< xv>", {0, 3.1, 5.9, 0});
  check("The two loads are at nodes", {0, 3.1, 5.9, 9}, held({0, 3}), {{{1, 0, -7.7}, {2, 0, -7.7}}, {}},
        "xm< xm>", {0, 3.1});
  check("The least w is just inside an element", {0, 1.7, 2.2, 3.9}, held({0, 3}), tip_load(1, -1),
        "xw< xw> xm< xm>", {1.8735, 0, 0, 1.7});
}

TEST_CASE(
    "The stress of a beam with two section moduli is M / W, and the largest stress is found inside the "
    "weaker part") {
  beam b{{0, 3, 4}, {1, 1}};
  const load l{{}, {{{-8.0}, {}}}};
  const std::vector<double> u = displaced(b, {{0, 0, true}, {2, 0, true}}, l);
  CHECK(stresses_of({b}, results_in_elements({b}, l, u)).names.empty());
  CHECK(ranges_of({b}, l, u, {}).back().name != "stress");
  b.sections = {{1, 1, 0.5}, {1, 1, 0.25}};
  const element_results stresses = stresses_of({b}, results_in_elements({b}, l, u));
  CHECK(stresses.at(0, 0)[1] == Approx(12 / 0.5).epsilon(1e-12));  // M = q x (L - x) / 2
  CHECK(stresses.at(1, 0)[0] == Approx(12 / 0.25).epsilon(1e-12));
  CHECK(range_named(ranges_of({b}, l, u, {}), "stress").most.value == Approx(48).epsilon(1e-12));
  b.sections[1].W = 1.0;
  CHECK(range_named(ranges_of({b}, l, u, {}), "stress").most.value == Approx(16 / 0.5).epsilon(1e-12));
  CHECK(range_named(ranges_of({b}, l, u, {}), "stress").most.x == Approx(2).epsilon(1e-12));
}

TEST_CASE("A plate has stresses 6 m / t^2, principal stresses by Mohr's circle, and von Mises' stress") {
  const element_results moments{{"mx", "my", "mxy"}, 4, {5, 0, 1, 2, -1, 0, 1, -2, 2, 0, 0, 3}};
  const element_results s = stresses_of({square(2.0)}, moments);  // 6 / t^2 = 1.5
  REQUIRE(s.values.size() == 24);
  CHECK(s.at(0, 0)[0] == Approx(7.5));
  CHECK(s.at(0, 1)[0] == Approx(-1.5));
  CHECK(s.at(0, 2)[0] == Approx(3.0));
  CHECK(s.at(0, 3)[0] == Approx(3 + std::sqrt(4.5 * 4.5 + 9)));
  CHECK(s.at(0, 4)[0] == Approx(3 - std::sqrt(4.5 * 4.5 + 9)));
  CHECK(s.at(0, 5)[0] == Approx(std::sqrt(7.5 * 7.5 + 7.5 * 1.5 + 1.5 * 1.5 + 3 * 9)));
  CHECK(s.at(0, 5)[1] == Approx(0.0));
  CHECK(s.at(0, 5)[2] == Approx(1.5));
  CHECK(s.at(0, 5)[3] == Approx(std::sqrt(9 + 9 + 9 + 3 * 4.5 * 4.5)));
  CHECK(stresses_of({square(0.0)}, moments).names.empty());
}

TEST_CASE(
    "The bound on stresses is at least the largest change of stresses under a bounded change of moments") {
  const plate p = square(1.0);
  const double bound = *stress_error({p}, 1e-3, 0.0);
  double worst = 0.0;
  const std::vector<double> at = {5, 0, 1, 2, -1, 0, 1, -2, 2, 0, 0, 3};
  const element_results before = stresses_of({p}, {{"mx", "my", "mxy"}, 4, at});
  for (int signs = 0; signs < 8; ++signs) {
    std::vector<double> moved = at;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += (signs >> (i / 4) & 1) != 0 ? 1e-3 : -1e-3;
    const element_results after = stresses_of({p}, {{"mx", "my", "mxy"}, 4, moved});
    for (std::size_t i = 0; i < before.values.size(); ++i)
      worst = std::max(worst, std::abs(after.values[i] - before.values[i]));
  }
  CHECK(worst <= bound);
  CHECK(worst > bound / 2);
  beam b{{0, 1, 2}, {1, 1}};
  CHECK_FALSE(stress_error({b}, 1e-3, 1.0).has_value());
  b.sections = {{1, 1, 0.5}, {1, 1, 0.25}};
  CHECK(*stress_error({b}, 1e-3, 0.0) == Approx(4e-3));
  CHECK(*stress_error({b}, 0.0, 1.0) >= 0x1p-52);
}
