#include "contct/path/refactor_engine.hpp"

#include <stdexcept>

#include "catch.hpp"
#include "path/beams.hpp"

using namespace contct;

TEST_CASE("the response is proportional to the residual load, and the springs in it can be switched") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  refactor_engine engine(s);
  std::vector<double> increment(6, 0.0);
  increment[4] = 1.0;
  std::vector<double> d_star(6);
  const double f = 8.0 / 3 / 1e4;
  engine.respond({increment, 1.0}, d_star);
  CHECK(d_star[4] == Approx(f).epsilon(1e-13));
  engine.respond({increment, 0.25}, d_star);
  CHECK(d_star[4] == Approx(f / 4).epsilon(1e-13));
  engine.switch_spring(0, true);
  engine.respond({increment, 1.0}, d_star);
  CHECK(d_star[4] == Approx(1 / (1 / f + 5e4)).epsilon(1e-13));
  engine.switch_spring(0, false);
  engine.respond({increment, 1.0}, d_star);
  CHECK(d_star[4] == Approx(f).epsilon(1e-13));
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

TEST_CASE("engines are made by name, an unknown one is refused, and the known ones are told") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  for (const std::string& name : engine_names()) CHECK(make_engine(name, s)->name() == name);
  CHECK_THROWS_WITH(make_engine("warp", s), Catch::Matchers::Contains("refactor"));
}

TEST_CASE("a stiffness matrix without a factor is an exception, not a number") {
  beam_problem p{even_beam(1.0, 1, 1.0), {}, {}, {}};
  linear_structure s = p.structure();
  s.stiffness.add(0, 0, -100.0);
  refactor_engine engine(s);
  std::vector<double> d_star(4);
  CHECK_THROWS_AS(engine.respond({std::vector<double>(4, 1.0), 1.0}, d_star), no_factor);
}
