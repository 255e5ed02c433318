// Tests a structure given by its matrix: its properties and its rigid-body motions.
#include "catch.hpp"
#include "contct/model/rigid_modes.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

/// Returns a beam with elements of length 0.5.
beam beam_of(int elements) {
  return even_beam(0.5 * elements, elements, 3e4);
}

plate small_plate() {
  plate p;
  p.x = {0, 0.5, 1.2, 2};
  p.y = {0, 0.4, 1};
  p.D = 7;
  p.nu = 0.3;
  return p;
}

/// Returns the same structure given by its matrix.
linear_structure by_matrix(const linear_structure& s, std::span<const support> supports,
                           std::vector<contact_pair> pairs) {
  assembled a;
  a.name = "K";
  a.stiffness = entries_of(s);
  return build(a, supports, std::move(pairs));
}

/// Returns a pair at a dof of a matrix.
contact_pair at_dof(int dof) {
  return {dof, -1, 0.0, 1.0, true};
}

std::string refusal_of(const assembled& a, const std::vector<support>& supports) {
  try {
    (void)build(a, supports, {});
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "accepted";
}

int rank_of(const linear_structure& s) {
  return s.held_by([](std::size_t) { return true; }).rank();
}

}  // namespace

TEST_CASE(
    "the matrix of a free beam has two rigid-body motions, that of a plate three, that of a body in space "
    "six") {
  for (const int elements : {1, 2, 7, 40, 200}) {
    INFO(elements << " elements");
    CHECK(by_matrix(build(beam_of(elements), {}, {}), {}, {}).rigid_motions == 2);
  }
  CHECK(by_matrix(build(small_plate(), {}, {}), {}, {}).rigid_motions == 3);
  assembled body;
  body.stiffness = braced(box_at(0), 1e5);
  CHECK(build(body, {}, {}).rigid_motions == 6);
}

