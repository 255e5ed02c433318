#include "contct/solve/factored_stiffness.hpp"

#include "catch.hpp"
#include "contct/matrix/several_right_hand_sides.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/solve/engine.hpp"
#include "contct/structure/plate.hpp"
#include "support/beam_over_stops.hpp"

using namespace contct::app;

namespace {

/// Clamped along x = 0 and wider than high: its rows are numbered otherwise than its dofs.
linear_structure wide_plate() {
  const plate p{{0, 1, 2, 3}, {0, 1}, 50.0, 0.3};
  std::vector<support> clamp;
  for (const int node : {0, 4})
    for (int dof = 0; dof < 3; ++dof) clamp.push_back({node, dof, true});
  return build(p, clamp, {{3, -1, 0.0, 20.0, false}, {7, -1, 0.0, 30.0, false}});
}

}  // namespace

TEST_CASE("one closed spring under the tip of a cantilever: w = F / (3 EI / L^3 + k)") {
  const linear_structure s = cantilever_over_stops(4);  // L = 2, EI = 1e4; the tip's k is 100
  factored_stiffness k(s);
  std::vector<double> u(s.dofs());
  u[8] = 5.0;
  u[0] = 7.0;  // on the support
  k.factor(std::vector<char>{0, 0, 0, 1});
  k.solve(u);
  CHECK(u[8] == Approx(5.0 / (3e4 / 8 + 100)).epsilon(1e-12));
  CHECK(u[0] == 0.0);
}

TEST_CASE("unit vectors, alone or in a block, give the columns that any right-hand side gives") {
  for (const bool dissected : {false, true}) {
    if (dissected && !sparse_factor::available()) continue;
    for (const linear_structure& s : {cantilever_over_stops(5), wide_plate()}) {
      factored_stiffness k(s, dissected);
      k.factor(std::vector<char>(s.pairs.size(), 1));
      const std::vector<int> dofs = {s.dofs() - 1, s.dofs() - 3, 0};  // the last one is fixed
      std::vector<double> block;
      k.solve_units(dofs, block);
      for (std::size_t i = 0; i < dofs.size(); ++i) {
        std::vector<double> e(s.dofs());
        std::vector<double> column(s.dofs());
        e[dofs[i]] = 1.0;
        k.solve(e);
        k.solve_unit(dofs[i], column);
        for (int dof = 0; dof < s.dofs(); ++dof) {
          CHECK(column[dof] == Approx(e[dof]).epsilon(1e-12).margin(1e-16));
          CHECK(block[s.row_of(dof) * block_width + i] == Approx(e[dof]).epsilon(1e-12).margin(1e-16));
        }
      }
    }
  }
}

TEST_CASE("a refined solution satisfies the equations to the last digits") {
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

TEST_CASE("a held structure whose matrix has no factor is refused") {
  linear_structure s = cantilever_over_stops(3);
  s.stiffness.band().at(4, 4) = -1.0;
  factored_stiffness k(s);
  CHECK_THROWS_AS(k.factor(std::vector<char>(3)), no_factor);
  CHECK(k.reciprocal_condition(std::vector<char>(3)) == 0.0);
}
