#include "contct/model/structure.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "catch.hpp"

using namespace contct;

namespace {

/// Returns a structure of two nodes with two dofs each, and rows in the reverse order of dofs.
linear_structure four_dofs() {
  linear_structure s;
  s.dofs_per_node = 2;
  band_matrix k(4, 1);
  for (int row = 0; row < 4; ++row) k.at(row, row) = 10.0 * (row + 1);
  for (int row = 1; row < 4; ++row) k.at(row, row - 1) = 1.0;
  s.stiffness = k;
  s.rows = {3, 2, 1, 0};
  s.rigid_rows = {{1, 0}, {0, 1}, {1, 2}, {0, 3}};
  return s;
}

}  // namespace

TEST_CASE(
    "gap and contact force have the same signs above and below, and a pulling pair has a negative force") {
  const contact_pair below = {0, -1, -0.5, 100.0, false};  // a face below the node, at -0.5
  CHECK(gap_of(below, 0.0, false) == 0.5);
  CHECK(gap_of(below, -0.5, false) == 0.0);
  CHECK(gap_of(below, 0.0, true) == 0.0);
  CHECK(force_of(below, -0.75, true) == 25.0);  // pressed
  CHECK(force_of(below, -0.25, true) == -25.0);
  CHECK(force_of(below, -0.75, false) == 0.0);
  const contact_pair above = {0, 1, 0.5, 100.0, false};
  CHECK(gap_of(above, 0.25, false) == 0.25);
  CHECK(force_of(above, 0.75, true) == 25.0);
}

TEST_CASE("a support acts in the row of its dof") {
  linear_structure s = four_dofs();
  put_on_supports(s, std::vector<support>{{0, 1, true}, {1, 0, false, 7.0}}, {{1, 1, 0.5, 3.0, false}});
  CHECK(s.fixed == std::vector<char>{0, 1, 0, 0});
  CHECK(s.stiffness.diagonal_with({}) == std::vector<double>{10, 27, 1, 40});  // row 2 belongs to dof 1
  CHECK(s.stiffness.band().at(2, 1) == 0.0);
  CHECK(s.stiffness.band().at(3, 2) == 0.0);
  CHECK(s.stiffness.band().at(1, 0) == 1.0);
  CHECK(s.supported_dofs == std::vector<int>{1, 2});
  CHECK(s.dof_of_pair(0) == 2);
  CHECK(s.row_of(2) == 1);
  CHECK(s.deflects(2));
  CHECK_FALSE(s.deflects(3));
}

TEST_CASE(
    "a load within a step is a mixture of the loads before and after the step, and loads at one place are "
    "added") {
  const load before{{{2, 0, -10.0}}, {{{-4.0}, {}}}};
  const load after{{{2, 0, -60.0}, {1, 1, 5.0}}, {{{-8.0, 2.0}, {}}, {{1.0}, {0}}}};
  const load at = mix(before, after, 0.1);
  REQUIRE(at.points.size() == 2);
  CHECK(at.points[0].node == 1);
  CHECK(at.points[0].value == Approx(0.5));
  CHECK(at.points[1].value == Approx(-15.0));
  REQUIRE(at.distributed.size() == 2);
  CHECK(at.distributed[0].elements.empty());
  CHECK(at.distributed[0].polynomial[0] == Approx(-4.4));
  CHECK(at.distributed[0].polynomial[1] == Approx(0.2));
  CHECK(at.distributed[1].polynomial[0] == Approx(0.1));
}

TEST_CASE("the load at the end of a step equals the load of the file, to the bit") {
  const load after{{{0, 0, 0.1}}, {}};
  CHECK(mix({{{0, 0, 0.7}}, {}}, after, 1.0).points[0].value == 0.1);
}

TEST_CASE("a distributed load acts on the elements of its list, or on all elements if it has no list") {
  const load l{{}, {{{1.0}, {}}, {{2.0, 3.0}, {2, 0}}}};
  std::vector<int> elements;
  std::vector<double> constants;
  for_each_loaded_element(l, 3, [&](int e, const std::vector<double>& polynomial) {
    elements.push_back(e);
    constants.push_back(polynomial[0]);
  });
  CHECK(elements == std::vector<int>{0, 1, 2, 2, 0});
  CHECK(constants == std::vector<double>{1, 1, 1, 2, 2});
}

TEST_CASE("the Gauss rule of n points is exact for polynomials of degree 2 n - 1, but not of degree 2 n") {
  for (int n = 1; n <= 13; ++n) {
    const auto integral = [&](int degree) {
      double sum = 0.0;
      for (const auto& [t, weight] : gauss_points(n)) sum += weight * std::pow(t, degree);
      return sum;
    };
    for (int degree = 0; degree <= 2 * n - 1; ++degree) {
      INFO(n << " points, degree " << degree);
      CHECK(integral(degree) == Approx(1.0 / (degree + 1)).epsilon(1e-14));
    }
    if (n <= 4) CHECK(std::abs(integral(2 * n) - 1.0 / (2 * n + 1)) > 1e-6);
  }
}

TEST_CASE(
    "add_settlements refuses a dof that was not built to settle, and the message counts the dof from 1") {
  linear_structure s = four_dofs();
  s.settles = {0, 0, 0, 1};
  std::vector<double> f(4);
  CHECK_THROWS_WITH(add_settlements(s, {{}, {}, {{1, 0, 0.5}}}, f), "dof 3 was not built to settle");
}

TEST_CASE("a support that settles has a finite pivot even next to the largest stiffness in doubles") {
  constexpr double largest = std::numeric_limits<double>::max();
  linear_structure s = four_dofs();
  s.stiffness.add_to_diagonal(s.row_of(0), largest);
  std::vector<support> settling = {{0, 0, true}};
  settling[0].settles = true;
  put_on_supports(s, settling, {});
  CHECK(s.stiffness.diagonal(s.row_of(0)) == std::ldexp(1.0, 1022));
}
