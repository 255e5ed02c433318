// Tests functions that beams, plates and matrices have in common, and the exact meaning of a file's numbers.
#include "contct/structure/structure.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "catch.hpp"
#include "contct/structure/acting.hpp"
#include "contct/structure/placed_loads.hpp"
#include "contct/structure/statics.hpp"
#include "support/matrices.hpp"

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

const beam two_spans{{0.0, 1.0, 3.0}, {2.0, 2.0}};
const plate small{{1.0, 2.0, 4.0}, {0.0, 1.0}, 1.0, 0.3};

std::vector<element_piece> pieces_on(const beam& b, const load& l, int element) {
  const auto all = pieces_of(b, l);
  const auto* const pieces = pieces_at(all, element);
  return pieces == nullptr ? std::vector<element_piece>{} : *pieces;
}

/// Returns the coefficients of a load that is one polynomial on the element.
std::vector<double> load_on(const beam& b, const load& l, int element) {
  const std::vector<element_piece> pieces = pieces_on(b, l, element);
  REQUIRE(pieces.size() == 1);
  std::vector<double> q;
  for (const double_double& coefficient : pieces[0].q) q.push_back(coefficient.hi);
  return q;
}

double_double decimal(double x) {
  return number_of<double_double>(x);
}

const std::vector<double> sixth_power = {1e18, -6e15, 1.5e13, -2e10, 1.5e7, -6000, 1};  // (x - 1000)^6

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

TEST_CASE("a support acts in the row of its dof, and only a dof that was built to settle may settle") {
  linear_structure s = four_dofs();
  put_on_supports(s, std::vector<support>{{0, 1, true}, {1, 0, false, 7.0}}, {{2, 1, 0.5, 3.0, false}});
  CHECK(s.fixed == std::vector<char>{0, 1, 0, 0});
  CHECK(s.stiffness.diagonal_with({}) == std::vector<double>{10, 27, 1, 40});  // row 2 belongs to dof 1
  CHECK(s.stiffness.band().at(2, 1) == 0.0);
  CHECK(s.stiffness.band().at(3, 2) == 0.0);
  CHECK(s.stiffness.band().at(1, 0) == 1.0);
  CHECK(s.supported_dofs == std::vector<int>{1, 2});
  CHECK(s.row_of(2) == 1);
  CHECK(s.deflects(2));
  CHECK_FALSE(s.deflects(3));
  s.settles = {0, 0, 0, 1};
  const std::vector<double> none(4);
  CHECK_THROWS_WITH(right_hand_side(s, {none, none, {0, 0, 0.5, 0}, none}), "dof 3 was not built to settle");
}

TEST_CASE("a support that settles has a finite pivot even next to the largest stiffness in doubles") {
  linear_structure s = four_dofs();
  s.stiffness.diagonal(s.row_of(0)) += std::numeric_limits<double>::max();
  put_on_supports(s, std::vector<support>{{0, 0, true, 0.0, true}}, {});
  CHECK(s.stiffness.diagonal(s.row_of(0)) == std::ldexp(1.0, 1022));
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
  // The load at the end of a step equals the load of the file, to the bit.
  CHECK(mix({{{0, 0, 0.7}}, {}}, {{{0, 0, 0.1}}, {}}, 1.0).points[0].value == 0.1);
}

TEST_CASE("a distributed load acts on the elements of its list, or on all elements if it has no list") {
  std::vector<std::pair<int, double>> loaded;
  for_each_loaded_element(
      {{}, {{{1.0}, {}}, {{2.0, 3.0}, {2, 0}}}}, 3,
      [&](int e, const std::vector<double>& polynomial) { loaded.emplace_back(e, polynomial[0]); });
  CHECK(loaded == std::vector<std::pair<int, double>>{{0, 1}, {1, 1}, {2, 1}, {2, 2}, {0, 2}});
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
    "a beam and a plate have counts of nodes, elements and dofs, names of dofs, and tributary shares of "
    "nodes") {
  using words = std::vector<std::string>;
  for (const auto& [m, counts, names, shares] :
       {std::tuple(model(two_spans), std::array{3, 2, 2, 6}, words{"w", "theta"}, std::vector{0.5, 1.5, 1.0}),
        {small, {6, 2, 3, 18}, {"w", "wx", "wy"}, {0.25, 0.75, 0.5, 0.25, 0.75, 0.5}}}) {
    CHECK(std::array{nodes(m), elements(m), dofs_per_node(m), dofs(m)} == counts);
    CHECK(words(dof_names(m).begin(), dof_names(m).end()) == names);
    CHECK(tributary_shares(m) == shares);
  }
}

