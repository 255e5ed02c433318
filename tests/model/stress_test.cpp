// Tests stresses at the extreme fibres against formulas.
#include <cmath>

#include "catch.hpp"
#include "contct/model/extremes.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

constexpr double stress_rounding = 1e-12;

plate square(double thickness) {
  plate p;
  p.x = p.y = {0, 1};
  p.D = 1.0;
  p.thickness = thickness;
  return p;
}

const value_range* named(const std::vector<value_range>& all, std::string_view name) {
  for (const value_range& r : all)
    if (r.name == name) return &r;
  return nullptr;
}

}  // namespace

TEST_CASE(
    "The stress of a beam with two section moduli is M / W, and the largest stress is found inside the "
    "weaker part") {
  beam b{{0, 3, 4}, {1, 1}};
  const load l{{}, {{{-8.0}, {}}}};
  const std::vector<double> u = displaced(b, {{0, 0, true}, {2, 0, true}}, l);
  CHECK(stresses_of({b}, results_in_elements({b}, l, u)).names.empty());
  CHECK(named(ranges_of({b}, l, u, {}), "stress") == nullptr);
  b.sections = {{1, 1, 0.5}, {1, 1, 0.25}};
  const element_results stresses = stresses_of({b}, results_in_elements({b}, l, u));
  CHECK(stresses.at(0, 0)[1] == Approx(12 / 0.5).epsilon(stress_rounding));  // M = q x (L - x) / 2
  CHECK(stresses.at(1, 0)[0] == Approx(12 / 0.25).epsilon(stress_rounding));
  const auto all = ranges_of({b}, l, u, {});
  REQUIRE(named(all, "stress") != nullptr);
  CHECK(named(all, "stress")->most.value == Approx(48).epsilon(stress_rounding));
  b.sections[1].W = 1.0;
  CHECK(named(ranges_of({b}, l, u, {}), "stress")->most.value == Approx(16 / 0.5).epsilon(stress_rounding));
  CHECK(named(ranges_of({b}, l, u, {}), "stress")->most.x == Approx(2).epsilon(stress_rounding));
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
