// Tests steps that start from the unloaded structure, as combinations do.
#include "catch.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

/// Returns a clamped beam between stops. The first load presses the beam on the stops below, and the second
/// load on a stop above.
beam_problem between_stops() {
  beam_problem p;
  p.geometry = even_beam(4.0, 8, 100.0);
  p.supports = {{0, 0}, {0, 1}};
  p.pairs = {{2, face_below, -0.001, 5e3, false},
             {4, face_below, 0.0, 2e3, true},
             {5, face_above, 0.002, 7e3, false},
             {8, face_below, -0.03, 1e4, false}};
  p.steps = {tip_load(8, -40.0), tip_load(7, 13.0)};
  p.steps[1].points.push_back({3, 0, -30.0});
  p.steps[1].from_zero = true;
  return p;
}

recorder seen(const beam_problem& p, const std::string& engine, const std::string& kernel) {
  recorder r;
  CHECK(follow(p.as_problem(), p.structure(), engine, *make_kernel(kernel), {&r}).status ==
        path_status::solved);
  return r;
}

/// Returns a beam that lies on stops at its ends.
beam_problem lying(const std::vector<load>& steps) {
  beam_problem p;
  p.geometry = even_beam(4.0, 4, 100.0);
  p.pairs = {{0, face_below, 0.0, 1e4, true}, {4, face_below, 0.0, 1e4, true}};
  p.steps = steps;
  return p;
}

load from_zero(load l) {
  l.from_zero = true;
  return l;
}

}  // namespace

TEST_CASE("the path of a step from zero is the same to the bit with and without a step before it") {
  for (const char* kernel : {"fortran", "cpp", "corrected"}) {
    beam_problem p = between_stops();
    const recorder both = seen(p, "refactor", kernel);
    p.steps.erase(p.steps.begin());
    const recorder alone = seen(p, "refactor", kernel);
    REQUIRE(both.steps.size() == 2);
    REQUIRE(both.steps[0].isep != alone.steps[0].isep);
    CHECK(both.steps[1].u == alone.steps[0].u);
    CHECK(both.steps[1].isep == alone.steps[0].isep);
    const std::size_t before = both.increments.size() - alone.increments.size();
    REQUIRE(alone.increments.size() >= 3);
    for (std::size_t i = 0; i < alone.increments.size(); ++i) {
      CHECK(both.increments[before + i].s == alone.increments[i].s);
      CHECK(both.increments[before + i].events == alone.increments[i].events);
    }
  }
}

TEST_CASE("with an engine that keeps a factor, a step from zero also starts from the unloaded structure") {
  for (const char* engine : {"updated", "condensed"}) {
    beam_problem p = between_stops();
    const recorder both = seen(p, engine, "cpp");
    p.steps.erase(p.steps.begin());
    const recorder alone = seen(p, "refactor", "cpp");
    CHECK(both.steps.at(1).isep == alone.steps.at(0).isep);
    for (std::size_t dof = 0; dof < alone.steps[0].u.size(); ++dof)
      CHECK(both.steps[1].u[dof] == Approx(alone.steps[0].u[dof]).epsilon(1e-10).margin(1e-14));
  }
}

TEST_CASE("after a mechanism, only a step from zero and the steps that continue it are followed") {
  const load up = from_zero(tip_load(1, 7.0));
  const load down = tip_load(2, -8.0);
  const beam_problem p = lying({up, down, from_zero(down), tip_load(2, -4.0), up, from_zero(down)});
  for (const char* kernel : {"fortran", "corrected"}) {
    recorder r;
    const path_end end = p.run(kernel, {&r});
    CHECK(end.status == path_status::mechanism);
    CHECK(end.step == 1);
    REQUIRE(end.others.size() == 1);
    CHECK((end.others[0].status == path_status::mechanism && end.others[0].step == 5));
    REQUIRE(r.steps.size() == 5);
    CHECK(r.steps[1].step == 3);
    CHECK(r.steps[1].u[0] == Approx(-4.0 / 1e4).epsilon(1e-12));  // half of the load on each stop
    CHECK(r.steps[2].u[0] == Approx(-2.0 / 1e4).epsilon(1e-12));
    CHECK(r.steps[4].step == 6);
    CHECK(r.steps[4].u[0] == Approx(-4.0 / 1e4).epsilon(1e-12));
  }
}
