#include "contct/solve/factored_stiffness.hpp"

#include "catch.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/model/problem.hpp"
#include "contct/solve/engine.hpp"
#include "support/beam_over_stops.hpp"

using namespace contct;

namespace {

/// Returns a plate that is clamped along x = 0 and wider than high, so that its rows and its dofs have
/// different orders.
linear_structure wide_plate() {
  const plate p{{0, 1, 2, 3}, {0, 1}, 50.0, 0.3};
  std::vector<support> clamp;
  for (const int node : {0, 4})
    for (int dof = 0; dof < 3; ++dof) clamp.push_back({node, dof, true});
  return build(p, clamp, {{3, -1, 0.0, 20.0, false}, {7, -1, 0.0, 30.0, false}});
}

}  // namespace

TEST_CASE("a cantilever with a spring k under its tip deflects by F / (3 EI / L^3 + k)") {
  const linear_structure s = cantilever_over_stops(4);  // L = 2, EI = 1e4; k = 100 at the tip
  factored_stiffness k(s);
  std::vector<double> u(s.dofs());
  u[8] = 5.0;
  u[0] = 7.0;  // a load on a fixed dof
  k.factor(std::vector<char>{0, 0, 0, 1});
  k.solve(u);
  CHECK(u[8] == Approx(5.0 / (3e4 / 8 + 100)).epsilon(1e-12));
  CHECK(u[0] == 0.0);
}

TEST_CASE("the columns of the inverse at the pairs equal the solutions for unit loads at the pairs") {
  for (const factored_by how : {factored_by::storage, factored_by::cholmod}) {
    if (how == factored_by::cholmod && !sparse_factor::available()) continue;
    for (linear_structure s : {cantilever_over_stops(5), wide_plate()}) {
      s.pairs.push_back({0, -1, 0.0, 20.0, false});  // at a fixed dof
      factored_stiffness k(s, how);
      k.factor(std::vector<char>(s.pairs.size(), 1));
      const std::vector<int> pairs = {1, static_cast<int>(s.pairs.size()) - 1, 0};
      const std::vector<std::vector<double>> columns = k.columns_at_pairs(pairs);
      REQUIRE(columns.size() == pairs.size());
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::vector<double> e(s.dofs());
        e[s.dof_of_pair(pairs[i])] = 1.0;
        k.solve(e);
        std::vector<double> expected(s.pairs.size());
        gather_at_pairs(s, e, expected);
        for (std::size_t p = 0; p < expected.size(); ++p)
          CHECK(columns[i].at(p) == Approx(expected[p]).epsilon(1e-12).margin(1e-16));
      }
    }
  }
}

TEST_CASE("after refinement, the residual of a solution is only rounding") {
  const linear_structure s = wide_plate();
  const std::vector<char> closed = {1, 0};
  factored_stiffness k(s);
  k.factor(closed);
  std::vector<double> load(s.dofs());
  load[9] = -1.0;
  load[22] = 0.5;
  std::vector<double> u(s.dofs());
  k.solve_refined(load, u);
  const std::vector<double> left =
      residual(s.stiffness, springs_of(s, closed), in_rows(s, load), in_rows(s, u));
  for (const double entry : left) CHECK(std::abs(entry) <= 2e-14);
}

TEST_CASE("a structure with supports is refused if its matrix cannot be factored") {
  linear_structure s = cantilever_over_stops(3);
  s.stiffness.band().at(4, 4) = -1.0;
  factored_stiffness k(s);
  CHECK_THROWS_AS(k.factor(std::vector<char>(3)), no_factor);
  CHECK(k.reciprocal_condition(std::vector<char>(3)) == 0.0);
}

namespace {

/// Returns a structure of three dofs with a pair at each dof, and rows in the reverse order of dofs. The
/// first dof is fixed.
linear_structure three_dofs() {
  linear_structure s;
  s.dofs_per_node = 1;
  band_matrix k(3, 1);
  for (int row = 0; row < 3; ++row) k.at(row, row) = 4.0;
  k.at(1, 0) = -1.0;
  s.stiffness = k;
  s.stiffness.fix(std::vector<double>{0, 0, 1});
  s.rows = {2, 1, 0};
  s.fixed = {1, 0, 0};
  for (int node = 0; node < 3; ++node) s.pairs.push_back({node, -1, 0.0, 10.0 + node, false});
  return s;
}

}  // namespace

TEST_CASE("springs of pairs in contact are added in the rows of their dofs, but not at fixed dofs") {
  const std::vector<spring_at> springs = springs_of(three_dofs(), std::vector<char>{1, 0, 1});
  REQUIRE(springs.size() == 1);
  CHECK(springs[0].row == 0);
  CHECK(springs[0].stiffness == 12.0);
}

TEST_CASE(
    "loads are converted from dofs to rows, displacements from dofs to pairs, and forces from pairs to "
    "dofs") {
  const linear_structure s = three_dofs();
  const std::vector<double> load = {5, 6, 7};
  CHECK(in_rows(s, load) == std::vector<double>{7, 6, 0});
  std::vector<double> at_pairs(3);
  gather_at_pairs(s, load, at_pairs);
  CHECK(at_pairs == load);
  CHECK(with_pair_forces(s, load, std::vector<double>{1, -1, 0.5}) == std::vector<double>{5, 5, 7.5});
}

TEST_CASE("the residual is b - K x minus the forces of the springs") {
  const linear_structure s = three_dofs();
  const std::vector<spring_at> springs = {{0, 12.0}};
  const std::vector<double> left =
      residual(s.stiffness, springs, std::vector<double>{100, 10, 0}, std::vector<double>{2, 3, 0});
  CHECK(left == std::vector<double>{100 - (4 * 2 - 3 + 12 * 2), 10 - (4 * 3 - 2), 0});
}

TEST_CASE(
    "corrections make an inexact solver precise, but a correction that is larger than the one before is not "
    "applied") {
  const linear_structure s = three_dofs();
  const std::vector<spring_at> springs = {{0, 12.0}};
  std::vector<double> u(3);
  int solves = 0;
  const auto jacobi = [&solves](double factor) {  // approximate: ignores the coupling of -1
    return [&solves, factor](std::span<double> b) {
      ++solves;
      b[0] *= factor / 16;
      b[1] *= factor / 4;
    };
  };
  solve_refined(s, s.stiffness, springs, jacobi(1.0), std::vector<double>{9, 1, 15}, u);
  // 16 x0 - x1 = 15 and 4 x1 - x0 = 1, where row 0 is dof 2.
  CHECK(u[0] == 0.0);
  CHECK(u[1] == Approx(31.0 / 63).epsilon(1e-5));
  CHECK(u[2] == Approx(61.0 / 63).epsilon(1e-5));
  CHECK(solves == 7);  // one solve, and at most six corrections
  solves = 0;
  solve_refined(s, s.stiffness, springs, jacobi(-1.0), std::vector<double>{0, 1, 15}, u);
  CHECK(solves == 3);  // the second correction is larger, and not applied
}