TEST_CASE("the resultant of a load is exact: a force, and one moment on a beam or two on a plate") {
  const resultant b = resultant_of(model{two_spans}, {{{1, 0, -4.0}, {2, 1, 0.5}}, {{{-2.0}, {1}}}});
  CHECK(b.force == -8.0);
  CHECK(b.moments == std::vector<double>{-4.0 * 1 - 4.0 * 2 + 0.5});
  // Element 2 covers x from 2 to 4 and y from 0 to 1; node 4 is at (1, 1).
  const resultant p =
      resultant_of(model{small}, {{{3, 0, -4.0}, {0, 1, 0.5}, {0, 2, 0.25}}, {{{-1.0}, {1}}}});
  CHECK(p.force == -6.0);
  CHECK(p.moments == std::vector<double>{-4.0 * 1 - 2.0 * 3 + 0.5, -4.0 * 1 - 2.0 * 0.5 + 0.25});
  const load far{{}, {{{1e18, -6e15, 1.5e13, -2e10, 1.5e7, -6000, 1}, {}}}};  // (x - 1000)^6
  const resultant r = resultant_of(model{beam{{1000, 1001, 1002}, {1, 1}}}, far);
  CHECK(r.force == 128.0 / 7);
  CHECK(r.moments[0] == 128.0 * 1000 / 7 + 32);
  assembled matrix;
  matrix.stiffness.order = 3;
  for (const model& m : {model{two_spans}, model{small}, model{matrix}})
    CHECK(resultant_of(m, {{{0, 0, 0.1}, {1, 0, 0.2}, {2, 0, -0.3}}, {}}).force == 0.0);
}

TEST_CASE("point loads at one dof add up, and the reaction of a dof that settles balances its spring") {
  CHECK(nodal_loads(two_spans, {{{1, 0, 2.0}, {1, 0, 3.0}, {0, 1, -1.0}}, {}}).force ==
        std::vector<double>{0, -1, 5, 0, 0, 0});
  const std::vector<support> supports = {{1, 0, true}, {1, 0, false, 4.0}, {1, 0, true}};
  const load l{{{1, 0, -3.0}}, {}, {{1, 0, 0.5}}};
  const std::vector<double> all_up = {0.5, 0, 0.5, 0, 0.5, 0};  // no element is bent
  // The reactions balance the load: 5 - 2 = 3. The third support, which fixes the same dof again, gets 0.
  CHECK(reactions(two_spans, l, supports, all_up) == std::vector<double>{5.0, -2.0, 0.0});
}

TEST_CASE("the number 0.1 is read as the decimal one tenth, and not as the double next to one tenth") {
  CHECK(decimal(0.1).hi == 0.1);
  CHECK(decimal(0.1).lo != 0.0);
  CHECK(std::abs((decimal(0.1) * 10 - 1.0).hi) <= 0x1p-100);
  CHECK(std::abs((decimal(-2.5e-7) * 4e6 + 1.0).hi) <= 0x1p-100);
  CHECK(std::abs((decimal(1.25e22) / 1e22 - 1.25).hi) <= 0x1p-100);
  for (const double x : {0.0, -0.0, 3.0, -7.0, 0x1p52, 0.5, 0.25}) {
    CHECK(decimal(x).hi == x);
    CHECK(decimal(x).lo == 0.0);
  }
}

TEST_CASE("decimals at the ends of the range of doubles equal the doubles") {
  for (const double x : {5e-324, -5e-324, 1e-310, 2.2250738585072014e-308, -1.2345678901234567e-300,
                         1.2345678901234567e-293, 1.7976931348623157e308}) {
    INFO(x);
    CHECK(decimal(x).hi == x);
    CHECK(std::abs(decimal(x).lo) <= std::abs(x) * 0x1p-53);
    CHECK(difference_of<double_double>(x, 1.0).hi == x - 1.0);
  }
}

