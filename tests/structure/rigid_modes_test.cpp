// Tests the rigid-body motions of matrices, and structures that are given by their matrix.
#include "contct/structure/rigid_modes.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "catch.hpp"
#include "contct/linear/sparse_factor.hpp"
#include "contct/structure/statics.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

/// Returns the number of rigid-body motions that are removed if all dofs, given by their rows, are held.
int rank_of(const std::vector<rigid_row>& rows) {
  rigid_rank rank(rows, 1e-12);
  for (std::size_t dof = 0; dof < rows.size(); ++dof) rank.hold(static_cast<int>(dof));
  return rank.rank();
}

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

assembled of(sparse_matrix k) {
  assembled a;
  a.name = "K.mtx";
  a.stiffness = std::move(k);
  return a;
}

/// Returns the matrix of a structure; of a beam with elements of length 0.5; of a braced box in space.
assembled matrix_of(const model& m) {
  return of(entries_of(build(m, {}, {})));
}
assembled beam_of(int elements) {
  return matrix_of(even_beam(0.5 * elements, elements, 3e4));
}
assembled box() {
  return of(braced(box_at(0), 1e5));
}

int motions_of(const assembled& a, const std::vector<support>& supports = {}) {
  return build(a, supports, {}).rigid_motions;
}

/// Returns the rank of supports and of pairs at these dofs.
int rank_of(const assembled& a, const std::vector<int>& dofs, const std::vector<support>& supports = {}) {
  std::vector<contact_pair> pairs;
  for (const int dof : dofs) pairs.push_back({dof, -1, 0.0, 1.0, true});
  return build(a, supports, pairs).held_by([](std::size_t) { return true; }).rank();
}

}  // namespace

TEST_CASE("the rank of supports does not depend on the lengths of their rows, from 1e-200 to 1e200") {
  CHECK(rank_of({{1, 0.5, 0}, {1, 0.5, 0}}) == 1);  // two deflections of a beam at one place
  CHECK(rank_of({{1, 0.5, 0}, {1, 0.5000001, 0}}) == 2);
  CHECK(rank_of({{0, 1, 0}, {0, 1, 0}}) == 1);  // two rotations
  CHECK(rank_of({{0, 1, 0}, {1, 0.9, 0}}) == 2);
  CHECK(rank_of({{1, -0.3, -0.1}, {1, 0.1, 0.3}, {1, 0.5, 0.7}}) ==
        2);  // three points of a plate on one line
  CHECK(rank_of({{1, -0.3, -0.1}, {1, 0.1, 0.3}, {1, 0.5, 0.7}, {1, 0.5, 0.6999}, {1, 1, 1}}) == 3);
  for (const double size : {1e-200, 1.0, 1e200}) {
    CHECK(rank_of({{0, size, 0}, {0, 2 * size, 0}}) == 1);
    CHECK(rank_of({{0, size, 0}, {1, 1, 0}, {0, 0, size}}) == 3);
  }
  CHECK(rank_of({{0, 0, 0}}) == 0);
}

