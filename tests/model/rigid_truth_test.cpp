// Tests decisions about rigid-body motions that are right in decimals and would be wrong in doubles.
#include <array>

#include "catch.hpp"
#include "contct/model/problem.hpp"
#include "contct/model/rigid_modes.hpp"
#include "contct/number/random.hpp"

using namespace contct;

namespace {

beam beam_at(std::vector<double> x) {
  beam b;
  b.EI.assign(x.size() - 1, 1.0);
  b.x = std::move(x);
  return b;
}

load points(std::vector<point_load> all) {
  return {std::move(all), {}};
}

std::optional<free_motion> driven(const linear_structure& s, const load& l, std::vector<int> held = {}) {
  return s.truth->driven_by(s.truth->work_of(l), held, s.rigid_rows);
}

/// Returns the driven motion computed from rounded loads.
std::optional<free_motion> driven_by_rounded(const model& m, const linear_structure& s, const load& l) {
  std::vector<double> f(s.fixed.size());
  add_consistent_loads(m, l, f);
  return s.driven_motion(s.nothing_held(), f, {});
}

/// Checks that the motion driven by exact loads and the motion driven by rounded loads are equal within
/// rounding.
void agree(const model& m, const load& l) {
  const linear_structure s = build(m, {}, {});
  const auto exactly = driven(s, l);
  const auto rounded = driven_by_rounded(m, s, l);
  REQUIRE(exactly.has_value());
  REQUIRE(rounded.has_value());
  for (int dof = 0; dof < s.dofs(); ++dof)
    CHECK(exactly->at(dof) == Approx(rounded->at(dof)).epsilon(1e-13).margin(1e-15));
}

using numbers = std::array<int, 3>;

int determinant(const numbers& a, const numbers& b, const numbers& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Returns true if `sum` is in the cone of `parts`. At most three parts are needed (Caratheodory), so
/// Cramer's rule is tried for any three parts, for two parts and a unit vector with a share of 0, and so on.
bool by_every_choice(const numbers& sum, const std::vector<numbers>& parts) {
  std::vector<numbers> all = parts;
  all.insert(all.end(), {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  const auto fits = [&](int share, std::size_t i) { return i < parts.size() ? share >= 0 : share == 0; };
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < all.size(); ++b)
      for (std::size_t c = 0; c < all.size(); ++c)
        if (const int whole = determinant(all[a], all[b], all[c]);
            whole > 0 && fits(determinant(sum, all[b], all[c]), a) &&
            fits(determinant(all[a], sum, all[c]), b) && fits(determinant(all[a], all[b], sum), c))
          return true;
  return false;
}

}  // namespace

TEST_CASE(
    "the work of loads on the rigid-body motions of a hinged beam is the same with and without "
    "condensation") {
  beam b = beam_at({0, 1, 2, 2.5, 4, 5.5, 6});
  b.hinges = {2, 5};
  agree(b, {{{1, 0, -1.0}, {3, 1, 0.75}}, {{{-2.0}, {1, 2, 3}}, {{0.5, -1.0, 0.25}, {}}}});
  agree(b, {{}, {{{-2.0, 1.0}, {5}}, {{3.0}, {0, 1}}}});
}

TEST_CASE("loads 0.1, 0.2 and -0.3 do no work on a free beam, but loads 1e12, -1e12 and 1e-300 do work") {
  const linear_structure s = build(beam_at({0, 1, 2}), {}, {});
  CHECK_FALSE(driven(s, points({{1, 0, 0.1}, {1, 0, 0.2}, {1, 0, -0.3}})));
  CHECK(driven(s, points({{1, 0, 0.1}, {1, 0, 0.2}, {1, 0, -0.3}, {1, 0, 1e-300}})));
  CHECK(driven(s, points({{1, 0, 1e12}, {1, 0, -1e12}, {1, 0, 1e-300}})));
  const model m{beam_at({0, 1, 2})};
  CHECK_FALSE(
      driven_by_rounded(m, s, points({{1, 0, 0.1}, {1, 0, 0.2}, {1, 0, -0.3}})));  // 5.6e-17 in doubles
}

TEST_CASE(
    "a load over the only support of a beam does not rotate it, but with a moment of 4e-13 the beam "
    "rotates") {
  const linear_structure s = build(beam_at({0, 0.7, 2}), {}, {});
  CHECK_FALSE(driven(s, points({{1, 0, -1.0}}), {2}));
  const auto turn = driven(s, points({{1, 0, -1.0}, {1, 1, -4e-13}}), {2});
  REQUIRE(turn.has_value());
  CHECK(turn->at(2) == 0.0);  // the supported node
  CHECK(turn->at(0) * turn->at(4) < 0.0);
  CHECK(turn->at(0) / turn->at(4) == Approx(-0.7 / 1.3).epsilon(1e-14));
  CHECK(turn->at(1) < 0.0);  // the slope has the sign of the moment
}

TEST_CASE("of all rigid-body motions, the load drives the motion on which it does most work") {
  load l = points({{0, 0, 3.0}, {2, 1, -0.5}});
  l.distributed = {{{1.0, -0.25, 0.125}, {}}, {{2.0}, {0, 2}}, {{-1.0, 1.0}, {1, 2}}};
  agree(beam_at({0, 1, 3, 4}), l);
}

TEST_CASE("the work of a plate's pressures and forces on its rigid-body motions is exact") {
  plate p;
  p.x = {0, 0.7, 1.3, 2.9};
  p.y = {-1, 0.1, 0.35};
  p.D = 1.0;
  load l = points({{5, 0, 0.25}, {2, 1, 0.5}, {7, 2, -0.125}});
  l.distributed = {{{0.3}, {}}, {{-0.2}, {1, 2, 3, 5}}};
  agree(p, l);
  // A uniform pressure and the opposite force at the middle together do no work.
  p.x = {0, 0.3, 0.6};
  p.y = {0, 0.7, 1.4};
  const linear_structure even = build(p, {}, {});
  load balanced = points({{4, 0, -0.0084}});
  balanced.distributed = {{{0.01}, {}}};
  CHECK_FALSE(driven(even, balanced));
  balanced.points[0].value = -0.00840000000000001;
  CHECK(driven(even, balanced));
}

TEST_CASE("loads at exact thirds of a beam that are in balance drive no rigid-body motion") {
  beam b = beam_at({0, 1.0 / 3, 2.0 / 3, 1});
  b.runs = {{1.0, 3}};
  const linear_structure s = build(b, {}, {});
  CHECK_FALSE(driven(s, points({{0, 0, 2.0}, {1, 0, -3.0}, {3, 0, 1.0}})));
  const linear_structure by_decimals = build(beam_at(b.x), {}, {});
  CHECK(driven(by_decimals, points({{0, 0, 2.0}, {1, 0, -3.0}, {3, 0, 1.0}})));
}

TEST_CASE(
    "two supports hold a beam even if they are 1e-14 apart, and three hold a plate unless they are on one "
    "line") {
  const linear_structure s = build(beam_at({0, 1e-14, 1}), {}, {});
  CHECK(s.truth->is_independent(std::vector<int>{0}, 2));
  CHECK_FALSE(s.truth->is_independent(std::vector<int>{0}, 0));
  CHECK(s.truth->is_independent(std::vector<int>{0}, 3));
  CHECK_FALSE(s.truth->is_independent(std::vector<int>{1}, 5));  // two slopes

  plate p;
  p.x = {0, 0.1, 0.2, 0.3};
  p.y = {0, 0.7, 1.4, 2.1};
  p.D = 1.0;
  const linear_structure even = build(p, {}, {});
  const auto w = [&p](int i, int j) { return 3 * p.node_at(i, j); };
  const auto hold = [&](std::vector<int> held, int dof) { return even.truth->is_independent(held, dof); };
  CHECK_FALSE(hold({w(0, 0), w(1, 0)}, w(3, 0)));
  CHECK_FALSE(hold({w(0, 0), w(1, 1)}, w(3, 3)));  // in doubles 0.1 + 0.2 is not 0.3
  CHECK(hold({w(0, 0), w(1, 1)}, w(3, 2)));
  CHECK(hold({w(0, 0), w(0, 0) + 1}, w(0, 0) + 2));
  CHECK_FALSE(hold({w(0, 0), w(0, 0) + 1}, w(3, 0)));
  CHECK(hold({w(0, 0), w(0, 0) + 1}, w(3, 1)));
  p.x[3] = 0.30000000000000004;
  CHECK(build(p, {}, {}).truth->is_independent(std::vector<int>{w(0, 0), w(1, 1)}, w(3, 3)));
}

TEST_CASE("the difference between the work of two loads is unknown if the work of one load is unknown") {
  const linear_structure s = build(beam_at({0, 1, 2}), {}, {});
  const rigid_work large = s.truth->work_of(points({{1, 0, -1e16}, {2, 0, -0.1}}));
  const rigid_work small = s.truth->work_of(points({{1, 0, -1e16}}));
  CHECK(s.truth->driven_by(large.less(small), {}, s.rigid_rows));
  CHECK_FALSE(s.truth->driven_by(large.less(small), std::vector<int>{4}, s.rigid_rows));
  CHECK_FALSE(large.less(large).less({}).is_known());
  CHECK_FALSE(rigid_work().less(large).is_known());
}

TEST_CASE(
    "two pairs carry a load between the pairs, and a hinged support and a pair carry a load that compresses "
    "the pair") {
  const linear_structure bare =
      build(beam_at({0, 1, 2, 3}), {}, {{0, -1, 0, 1, false}, {2, -1, 0, 1, false}});
  const auto carried = [](const linear_structure& s, const load& l) {
    return s.has_equilibrium(s.truth->work_of(l));
  };
  CHECK(carried(bare, points({{1, 0, -2.0}})) == true);
  CHECK(carried(bare, points({{2, 0, -2.0}})) == true);  // the load is over the second pair
  CHECK(carried(bare, points({{2, 0, -2.0}, {2, 1, 1e-300}})) == true);
  CHECK(carried(bare, points({{2, 0, -2.0}, {2, 1, -1e-300}})) == false);
  CHECK(carried(bare, points({{1, 0, 1.0}})) == false);
  CHECK(carried(bare, {}) == true);
  const linear_structure hinged =
      build(beam_at({0, 1, 2, 3}), std::vector<support>{{1, 0, true}}, {{2, -1, 0, 1, false}});
  CHECK(carried(hinged, points({{0, 0, -1.0}})) == false);
  CHECK(carried(hinged, points({{0, 0, 1.0}})) == true);
  CHECK(carried(build(beam_at({0, 1}), {}, {}), points({{0, 0, 1.0}})) == false);
}

TEST_CASE("a plate's load has an equilibrium if and only if three of its pairs can carry it") {
  const plate p{{-3, -2, -1, 0, 1, 2, 3}, {-3, -2, -1, 0, 1, 2, 3}, 1.0, 0.3};
  contct::random_numbers random(17);
  int carried = 0;
  for (int tried = 0; tried < 1000; ++tried) {
    std::vector<contact_pair> pairs;
    std::vector<numbers> parts;
    for (int left = random.whole(0, 5); left > 0; --left) {
      const int node = random.whole(0, 48);
      const int surface = random.whole(0, 3) == 0 ? -1 : 1;
      pairs.push_back({node, surface, 0.0, 1.0, false});
      parts.push_back({surface, surface * (node % 7 - 3), surface * (node / 7 - 3)});
    }
    const numbers sum = {random.whole(-1, 3), random.whole(-3, 3), random.whole(-3, 3)};
    const linear_structure s = build(p, {}, pairs);
    const rigid_work work =
        s.truth->work_of(points({{24, 0, 1.0 * sum[0]}, {24, 1, 1.0 * sum[1]}, {24, 2, 1.0 * sum[2]}}));
    const bool expected = by_every_choice(sum, parts);
    carried += expected ? 1 : 0;
    REQUIRE(s.has_equilibrium(work) == expected);
  }
  CHECK(carried > 100);
  CHECK(carried < 900);
}

TEST_CASE(
    "a thousand pairs in a square carry a load on the edge, but not if a moment of 1e-300 tips the plate "
    "outwards") {
  plate p;
  for (int i = -15; i <= 15; ++i) p.x.push_back(i / 10.0);
  p.y = p.x;
  p.D = 1.0;
  std::vector<contact_pair> everywhere;
  for (int node = 0; node < p.nodes(); ++node) everywhere.push_back({node, -1, 0.0, 1.0, false});
  const linear_structure s = build(p, {}, everywhere);
  for (const int along : {15, 20, 30}) {
    const int edge = p.node_at(along, 30);
    const auto carried = [&](double turn) {
      return s.has_equilibrium(s.truth->work_of(points({{edge, 0, -1.0}, {edge, 2, turn}})));
    };
    CHECK(carried(0.0) == true);
    CHECK(carried(1e-300) == true);
    CHECK(carried(-1e-300) == false);
  }
}