TEST_CASE("decimals are added exactly before rounding, so 0.1, 0.2 and -0.3 have the sum 0") {
  const auto loads = [](const std::vector<double>& parts) {
    std::vector<point_load> all;
    for (const double x : parts) all.push_back({0, 0, x});
    return all;
  };
  const auto sum = [&](const std::vector<double>& parts) { return sum_of<double_double>(loads(parts)); };
  CHECK(sum({}) == 0.0);
  CHECK(sum({0.1, 0.2, -0.3}) == 0.0);
  CHECK(sum({-0.3, 1e-20, 0.2, 0.1}) == decimal(1e-20));
  CHECK(sum({1e300, 1e-300, -1e300}) == decimal(1e-300));
  CHECK(sum_of<double>(loads({0.1, 0.2, -0.3})) == 0.0);
}

TEST_CASE("numbers with factors are products of two decimals, rounded once, and their sums are exact") {
  CHECK(product_of<rational>(0.1, 1.1) == rational(11, 100));
  CHECK(product_of<double>(0.1, 3.0) == 0.3);  // in doubles 0.1 * 3.0 is 0.30000000000000004
  CHECK(product_of<double_double>(0.1, 1.1) == decimal(0.11));
  CHECK(product_of<double>(0.1, 1.0) == 0.1);
  const std::vector<point_load> cancel = {{0, 0, 0.1, 3.0}, {0, 0, -0.3}, {0, 0, 1.1, 0.1}, {0, 0, -0.11}};
  CHECK(sum_of<double>(cancel) == 0.0);
  CHECK(sum_of<rational>(cancel) == 0);
  const distributed_load d{{-0.135}, {}, {{{-0.1}, 1.35}, {{0.3}, 0.1}, {{-0.03}}}};
  CHECK(coefficients_of(d) == std::vector<rational>{rational(-135, 1000)});
}

TEST_CASE("A polynomial face is exact, even if its terms are 1e33 times as large as the face") {
  const beam b{{0.0, 1.1, 2.2}, {1e4, 1e4}};
  CHECK(
      values_at<double_double>(b, std::vector<double>{-0.001, -1.21e30, 0.0, 1e30}, std::vector<int>{1, 0}) ==
      std::vector<double_double>{decimal(-0.001), decimal(-0.001)});
  const beam thirds{{0.0, 1.0 / 3, 2.0 / 3, 1.0}, {1, 1, 1}, {{1.0, 3}}};
  CHECK(values_at<double_double>(thirds, std::vector<double>{-1.0, 3.0}, std::vector<int>{1, 2}) ==
        std::vector<double_double>{0.0, 1.0});
  CHECK(tributary_lengths<double>(std::vector<double>{2, 1}) == std::vector<double>{1, 1.5, 0.5});
}

TEST_CASE("The load (x - 1000)^6 is t^6 in the coordinate t of the element that begins at x = 1000") {
  const beam b{{1000.0, 1001.0, 1003.0}, {1, 1}};
  const load l{{}, {{sixth_power, {}}}};
  CHECK(load_on(b, l, 0) == std::vector<double>{0, 0, 0, 0, 0, 0, 1});
  CHECK(load_on(b, l, 1) == std::vector<double>{1, 12, 60, 160, 240, 192, 64});  // (1 + 2 t)^6
  CHECK(pieces_on(b, l, 0).at(0).size == 1.0);
}

TEST_CASE(
    "The polynomials of a distributed load are added exactly, and then expressed in the coordinate of an "
    "element") {
  const beam b{{0.0, 1.0, 2.0}, {1, 1}};
  load l{{}, {{{0.1 + 0.2 - 0.3}, {1}, {{{0.1}}, {{0.2}}, {{-0.3}}}}}};
  CHECK(load_on(b, l, 1) == std::vector<double>{0.0});
  CHECK(pieces_on(b, l, 0).empty());
  CHECK(pieces_on(b, l, 1).at(0).size == 0.0);
  l.distributed.push_back({{4.0, 2.0}, {}});
  CHECK(load_on(b, l, 0) == std::vector<double>{4.0, 2.0});
  CHECK(load_on(b, l, 1) == std::vector<double>{6.0, 2.0});
}

TEST_CASE("Equal elements under the same constant loads share one list of load pieces") {
  const beam b{{0.0, 0.1, 0.2, 0.3, 0.7}, {1, 1, 1, 1}};
  const auto all = pieces_of(b, {{}, {{{4.0}, {}}, {{2.0}, {1, 2, 3}}}});
  REQUIRE(all.size() == 3);
  CHECK(all.at(0).last == 0);
  CHECK(all.at(1).last == 2);
  CHECK(all.at(3).last == 3);  // this element has another length
  CHECK(pieces_at(all, 2)->at(0).q[0] == 6.0);
}