TEST_CASE("a chain of springs that nothing holds has one rigid-body motion, which moves all points equally") {
  const free_motions f = find_free_motions(chain(9), {});
  REQUIRE(f.count == 1);
  REQUIRE(f.rows.size() == 9);
  for (const rigid_row& row : f.rows) CHECK(std::abs(row[0]) == Approx(1.0).epsilon(1e-12));
  CHECK(f.rounding < 1e-9);
  band_matrix grounded = chain(9);
  grounded.at(3, 3) += 0.5;
  CHECK(find_free_motions(grounded, {}).count == 0);
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
  std::vector<contact_pair> six;
  for (const int dof : {2, 5, 8, 0, 6, 1}) six.push_back({dof, -1, 0, 1, true});
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

TEST_CASE(
    "the matrix of a free beam has two rigid-body motions, that of a plate three, that of a body in space "
    "six") {
  for (const int elements : {1, 2, 7, 40, 200}) {
    INFO(elements << " elements");
    CHECK(motions_of(beam_of(elements)) == 2);
  }
  CHECK(motions_of(matrix_of(plate{{0, 0.5, 1.2, 2}, {0, 0.4, 1}, 7.0, 0.3})) == 3);
  CHECK(motions_of(box()) == 6);
}

TEST_CASE("the rigid-body motions of a beam's matrix are straight lines, in any order of rows") {
  assembled a = beam_of(20);
  std::vector<int> mixed;
  for (int i = 0; i < a.dofs(); ++i) mixed.push_back((i * 11 + 3) % a.dofs());
  for (const auto& rows : {std::vector<int>{}, mixed}) {
    a.rows = rows;
    const linear_structure s = build(a, {}, {});
    REQUIRE(s.rigid_motions == 2);
    for (std::size_t motion = 0; motion < 2; ++motion) {
      const auto w = [&](std::size_t node) { return s.rigid_rows[2 * node][motion]; };
      const double slope = (w(20) - w(0)) / 10.0;
      for (std::size_t node = 0; node <= 20; ++node) {
        CHECK(w(node) == Approx(w(0) + slope * 0.5 * static_cast<double>(node)).margin(1e-9));
        CHECK(s.rigid_rows[2 * node + 1][motion] == Approx(slope).margin(1e-9));
      }
    }
    CHECK(s.rigid_rounding < 1e-7);
  }
}

TEST_CASE("supports and pairs remove the rigid-body motions of a matrix that move their dofs") {
  const assembled bare = beam_of(12);
  CHECK(motions_of(bare, {{0, 0, true}}) == 1);
  CHECK(motions_of(bare, {{0, 0, false, 1e4}}) == 1);
  CHECK(motions_of(bare, {{0, 0, true}, {1, 0, true}}) == 0);
  CHECK(motions_of(bare, {{0, 0, true}, {1, 0, false, 3.0}}) == 0);
  CHECK(rank_of(bare, {4}) == 1);
  CHECK(rank_of(bare, {4, 4}) == 1);
  CHECK(rank_of(bare, {4, 6}) == 2);
  CHECK(rank_of(bare, {5, 19}) == 1);  // two rotations
  CHECK(rank_of(bare, {5, 20}) == 2);
  CHECK(rank_of(box(), {2, 5, 8, 11}) == 3);  // four vertical pairs
  CHECK(rank_of(box(), {2, 5, 8, 0, 6, 1}) == 6);
  std::vector<support> only_x_is_left;  // z is fixed at three corners, and y at two
  for (const int dof : {2, 5, 8, 1, 4}) only_x_is_left.push_back({dof, 0, true});
  REQUIRE(motions_of(box(), only_x_is_left) == 1);
  for (const int dof : {7, 10, 14, 20, 23}) CHECK(rank_of(box(), {dof}, only_x_is_left) == 0);
  CHECK(rank_of(box(), {21}, only_x_is_left) == 1);
}

TEST_CASE(
    "a very flexible clamped matrix has no rigid-body motion, but free parts with rounded entries have one") {
  for (const int elements : {1000, 2500})
    CHECK(motions_of(beam_of(elements), {{0, 0, true}, {1, 0, true}}) == 0);
  const auto triangle = [](double third) {
    return of({3, {{0, 0, 1.0}, {1, 1, 1.0}, {2, 2, 1.0}, {1, 0, -0.5}, {2, 0, -0.5}, {2, 1, third}}, {}});
  };
  for (const double rounding : {1e-17, 1e-15, -1e-15, 2e-14, -2e-14, 1e-11}) {
    const linear_structure s = build(triangle(-0.5 - rounding), {}, {});
    CHECK(s.rigid_motions == 1);
    CHECK(std::abs(s.rigid_stiffness) <= std::abs(rounding) + 1e-15);
  }
  CHECK(motions_of(triangle(-0.5 + 1e-7)) == 0);
  assembled declared = triangle(-0.5 - 1e-7);
  CHECK_THROWS_WITH(build(declared, {}, {}), Contains("set free_motions = 1"));
  declared.free_motions = 1;
  CHECK(motions_of(declared) == 1);
}

TEST_CASE(
    "a matrix that is indefinite or has a dof without stiffness is refused, and the message names the file") {
  CHECK_THROWS_WITH(build(of({2, {{0, 0, 1.0}, {1, 0, 2.0}, {1, 1, 1.0}}}), {}, {}),
                    Contains("K.mtx: the matrix is not positive semidefinite"));
  const assembled half = of({2, {{0, 0, 1.0}}});
  CHECK_THROWS_WITH(build(half, {}, {}), Contains("K.mtx: dof 2: found a row of zeros and no support"));
  CHECK_NOTHROW(build(half, std::vector<support>{{1, 0, true}}, {}));
  CHECK_NOTHROW(build(half, std::vector<support>{{1, 0, false, 2.0}}, {}));
  assembled boxes = box();
  for (const matrix_entry& e : braced(box_at(5), 1e5).entries)
    boxes.stiffness.entries.push_back({e.row + 24, e.column + 24, e.value});
  boxes.stiffness.order = 48;
  CHECK_THROWS_WITH(build(boxes, {}, {}), Contains("has more than 6 rigid-body motions"));
  assembled declared = box();
  declared.free_motions = 7;
  CHECK_THROWS_WITH(build(declared, {}, {}), Contains("free_motions: found 7; allowed: 6, the number of "
                                                      "rigid-body motions of the matrix with its supports"));
}

TEST_CASE("the order of the rows of a matrix does not change rigid-body motions or reactions") {
  const std::vector<support> supports = {{0, 0, true}, {24, 0, false, 50.0}};
  const std::vector<contact_pair> pair = {{10, -1, 0.0, 1.0, true}};
  assembled a = beam_of(12);
  const linear_structure plain = build(a, supports, pair);
  for (int i = 0; i < a.dofs(); ++i) a.rows.push_back((i * 7 + 3) % a.dofs());
  const linear_structure mixed = build(a, supports, pair);
  REQUIRE(mixed.rigid_motions == plain.rigid_motions);
  CHECK(mixed.stiffness.band().subdiagonals() > plain.stiffness.band().subdiagonals());
  for (int dof = 0; dof < a.dofs(); ++dof)
    CHECK(mixed.stiffness.diagonal(mixed.row_of(dof)) == plain.stiffness.diagonal(dof));
  std::vector<double> u(26, 0.0);
  u[24] = -0.25;
  // No element deforms, so the support has the whole load.
  CHECK(reactions(a, {{{0, 0, 3.0}}, {}}, supports, u) == std::vector<double>{-3.0, 12.5});
}
