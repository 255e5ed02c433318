// Tests decisions about rigid-body motions that are right in decimals and would be wrong in doubles.
#include <array>

#include "catch.hpp"
#include "contct/kernel/call.hpp"
#include "contct/number/random.hpp"
#include "contct/structure/problem.hpp"
#include "contct/structure/rigid_modes.hpp"
#include "structure/closed_forms.hpp"

using namespace contct;

namespace {

beam beam_at(std::vector<double> x, std::vector<int> hinges = {}) {
  return bar(std::move(x), 1.0, std::move(hinges));
}

load points(std::vector<point_load> all, std::vector<distributed_load> distributed = {}) {
  return {std::move(all), std::move(distributed)};
}

std::optional<free_motion> driven(const linear_structure& s, const load& l, std::vector<int> held = {}) {
  return s.truth->driven_by(s.truth->work_of(l), held, s.rigid_rows);
}

/// Returns the driven motion computed from rounded loads.
std::optional<free_motion> driven_by_rounded(const model& m, const linear_structure& s, const load& l) {
  const std::vector<double> f = nodal_loads(m, l).force;
  return s.driven_motion(s.nothing_held(), f, {});
}

/// Returns true if there is an equilibrium under the load.
bool is_carried(const linear_structure& s, const load& l) {
  return s.has_equilibrium(s.truth->work_of(l)).value();
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

TEST_CASE("of all rigid-body motions, the load drives the motion on which it does most work") {
  const beam hinged = beam_at({0, 1, 2, 2.5, 4, 5.5, 6}, {2, 5});  // with and without condensation
  agree(hinged, {{{1, 0, -1.0}, {3, 1, 0.75}}, {{{-2.0}, {1, 2, 3}}, {{0.5, -1.0, 0.25}, {}}}});
  agree(hinged, {{}, {{{-2.0, 1.0}, {5}}, {{3.0}, {0, 1}}}});
  agree(beam_at({0, 1, 3, 4}), points({{0, 0, 3.0}, {2, 1, -0.5}},
                                      {{{1.0, -0.25, 0.125}, {}}, {{2.0}, {0, 2}}, {{-1.0, 1.0}, {1, 2}}}));
  agree(plate{{0, 0.7, 1.3, 2.9}, {-1, 0.1, 0.35}, 1.0, 0.0},
        points({{5, 0, 0.25}, {2, 1, 0.5}, {7, 2, -0.125}}, {{{0.3}, {}}, {{-0.2}, {1, 2, 3, 5}}}));
}

TEST_CASE("loads in balance as decimals or exact thirds do no work, and a rest of 1e-300 does work") {
  const linear_structure s = build(beam_at({0, 1, 2}), {}, {});
  const load balanced = points({{1, 0, 0.1}, {1, 0, 0.2}, {1, 0, -0.3}});  // 5.6e-17 in doubles
  CHECK_FALSE(driven(s, balanced));
  CHECK_FALSE(driven_by_rounded({beam_at({0, 1, 2})}, s, balanced));
  CHECK(driven(s, points({{1, 0, 0.1}, {1, 0, 0.2}, {1, 0, -0.3}, {1, 0, 1e-300}})));
  CHECK(driven(s, points({{1, 0, 1e12}, {1, 0, -1e12}, {1, 0, 1e-300}})));
  beam thirds = beam_at({0, 1.0 / 3, 2.0 / 3, 1});
  const load at_thirds = points({{0, 0, 2.0}, {1, 0, -3.0}, {3, 0, 1.0}});
  CHECK(driven(build(thirds, {}, {}), at_thirds));  // the decimals of the coordinates are no thirds
  thirds.runs = {{1.0, 3}};
  CHECK_FALSE(driven(build(thirds, {}, {}), at_thirds));
  // A uniform pressure and the opposite force at the middle:
  const linear_structure even = build(plate{{0, 0.3, 0.6}, {0, 0.7, 1.4}, 1.0, 0.0}, {}, {});
  CHECK_FALSE(driven(even, points({{4, 0, -0.0084}}, {{{0.01}, {}}})));
  CHECK(driven(even, points({{4, 0, -0.00840000000000001}}, {{{0.01}, {}}})));
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

TEST_CASE(
    "two supports hold a beam even if they are 1e-14 apart, and three hold a plate unless they are on one "
    "line") {
  const linear_structure s = build(beam_at({0, 1e-14, 1}), {}, {});
  CHECK(s.truth->is_independent(std::vector<int>{0}, 2));
  CHECK_FALSE(s.truth->is_independent(std::vector<int>{0}, 0));
  CHECK(s.truth->is_independent(std::vector<int>{0}, 3));
  CHECK_FALSE(s.truth->is_independent(std::vector<int>{1}, 5));  // two slopes

  plate p{{0, 0.1, 0.2, 0.3}, {0, 0.7, 1.4, 2.1}, 1.0, 0.0};
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
  CHECK(s.truth->driven_by(difference_of(large, small), {}, s.rigid_rows));
  CHECK_FALSE(s.truth->driven_by(difference_of(large, small), std::vector<int>{4}, s.rigid_rows));
  CHECK_FALSE(difference_of(difference_of(large, large), {}));
  CHECK_FALSE(difference_of({}, large));
}

TEST_CASE(
    "supports carry a load over them, and pairs carry a load that compresses them, also of a mechanism") {
  const auto pair = [](int node, int surface = face_below) {
    return contact_pair{node, surface, 0.0, 1.0, false};
  };
  const linear_structure bare = build(beam_at({0, 1, 2, 3}), {}, {pair(0), pair(2)});
  CHECK(is_carried(bare, tip_load(1, -2)));
  CHECK(is_carried(bare, tip_load(2, -2)));  // the load is over the second pair
  CHECK(is_carried(bare, points({{2, 0, -2.0}, {2, 1, 1e-300}})));
  CHECK_FALSE(is_carried(bare, points({{2, 0, -2.0}, {2, 1, -1e-300}})));
  CHECK_FALSE(is_carried(bare, tip_load(1, 1)));
  CHECK(is_carried(bare, {}));
  const linear_structure turns = build(beam_at({0, 1, 2, 3}), held({1}), {pair(2)});
  CHECK_FALSE(is_carried(turns, tip_load(0, -1)));
  CHECK(is_carried(turns, tip_load(0, 1)));
  CHECK_FALSE(is_carried(build(beam_at({0, 1}), {}, {}), tip_load(0, 1)));
  const linear_structure mechanism = build(beam_at({0, 1, 2, 3, 4}, {1, 2, 3}), held({0, 2, 4}), {});
  CHECK(mechanism.held_by([](std::size_t) { return true; }).rank() == 3);
  CHECK(is_carried(mechanism, tip_load(2, -1)));
  CHECK_FALSE(is_carried(mechanism, tip_load(1, -1)));
  CHECK_FALSE(is_carried(mechanism, uniform(-1)));
  const beam two_hinges = beam_at({0, 1, 2, 3}, {1, 2});
  CHECK_FALSE(is_carried(build(two_hinges, held({0, 3}), {pair(1)}), uniform(-1)));
  CHECK(is_carried(build(two_hinges, held({0, 3}), {pair(1), pair(2)}), uniform(-1)));
  CHECK_FALSE(is_carried(build(two_hinges, held({0, 3}), {pair(1), pair(2, face_above)}), uniform(-1)));
}

TEST_CASE("a plate's load has an equilibrium if and only if three of its pairs can carry it") {
  const plate p{{-3, -2, -1, 0, 1, 2, 3}, {-3, -2, -1, 0, 1, 2, 3}, 1.0, 0.3};
  random_numbers random(17);
  int carried = 0;
  for (int tried = 0; tried < 300; ++tried) {
    std::vector<contact_pair> pairs;
    std::vector<numbers> parts;
    for (int left = random.whole(0, 5); left > 0; --left) {
      const int node = random.whole(0, 48);
      const int surface = random.whole(0, 3) == 0 ? -1 : 1;
      pairs.push_back({node, surface, 0.0, 1.0, false});
      parts.push_back({surface, surface * (node % 7 - 3), surface * (node / 7 - 3)});
    }
    const numbers sum = {random.whole(-1, 3), random.whole(-3, 3), random.whole(-3, 3)};
    const bool expected = by_every_choice(sum, parts);
    carried += expected ? 1 : 0;
    REQUIRE(is_carried(build(p, {}, pairs),
                       points({{24, 0, 1.0 * sum[0]}, {24, 1, 1.0 * sum[1]}, {24, 2, 1.0 * sum[2]}})) ==
            expected);
  }
  CHECK(carried > 30);
  CHECK(carried < 270);
}

TEST_CASE(
    "a thousand pairs in a square carry a load on the edge, but not if a moment of 1e-300 tips the plate "
    "outwards") {
  plate p{{}, {}, 1.0, 0.0};
  for (int i = -15; i <= 15; ++i) p.x.push_back(i / 10.0);
  p.y = p.x;
  std::vector<contact_pair> everywhere;
  for (int node = 0; node < p.nodes(); ++node) everywhere.push_back({node, -1, 0.0, 1.0, false});
  const linear_structure s = build(p, {}, everywhere);
  for (const int along : {15, 20, 30}) {
    const int edge = p.node_at(along, 30);
    for (const double turn : {0.0, 1e-300, -1e-300})
      CHECK(is_carried(s, points({{edge, 0, -1.0}, {edge, 2, turn}})) == (turn >= 0));
  }
}
