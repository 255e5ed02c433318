// A stiffness kept by its entries alone: the same paths, the same ends, the same certificate. Only where
// CHOLMOD is built in.
#include "catch.hpp"
#include "contct/lab/problem_result.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/outside/registry.hpp"
#include "contct/solve/engine.hpp"

using namespace contct;

namespace {

linear_structure without_band(const random_problem& p) {
  linear_structure s = build(p.geometry, p.supports, p.pairs);
  s.stiffness = columns_of(s.stiffness.band());
  return s;
}

random_problem_kind free_or_held(double free_share) {
  random_problem_kind kind;
  kind.free_share = free_share;
  kind.plate_share = 0.3;
  kind.least_unit = 1e-3;
  kind.most_unit = 1e3;
  return kind;
}

}  // namespace

TEST_CASE("without a band the corrected paths are certified, factored anew or updated") {
  const auto kernel = make_kernel("corrected");
  int events = 0;
  for (std::uint64_t number = 1; number <= 150; ++number) {
    const random_problem p = make_random_problem(404, number, free_or_held(0.0));
    const linear_structure s = without_band(p);
    for (const char* engine : {"refactor", "cholmod", "dissected"}) {
      INFO(engine << ", problem " << number);
      const problem_result t = try_structure(p, s, *kernel, engine);
      CHECK(t.came_to == verdict::certified);
      events += t.makes + t.breaks;
    }
  }
  CHECK(events >= 1500);
}

TEST_CASE("without a band, structures that pairs alone hold come to the same end") {
  const auto kernel = make_kernel("corrected");
  int held = 0;
  int not_held = 0;
  for (std::uint64_t number = 1; number <= 150; ++number) {
    const random_problem p = make_random_problem(405, number, free_or_held(1.0));
    const verdict by_band = try_problem(p, *kernel).came_to;
    const linear_structure s = without_band(p);
    for (const char* engine : {"refactor", "cholmod", "dissected"}) {
      INFO(engine << ", problem " << number);
      CHECK(try_structure(p, s, *kernel, engine).came_to == by_band);
      ++(by_band == verdict::certified ? held : not_held);
    }
  }
  CHECK(held >= 150);
  CHECK(not_held >= 60);
}

TEST_CASE("without a band, engines that need one say what can be had instead") {
  const linear_structure s = without_band(make_random_problem(404, 1, free_or_held(0.0)));
  CHECK(quickest_engine(s) == "cholmod");
  CHECK_THROWS_WITH(make_engine("updated", s),
                    "engine \"updated\": found a stiffness that is not stored as a band; allowed: refactor, "
                    "cholmod or dissected");
  CHECK_THROWS_WITH(make_engine("condensed", s), Catch::Matchers::Contains("no beam with pairs"));
}
