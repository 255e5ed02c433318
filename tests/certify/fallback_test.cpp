// A step that the path cannot end, ended by the reference solution, and what its certificate is worth.
#include "contct/certify/fallback.hpp"

#include "catch.hpp"
#include "contct/certify/certificate.hpp"
#include "support/beams.hpp"

using namespace contct::app;

namespace {

const beam_problem stop = cantilever_over_a_stop();

certifier certifier_of(const linear_structure& s) {
  return {
      s, [](int step, std::span<double> f) { add_consistent_loads(stop.geometry, stop.steps[step - 1], f); }};
}

}  // namespace

TEST_CASE("the fallback finds the equilibrium, with a spring that is pressed, and none where nothing holds") {
  const linear_structure s = stop.structure();
  std::vector<double> load(s.dofs());
  load[4] = -60.0;
  const auto found = fallback_to_reference(s)(load);
  REQUIRE(found.has_value());
  const double flexibility = 8.0 / 3 / 1e4;
  const double force = (60 * flexibility - 0.004) / (flexibility + 1 / 5e4);
  CHECK(found->displacement[4] == Approx(-0.004 - force / 5e4).epsilon(1e-12));
  CHECK(found->closed == std::vector<char>{1});

  beam_problem free = stop;
  free.supports.clear();
  const linear_structure nothing_holds = free.structure();
  load[4] = 60.0;  // away from its only face
  CHECK_FALSE(fallback_to_reference(nothing_holds)(load).has_value());
}

TEST_CASE(
    "the certificate of a fallback is not independent: it compares the reference solution with itself") {
  const linear_structure s = stop.structure();
  certifier judged = certifier_of(s);
  recorder seen;
  // One increment is enough for the first step alone, in which nothing touches.
  REQUIRE(stop.run("corrected", {&seen, &judged}, {1, fallback_to_reference(s)}).status ==
          path_status::solved);
  REQUIRE(judged.steps().size() == 4);
  CHECK_FALSE(seen.steps[0].from_fallback);
  CHECK(judged.steps()[0]->independent);
  CHECK(seen.steps[1].from_fallback);
  CHECK_FALSE(judged.steps()[1]->independent);
  CHECK(judged.steps()[1]->exact);
}

TEST_CASE("a state of the reference solution's own is still judged by its balance") {
  const linear_structure s = stop.structure();
  certifier judged = certifier_of(s);
  std::vector<double> u(s.dofs());
  u[4] = -0.01;  // no equilibrium under any of the loads
  const std::vector<int> status = {in_contact};
  judged.step_ended({.step = 2,
                     .fraction = 1.0,
                     .displacement = u,
                     .isep = status,
                     .rcond = 1e-3,
                     .from_fallback = true,
                     .from_reference = true});
  REQUIRE(judged.steps().size() == 1);
  CHECK_FALSE(judged.steps()[0]->independent);
  CHECK_FALSE(judged.steps()[0]->exact);
  CHECK(judged.steps()[0]->equilibrium > 0.01);
}
