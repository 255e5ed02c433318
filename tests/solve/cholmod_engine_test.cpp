// A stiffness kept by its entries alone: the same paths, the same ends, the same certificate. Only where
// CHOLMOD is built in.
#include "catch.hpp"
#include "contct/outside/registry.hpp"
#include "contct/solve/spring_engine.hpp"
#include "support/beam_over_stops.hpp"
#include "support/tried_problem.hpp"

using namespace contct::app;

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
  path_counts counted;
  for (std::uint64_t number = 1; number <= 150; ++number) {
    const random_problem p = make_random_problem(404, number, free_or_held(0.0));
    const linear_structure s = without_band(p);
    for (const char* engine : {"refactor", "cholmod", "dissected"}) {
      INFO(engine << ", problem " << number);
      CHECK(try_structure(p, s, *kernel, engine, {&counted}).came_to == verdict::certified);
    }
  }
  CHECK(counted.makes + counted.breaks >= 1500);
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
  CHECK_THROWS_WITH(make_engine("condensed", s), Catch::Matchers::Contains("allowed: a beam with pairs"));
}

TEST_CASE("toggles update the factor of CHOLMOD, and the response is that of a new one") {
  linear_structure band = cantilever_over_stops(12);
  linear_structure sparse = band;
  sparse.stiffness = columns_of(band.stiffness.band());
  for (const linear_structure* s : {&band, &sparse}) {
    const auto engine = make_engine("cholmod", *s);
    std::vector<double> load(s->dofs());
    load[24] = -10.0;
    std::vector<double> d_star(s->pairs.size());
    std::vector<char> closed(s->pairs.size());
    engine->respond({load, 1.0, 1}, d_star);
    for (const int pair : {11, 4, 0, 7}) {
      closed[pair] = 1;
      engine->switch_spring(pair, true);
      engine->respond({load, 0.25, 1}, d_star);
      std::vector<double> expected = response_by_factor(*s, closed, load);
      for (double& d : expected) d *= 0.25;
      CHECK(relative_difference(expected, d_star) <= 1e-10);
    }
    CHECK(engine->counts().updates == 4);
    CHECK(engine->counts().factors == 1);
    CHECK(engine->counts().checks == 1);      // of the new factor
    CHECK(engine->counts().solves == 5 + 1);  // a response each, and a correction
    std::vector<double> u(s->dofs());
    engine->recover(load, std::vector<double>(s->pairs.size()), u);
    CHECK(engine->counts().factors == 2);  // one without updates
    std::vector<double> at_pairs(s->pairs.size());
    gather_at_pairs(*s, u, at_pairs);
    CHECK(relative_difference(response_by_factor(*s, closed, load), at_pairs) <= 1e-12);
  }
}

TEST_CASE("a spring that is stiffer than the structure is checked for as soon as it opens") {
  linear_structure s = cantilever_over_stops(6);
  s.pairs[5].stiffness = 1e9;
  const auto engine = make_engine("cholmod", s);
  std::vector<double> load(s.dofs(), 1.0);
  std::vector<double> d_star(s.pairs.size());
  engine->respond({load, 1.0, 1}, d_star);
  engine->switch_spring(5, true);
  engine->respond({load, 1.0, 1}, d_star);
  CHECK(engine->counts().checks == 1);
  engine->switch_spring(5, false);
  engine->respond({load, 1.0, 1}, d_star);
  CHECK(engine->counts().checks == 2);
  CHECK(relative_difference(response_by_factor(s, std::vector<char>(6), load), d_star) <= 1e-10);
}
