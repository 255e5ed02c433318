// The reference solution as a step's end: as a fallback, what its certificate is worth, and in place of a
// path.
#include "contct/certify/final_state.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/certify/certificate.hpp"
#include "support/beams.hpp"
#include "support/followed.hpp"

using namespace contct::app;

namespace {

const beam_problem stop = cantilever_over_a_stop();

certifier certifier_of(const linear_structure& s) {
  return {
      s, [](int step, std::span<double> f) { add_consistent_loads(stop.geometry, stop.steps[step - 1], f); }};
}

}  // namespace

TEST_CASE("the final states without the path are those of the path, and certified") {
  random_problem_kind kind;
  kind.free_share = 0.2;
  int compared = 0;
  int without_equilibrium = 0;
  for (std::uint64_t number = 1; number <= 120; ++number) {
    const random_problem p = make_random_problem(5, number, kind);
    const linear_structure s = build(p.geometry, p.supports, p.pairs);
    const load_history total = [&p](int step, std::span<double> f) {
      add_consistent_loads(p.geometry, p.steps[static_cast<std::size_t>(step - 1)], f);
    };
    const followed path = follow(p);
    recorder only_the_end;
    certifier judged(s, total);
    const std::vector<observer*> watching = {&judged, &only_the_end};
    const path_end found = find_final_states(s, static_cast<int>(p.steps.size()), total, watching);
    INFO("problem " << number);
    CHECK(found.status == path.end.status);
    CHECK(found.work.factors >= 1);
    without_equilibrium += found.status == path_status::mechanism ? 1 : 0;
    CHECK(judged.all_exact());
    for (std::size_t step = 0; step < only_the_end.steps.size(); ++step) {
      if (!judged.steps()[step]->unique) continue;
      double off = 0.0;
      for (std::size_t dof = 0; dof < only_the_end.steps[step].u.size(); dof += path.stride)
        off = std::max(off, std::abs(path.seen.steps[step].u[dof] - only_the_end.steps[step].u[dof]));
      CHECK(off <= 2 * judged.steps()[step]->tolerance * path.largest());
      ++compared;
    }
  }
  CHECK(compared >= 100);
  CHECK(without_equilibrium >= 1);
}

TEST_CASE("a load that nothing carries has no final state, and the step is not told") {
  // Two props under a free beam: they carry its weight, and no pull.
  beam_problem p{even_beam(4.0, 4, 1.0), {}, {{0, -1, 0.0, 1.0, true}, {4, -1, 0.0, 1.0, true}}, {}};
  const linear_structure s = p.structure();
  const load_history total = [](int step, std::span<double> f) { f[4] = step == 1 ? -1.0 : 1.0; };
  recorder told;
  observer* const watching[] = {&told};
  const path_end end = find_final_states(s, 3, total, watching);
  CHECK(end.status == path_status::mechanism);
  CHECK(end.step == 2);
  REQUIRE(told.steps.size() == 1);
  CHECK(told.steps[0].u[4] < 0.0);
}

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
