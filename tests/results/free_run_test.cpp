// Tests the comparison of kernels that follow their own paths.
#include "contct/results/free_run.hpp"

#include <cmath>
#include <functional>

#include "catch.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

recorded_path free_run(const beam_problem& p, const char* kernel) {
  recorded_path r;
  r.take(p.run(kernel, {&r.record}));
  return r;
}

}  // namespace

TEST_CASE("a free run reports a different event, a missing event, a different end and a wrong rotation") {
  const recorded_path leader = free_run(cantilever_over_a_stop(), "fortran");
  using row = std::tuple<std::function<void(recorded_path&)>, bool, bool, const char*>;
  for (const auto& [change, same_events, far, words] :
       {row{[](recorded_path& p) { p.record.steps[3].increments[0].events[0].what = change::make; }, false,
            false, "the leader: step 4, pair 1 breaks contact; this kernel: step 4, pair 1 makes contact"},
        {[](recorded_path& p) { p.record.steps[3].increments[0].events.clear(); }, false, false,
         "no further event"},
        {[](recorded_path& p) { p.end.status = path_status::mechanism; }, true, false, ""},
        {[](recorded_path& p) { p.record.steps[2].displacement[5] *= 1.001; }, true, true,
         ""}}) {  // one rotation
    recorded_path other = leader;
    change(other);
    const free_run_difference d = compare_paths(leader, other, 1e-9, 2);
    CHECK_FALSE(d.within_bound());
    CHECK(d.same_events == same_events);
    CHECK_THAT(d.first_difference, Contains(words));
    CHECK((d.displacement > 1e-4) == far);
  }
}

TEST_CASE("in a free run, differences in an unloaded step are relative to the largest D of the whole path") {
  beam_problem p = cantilever_over_a_stop();
  p.steps = {tip_load(2, -60), tip_load(2, 0)};
  const recorded_path r8 = free_run(p, "fortran"), r4 = free_run(p, "fortran-r4");
  REQUIRE(r8.record.steps.size() == 2);
  const double rest = r8.record.steps[1].displacement[4];
  const double left = std::abs(rest - r4.record.steps[1].displacement[4]);
  REQUIRE(left > 1e-4 * std::abs(rest));  // D of the unloaded step is only rounding
  const free_run_difference d = compare_paths(r8, r4, 1e-4, 2);
  CHECK(d.within_bound());
  CHECK(d.displacement < 1e-6);
}
