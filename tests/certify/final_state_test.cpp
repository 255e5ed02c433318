#include "contct/certify/final_state.hpp"

#include <cmath>

#include "catch.hpp"
#include "support/followed.hpp"

using namespace contct::app;

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
