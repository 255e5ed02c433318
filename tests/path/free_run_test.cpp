#include "contct/path/free_run.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

path_record free_run(const beam_problem& p, const char* kernel) {
  path_record r;
  r.end = p.run(kernel, {&r});
  return r;
}

}  // namespace

TEST_CASE("in a free run, the paths of FORTRAN and C++ end with the same bits") {
  const path_record fortran = free_run(cantilever_over_a_stop(), "fortran");
  const path_record cpp = free_run(cantilever_over_a_stop(), "cpp");
  const free_run_difference d = compare_paths(fortran, cpp, 1e-9, 2);
  CHECK(d.within_bound());
  CHECK(d.fraction == 0.0);
  CHECK(d.displacement == 0.0);
  CHECK(fortran.events.size() == 2);
  CHECK(fortran.displacement.size() == 4);
}

TEST_CASE(
    "in a free run, single precision is within a bound of 1e-4, but not within the 1e-9 of double "
    "precision") {
  const path_record r8 = free_run(cantilever_over_a_stop(), "fortran");
  const path_record r4 = free_run(cantilever_over_a_stop(), "fortran-r4");
  const double bound = free_run_bound(make_kernel("cpp")->facts(), make_kernel("cpp-r4")->facts());
  CHECK(bound == 1e-4);
  CHECK(compare_paths(r8, r4, bound, 2).within_bound());
  CHECK_FALSE(compare_paths(r8, r4, 1e-9, 2).within_bound());
}

TEST_CASE("a free run reports a different event, a missing event, a different end and a wrong rotation") {
  const path_record leader = free_run(cantilever_over_a_stop(), "fortran");
  path_record other = leader;
  other.events[1].what.what = change::make;
  free_run_difference d = compare_paths(leader, other, 1e-9, 2);
  CHECK_FALSE(d.same_events);
  CHECK(d.first_difference ==
        "the leader: step 4, pair 1 breaks contact; this kernel: step 4, pair 1 makes contact");
  other = leader;
  other.events.pop_back();
  d = compare_paths(leader, other, 1e-9, 2);
  CHECK_FALSE(d.within_bound());
  CHECK(d.first_difference.find("no further event") != std::string::npos);
  other = leader;
  other.end.status = path_status::mechanism;
  CHECK_FALSE(compare_paths(leader, other, 1e-9, 2).within_bound());
  other = leader;
  other.displacement[2][5] *= 1.001;  // one rotation
  d = compare_paths(leader, other, 1e-9, 2);
  CHECK(d.displacement > 1e-4);
  CHECK_FALSE(d.within_bound());
}

TEST_CASE("in a free run, differences in an unloaded step are relative to the largest D of the whole path") {
  beam_problem p = cantilever_over_a_stop();
  p.steps = {tip_load(2, -60), tip_load(2, 0)};
  const path_record r8 = free_run(p, "fortran");
  const path_record r4 = free_run(p, "fortran-r4");
  REQUIRE(r8.displacement.size() == 2);
  const double left = std::abs(r8.displacement[1][4] - r4.displacement[1][4]);
  REQUIRE(left > 1e-4 * std::abs(r8.displacement[1][4]));  // D of the unloaded step is only rounding
  const free_run_difference d = compare_paths(r8, r4, 1e-4, 2);
  CHECK(d.within_bound());
  CHECK(d.displacement < 1e-6);
}
