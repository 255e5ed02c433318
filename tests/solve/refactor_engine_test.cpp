#include "contct/solve/refactor_engine.hpp"

#include <stdexcept>

#include "catch.hpp"
#include "contct/structure/plate.hpp"
#include "support/beams.hpp"

using namespace contct::app;

TEST_CASE("the response is proportional to the residual load, and the springs in it can be switched") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  refactor_engine engine(s);
  std::vector<double> increment(6, 0.0);
  increment[4] = 1.0;
  std::vector<double> d_star(1);
  const double f = 8.0 / 3 / 1e4;
  engine.respond({increment, 1.0}, d_star);
  CHECK(d_star[0] == Approx(f).epsilon(1e-13));
  engine.respond({increment, 0.25}, d_star);
  CHECK(d_star[0] == Approx(f / 4).epsilon(1e-13));
  engine.switch_spring(0, true);
  engine.respond({increment, 1.0}, d_star);
  CHECK(d_star[0] == Approx(1 / (1 / f + 5e4)).epsilon(1e-13));
  engine.switch_spring(0, false);
  engine.respond({increment, 1.0}, d_star);
  CHECK(d_star[0] == Approx(f).epsilon(1e-13));
}

TEST_CASE("recovery gives every dof from the load and the pairs' forces") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  refactor_engine engine(s);
  std::vector<double> u(6);
  engine.recover(std::vector<double>{7, 7, 0, 0, -2, 0}, std::vector<double>{1.0}, u);
  const double f = 8.0 / 3 / 1e4;
  CHECK(u[4] == Approx(-f).epsilon(1e-13));
  CHECK(u[0] == 0.0);  // loads on fixed dofs go to the support
  CHECK(u[1] == 0.0);
}

TEST_CASE("a stiffness matrix without a factor is an exception, not a number") {
  beam_problem p{even_beam(1.0, 1, 1.0), {}, {}, {}};
  linear_structure s = p.structure();
  s.stiffness.band().add(0, 0, -100.0);
  refactor_engine engine(s);
  std::vector<double> d_star(0);
  CHECK_THROWS_AS(engine.respond({std::vector<double>(4, 1.0), 1.0}, d_star), no_factor);
}

TEST_CASE(
    "whichever way a plate is numbered inside, dofs, supports, pairs and forces keep their own numbers") {
  // The same plate lying and standing: 5 by 2 elements numbered along y, 2 by 5 in its own order.
  const plate lying{{0, 1, 2, 3, 4, 5}, {0, 0.5, 1.5}, 2.0, 0.3};
  const plate standing{lying.y, lying.x, lying.D, lying.nu};
  const auto place = [&](const plate& p, int i, int j) {
    return &p == &lying ? p.node_at(i, j) : p.node_at(j, i);
  };
  std::vector<std::vector<double>> answers;
  for (const plate* p : {&lying, &standing}) {
    const int along = p == &lying ? 1 : 2;  // the slope along the long side
    const std::vector<support> supports = {{place(*p, 0, 0), 0, true},
                                           {place(*p, 0, 2), 0, true},
                                           {place(*p, 0, 1), along, true},
                                           {place(*p, 5, 0), 0, false, 3.0}};
    const linear_structure s =
        build(*p, supports, {{place(*p, 5, 2), -1, 0.0, 2.0, false}, {place(*p, 2, 1), -1, 0.0, 5.0, true}});
    CHECK(s.rows.empty() == (p == &standing));
    CHECK(s.stiffness.band().subdiagonals() == 14);
    refactor_engine engine(s);
    engine.switch_spring(0, true);
    std::vector<double> increment(static_cast<std::size_t>(p->dofs()), 0.0);
    increment[static_cast<std::size_t>(3 * place(*p, 3, 2))] = -1.0;
    increment[static_cast<std::size_t>(3 * place(*p, 4, 0) + along)] = 0.5;
    std::vector<double> d_star(2);
    std::vector<double> u(increment.size());
    engine.respond({increment, 1.0}, d_star);
    engine.recover(increment, std::vector<double>{0.25, -0.125}, u);
    std::vector<double> answer = d_star;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 3; ++j) {
        const auto at = static_cast<std::size_t>(3 * place(*p, i, j));
        answer.insert(answer.end(), {u[at], u[at + static_cast<std::size_t>(along)]});
      }
    }
    CHECK(u[static_cast<std::size_t>(3 * place(*p, 0, 2))] == 0.0);
    answers.push_back(answer);
  }
  for (std::size_t i = 0; i < answers[0].size(); ++i)
    CHECK(answers[0][i] == Approx(answers[1][i]).epsilon(1e-10).margin(1e-13));
}
