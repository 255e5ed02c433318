#include "contct/model/rigid_modes.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "catch.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/model/problem.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

/// Returns the number of rigid-body motions that are removed if all dofs, given by their rows, are held.
int rank_of(const std::vector<rigid_row>& rows) {
  rigid_rank rank(rows, 1e-12);
  for (std::size_t dof = 0; dof < rows.size(); ++dof) rank.hold(static_cast<int>(dof));
  return rank.rank();
}

}  // namespace

TEST_CASE("deflections at two places hold a beam, but two deflections at one place or two rotations do not") {
  CHECK(rank_of({{1, 0.5, 0}, {1, 0.5, 0}}) == 1);
  CHECK(rank_of({{1, 0.5, 0}, {1, 0.5000001, 0}}) == 2);
  CHECK(rank_of({{0, 1, 0}, {0, 1, 0}}) == 1);
  CHECK(rank_of({{0, 1, 0}, {1, 0.9, 0}}) == 2);
}

TEST_CASE(
    "three points on one line do not hold a plate, but together with a point outside the line they do") {
  const std::vector<rigid_row> on_a_line = {{1, -0.3, -0.1}, {1, 0.1, 0.3}, {1, 0.5, 0.7}};
  CHECK(rank_of(on_a_line) == 2);
  std::vector<rigid_row> all = on_a_line;
  all.insert(all.end(), {{1, 0.5, 0.6999}, {1, 1, 1}});
  CHECK(rank_of(all) == 3);
}

TEST_CASE(
    "the rank of supports depends only on the directions of their rows, whose lengths may be 1e-200 to "
    "1e200") {
  for (const double size : {1e-200, 1.0, 1e200}) {
    CHECK(rank_of({{0, size, 0}, {0, 2 * size, 0}}) == 1);
    CHECK(rank_of({{0, size, 0}, {1, 1, 0}, {0, 0, size}}) == 3);
  }
  CHECK(rank_of({{0, 0, 0}}) == 0);
}

namespace {

/// Returns points on a line with a unit spring between neighbours, which has one rigid-body motion.
band_matrix chain(int points) {
  band_matrix k(points, 1);
  for (int i = 0; i + 1 < points; ++i) {
    k.add(i, i, 1.0);
    k.add(i + 1, i + 1, 1.0);
    k.add(i + 1, i, -1.0);
  }
  return k;
}

}  // namespace

TEST_CASE("a free chain of springs has one rigid-body motion, in which all points move by the same length") {
  const free_motions f = find_free_motions(chain(9), {});
  REQUIRE(f.count == 1);
  REQUIRE(f.rows.size() == 9);
  for (const rigid_row& row : f.rows) CHECK(std::abs(row[0]) == Approx(1.0).epsilon(1e-12));
  CHECK(f.rounding < 1e-9);
}

TEST_CASE("a chain with a spring to the ground has no rigid-body motion") {
  band_matrix k = chain(9);
  k.at(3, 3) += 0.5;
  CHECK(find_free_motions(k, {}).count == 0);
}

TEST_CASE("scaling the matrix or single dofs does not change the number of rigid-body motions") {
  stiffness_matrix k = chain(9);
  std::vector<double> d(9, 1e-8);
  d[4] = 1e3;
  k.scale(d);
  const free_motions f = find_free_motions(k, {});
  REQUIRE(f.count == 1);
  // K becomes D K D, so its rigid-body motion becomes D^-1 times the old one, scaled to a largest entry of 1.
  CHECK(std::abs(f.rows[0][0]) == Approx(1.0).epsilon(1e-9));
  CHECK(std::abs(f.rows[4][0]) <= 1e-10);
}

TEST_CASE(
    "a dof with the smallest positive stiffness in doubles does not change the rigid-body motions of other "
    "dofs") {
  band_matrix k(10, 1);
  for (int i = 0; i < 9; ++i)
    for (int j = std::max(i - 1, 0); j <= i; ++j) k.at(i, j) = chain(9).at(i, j);
  k.at(9, 9) = std::numeric_limits<double>::denorm_min();
  const free_motions f = find_free_motions(k, {});
  REQUIRE(f.count == 1);
  CHECK(f.rows[9][0] == 0.0);
}

TEST_CASE("a wrong number of rigid-body motions and an indefinite matrix are refused") {
  CHECK(find_free_motions(chain(9), 1).count == 1);
  CHECK_THROWS_WITH(find_free_motions(chain(9), 2),
                    Catch::Matchers::Contains("allowed: 1, the number of rigid-body motions"));
  band_matrix negative = chain(9);
  negative.add(0, 0, -0.5);
  CHECK_THROWS_AS(find_free_motions(negative, {}), std::invalid_argument);
}

TEST_CASE("a matrix in sparse storage has the same rigid-body motions as a band") {
  if (!sparse_factor::available()) return;
  assembled body;
  body.name = "K";
  body.stiffness = braced(box_at(0), 1e5);
  const std::vector<contact_pair> six = {{2, -1, 0, 1, true}, {5, -1, 0, 1, true}, {8, -1, 0, 1, true},
                                         {0, -1, 0, 1, true}, {6, -1, 0, 1, true}, {1, -1, 0, 1, true}};
  const std::vector<support> two_corners = {{0, 0, true}, {1, 0, true}, {2, 0, true}, {5, 0, true}};
  for (const auto& supports : {std::vector<support>{}, two_corners}) {
    body.as_band = true;
    const linear_structure wide = build(body, supports, six);
    body.as_band = false;
    const linear_structure narrow = build(body, supports, six);
    CHECK_FALSE(narrow.stiffness.is_band());
    CHECK(narrow.rigid_motions == wide.rigid_motions);
    CHECK(narrow.rigid_motions == (supports.empty() ? 6 : 2));
    CHECK(narrow.rigid_rounding < 1e-6);
    const rigid_rank rank = narrow.held_by([](std::size_t) { return true; });
    CHECK(rank.rank() == narrow.rigid_motions);
  }
  body.stiffness.entries.front().value = -1e5;
  CHECK_THROWS_WITH(build(body, {}, {}), Catch::Matchers::Contains("K: "));
}

TEST_CASE(
    "in a rigid-body motion of a chain, a point on a spring 1e22 times softer than the others moves too") {
  const int n = 100;
  band_matrix k = chain(n);
  const double soft = 1e-22;
  k.at(n - 1, n - 1) = soft;
  k.at(n - 1, n - 2) = -soft;
  k.at(n - 2, n - 2) = 1.0 + soft;
  const free_motions f = find_free_motions(k, 1);
  REQUIRE(f.count == 1);
  CHECK(f.rows[n - 1][0] == Approx(f.rows[0][0]).epsilon(1e-2));
}
