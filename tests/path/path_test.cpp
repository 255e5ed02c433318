// Tests the 1989 loop on problems that can be solved by hand.
#include "contct/path/path.hpp"

#include <cmath>

#include "catch.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

TEST_CASE(
    "the tip of a cantilever (PB1) meets the stop at F = -15, and the stop has the force of the hand "
    "calculation") {
  for (const char* kernel : {"fortran", "cpp"}) {
    recorder r;
    const path_end end = cantilever_over_a_stop().run(kernel, {&r});
    CHECK(end.status == path_status::solved);
    REQUIRE(r.steps.size() == 4);
    const double f = 8.0 / 3 / 1e4;
    CHECK(r.steps[0].u[4] == Approx(-10 * f).epsilon(1e-13));
    for (const auto& [step, load] : {std::pair{1, 60.0}, std::pair{2, 30.0}}) {
      const double n = (load * f - 0.004) / (f + 1 / 5e4);
      CHECK(r.steps[static_cast<std::size_t>(step)].u[4] == Approx(-0.004 - n / 5e4).epsilon(1e-12));
    }
    CHECK(r.steps[3].u[4] == Approx(20 * f).epsilon(1e-12));
    CHECK(r.events() == std::vector<event>{{0, change::make}, {0, change::break_}});
    CHECK(r.increments[1].s == Approx(0.1).epsilon(1e-13));
    CHECK(r.increments[1].fraction == Approx(0.1).epsilon(1e-13));
    CHECK(r.increments[4].fraction == Approx(0.3).epsilon(1e-12));
    CHECK(r.increments[5].fraction == 1.0);
    CHECK(r.text.find("BREAKING CONTACT") != std::string::npos);
  }
}

TEST_CASE("a face above stops a beam that moves up") {
  beam_problem p = cantilever_over_a_stop();
  p.pairs = {{2, 1, 0.002, 5e4, false}, {2, -1, -0.004, 5e4, false}};  // two pairs at one node
  p.steps = {tip_load(2, 30), tip_load(2, -30)};
  recorder r;
  CHECK(p.run("fortran", {&r}).status == path_status::solved);
  const double f = 8.0 / 3 / 1e4;
  const double n = (30 * f - 0.002) / (f + 1 / 5e4);
  CHECK(r.steps[0].u[4] == Approx(0.002 + n / 5e4).epsilon(1e-12));
  CHECK(r.events() == std::vector<event>{{0, change::make}, {0, change::break_}, {1, change::make}});
}

TEST_CASE("a pair at a fixed dof does not change the path") {
  beam_problem p = cantilever_over_a_stop();
  recorder without;
  p.run("fortran", {&without});
  p.pairs.push_back({0, -1, -1.0, 1e9, false});
  recorder with;
  CHECK(p.run("fortran", {&with}).status == path_status::solved);
  for (std::size_t i = 0; i < 4; ++i) CHECK(with.steps[i].u == without.steps[i].u);
}

TEST_CASE("at the end of a step, elastic forces and contact forces of a beam on springs balance the load") {
  beam_problem p = free_beam_on_springs(6.0, 24, 1.0, 4.0);
  p.steps = {{{{10, 0, -1.0}}, {}}, {{{12, 0, -2.0}, {20, 0, -0.2}}, {}}};
  recorder r;
  REQUIRE(p.run("fortran", {&r}).status == path_status::solved);
  const linear_structure s = p.structure();
  for (std::size_t step = 0; step < p.steps.size(); ++step) {
    std::vector<double> f(static_cast<std::size_t>(s.dofs()), 0.0);
    add_consistent_loads(p.geometry, p.steps[step], f);
    std::vector<double> ku = product(s.stiffness.band(), r.steps[step].u);
    for (std::size_t i = 0; i < p.pairs.size(); ++i) {
      if (r.steps[step].isep[i] == in_contact) ku[2 * i] += p.pairs[i].stiffness * r.steps[step].u[2 * i];
    }
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(ku[i] == Approx(f[i]).margin(1e-9));
  }
}

TEST_CASE("at the end of a step, a support has its prescribed settlement and the beam follows the support") {
  problem p;
  p.geometry = {even_beam(2.0, 2, 1e4)};
  p.supports = {{0, 0, true}, {2, 0, true}};
  p.steps = {{{}, {}, {{2, 0, -0.5}}}};
  recorder r;
  CHECK(follow(p, structure_of(p), "refactor", *make_kernel("fortran"), {&r}).status == path_status::solved);
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].u[4] == -0.5);
  CHECK(r.steps[0].u[2] == Approx(-0.25));
}