TEST_CASE("the rigid-body motions of a beam's matrix are straight lines, in any order of rows") {
  assembled a;
  a.stiffness = entries_of(build(beam_of(20), {}, {}));
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

TEST_CASE("supports remove the rigid-body motions of a beam that is given by its matrix") {
  const linear_structure bare = build(beam_of(12), {}, {});
  CHECK(by_matrix(bare, std::vector<support>{{0, 0, true}}, {}).rigid_motions == 1);
  CHECK(by_matrix(bare, std::vector<support>{{0, 0, false, 1e4}}, {}).rigid_motions == 1);
  CHECK(by_matrix(bare, std::vector<support>{{0, 0, true}, {1, 0, true}}, {}).rigid_motions == 0);
  CHECK(by_matrix(bare, std::vector<support>{{0, 0, true}, {1, 0, false, 3.0}}, {}).rigid_motions == 0);
}

TEST_CASE(
    "two pairs at deflections hold a beam given by its matrix, but two pairs at rotations remove only one "
    "motion") {
  const linear_structure bare = build(beam_of(12), {}, {});
  CHECK(rank_of(by_matrix(bare, {}, {at_dof(4)})) == 1);
  CHECK(rank_of(by_matrix(bare, {}, {at_dof(4), at_dof(4)})) == 1);
  CHECK(rank_of(by_matrix(bare, {}, {at_dof(4), at_dof(6)})) == 2);
  CHECK(rank_of(by_matrix(bare, {}, {at_dof(5), at_dof(19)})) == 1);  // two rotations
  CHECK(rank_of(by_matrix(bare, {}, {at_dof(5), at_dof(20)})) == 2);
}

TEST_CASE(
    "four vertical pairs remove three rigid-body motions of a body in space, and six pairs remove all six") {
  assembled body;
  body.stiffness = braced(box_at(0), 1e5);
  CHECK(rank_of(build(body, {}, {at_dof(2), at_dof(5), at_dof(8), at_dof(11)})) == 3);
  CHECK(rank_of(build(body, {}, {at_dof(2), at_dof(5), at_dof(8), at_dof(0), at_dof(6), at_dof(1)})) == 6);
}

TEST_CASE("a pair removes no rigid-body motion if none of the rigid-body motions moves the dof of the pair") {
  assembled body;
  body.stiffness = braced(box_at(0), 1e5);
  std::vector<support> only_x_is_left;
  for (const int dof : {2, 5, 8, 1, 4})
    only_x_is_left.push_back({dof, 0, true});  // fixes z at three corners and y at two
  REQUIRE(build(body, only_x_is_left, {}).rigid_motions == 1);
  for (const int dof : {7, 10, 14, 20, 23}) CHECK(rank_of(build(body, only_x_is_left, {at_dof(dof)})) == 0);
  CHECK(rank_of(build(body, only_x_is_left, {at_dof(21)})) == 1);
}

TEST_CASE(
    "a very flexible clamped matrix has no rigid-body motion, but free parts with rounded entries have one") {
  const std::vector<support> clamp = {{0, 0, true}, {1, 0, true}};
  CHECK(by_matrix(build(beam_of(1000), {}, {}), clamp, {}).rigid_motions == 0);
  CHECK(by_matrix(build(beam_of(2500), {}, {}), clamp, {}).rigid_motions == 0);
  const auto triangle = [](double third) {
    assembled a;
    a.stiffness = {3, {{0, 0, 1.0}, {1, 1, 1.0}, {2, 2, 1.0}, {1, 0, -0.5}, {2, 0, -0.5}, {2, 1, third}}, {}};
    return a;
  };
  for (const double rounding : {1e-17, 1e-15, -1e-15, 2e-14, -2e-14, 1e-11}) {
    const linear_structure s = build(triangle(-0.5 - rounding), {}, {});
    CHECK(s.rigid_motions == 1);
    CHECK(std::abs(s.rigid_stiffness) <= std::abs(rounding) + 1e-15);
  }
  CHECK(build(triangle(-0.5 + 1e-7), {}, {}).rigid_motions == 0);
  CHECK_THAT(refusal_of(triangle(-0.5 - 1e-7), {}), Catch::Matchers::Contains("set free_motions = 1"));
  assembled declared = triangle(-0.5 - 1e-7);
  declared.free_motions = 1;
  CHECK(build(declared, {}, {}).rigid_motions == 1);
}

TEST_CASE(
    "a matrix that is indefinite or has a dof without stiffness is refused, and the message names the file") {
  using Catch::Matchers::Contains;
  assembled a;
  a.name = "K.mtx";
  a.stiffness = {2, {{0, 0, 1.0}, {1, 0, 2.0}, {1, 1, 1.0}}};
  CHECK_THAT(refusal_of(a, {}), Contains("K.mtx: the matrix is not positive semidefinite"));
  a.stiffness = {2, {{0, 0, 1.0}}};
  CHECK_THAT(refusal_of(a, {}), Contains("K.mtx: dof 2: found a row of zeros and no support"));
  CHECK(refusal_of(a, {{1, 0, true}}) == "accepted");
  CHECK(refusal_of(a, {{1, 0, false, 2.0}}) == "accepted");
  a.stiffness = braced(box_at(0), 1e5);
  const sparse_matrix other = braced(box_at(5), 1e5);
  for (const matrix_entry& e : other.entries)
    a.stiffness.entries.push_back({e.row + 24, e.column + 24, e.value});
  a.stiffness.order = 48;
  CHECK_THAT(refusal_of(a, {}), Contains("has more than 6 rigid-body motions"));
  a.stiffness = braced(box_at(0), 1e5);
  a.free_motions = 7;
  CHECK_THAT(refusal_of(a, {}), Contains("free_motions: found 7; allowed: 6, the number of rigid-body "
                                         "motions of the matrix with its supports"));
}

TEST_CASE("the order of the rows of a matrix does not change rigid-body motions or reactions") {
  const std::vector<support> supports = {{0, 0, true}, {24, 0, false, 50.0}};
  assembled a;
  a.stiffness = entries_of(build(beam_of(12), {}, {}));
  const linear_structure plain = build(a, supports, {at_dof(10)});
  for (int i = 0; i < a.dofs(); ++i) a.rows.push_back((i * 7 + 3) % a.dofs());
  const linear_structure mixed = build(a, supports, {at_dof(10)});
  REQUIRE(mixed.rigid_motions == plain.rigid_motions);
  CHECK(mixed.stiffness.band().subdiagonals() > plain.stiffness.band().subdiagonals());
  for (int dof = 0; dof < a.dofs(); ++dof) {
    CHECK(mixed.stiffness.band().at(mixed.row_of(dof), mixed.row_of(dof)) ==
          plain.stiffness.band().at(dof, dof));
  }
  std::vector<double> u(26, 0.0);
  u[24] = -0.25;
  load l;
  l.points.push_back({0, 0, 3.0});
  const std::vector<double> r = reactions(a, l, supports, u);
  REQUIRE(r.size() == 2);
  CHECK(r[0] == -3.0);  // no element deforms, so the support has the whole load
  CHECK(r[1] == 12.5);
}
