#include <stdexcept>

#include "catch.hpp"
#include "contct/model/problem.hpp"
#include "contct/solve/spring_engine.hpp"
#include "support/beam_over_stops.hpp"

using namespace contct;

TEST_CASE("beams with pairs can be condensed to the pairs, but plates and beams without pairs cannot") {
  CHECK(can_be_condensed(cantilever_over_stops(3)));
  linear_structure bare = cantilever_over_stops(3);
  bare.pairs.clear();
  CHECK_FALSE(can_be_condensed(bare));
  const plate square{{0, 1}, {0, 1}, 1.0, 0.3};
  const linear_structure p = build(square, {}, {{0, -1, 0.0, 1.0, true}});
  CHECK_FALSE(can_be_condensed(p));
  CHECK_THROWS_AS(make_engine("condensed", p), std::invalid_argument);
}

TEST_CASE(
    "the condensed engine gives the same response as a full factorisation, whichever nodes have pairs") {
  const linear_structure all = cantilever_over_stops(12);
  for (const std::vector<int>& kept :
       std::vector<std::vector<int>>{{0, 5, 11}, {3}, {10, 11}, {0, 1, 2, 8}}) {
    linear_structure s = all;
    s.pairs.clear();
    for (const int i : kept) s.pairs.push_back(all.pairs[i]);
    const auto engine = make_engine("condensed", s);
    std::vector<double> load(s.dofs());
    load[24] = -10.0;
    load[7] = 4.0;
    std::vector<double> d_star(s.pairs.size());
    std::vector<char> closed(s.pairs.size());
    engine->respond({load, 1.0, 1}, d_star);
    CHECK(relative_difference(response_by_factor(s, closed, load), d_star) <= 1e-12);
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = 0; i < kept.size(); ++i) {
        closed[i] = round == 0 ? 1 : 0;
        engine->switch_spring(static_cast<int>(i), closed[i] != 0);
        engine->respond({load, 0.5, 1}, d_star);
        std::vector<double> expected = response_by_factor(s, closed, load);
        for (double& d : expected) d *= 0.5;
        CHECK(relative_difference(expected, d_star) <= 1e-10);
      }
    }
    CHECK(engine->counts().factors == 1);
    CHECK(engine->counts().updates == static_cast<std::int64_t>(2 * kept.size()));
  }
}

TEST_CASE("a pair at a fixed dof has the response 0 in the condensed engine") {
  linear_structure s = cantilever_over_stops(4);
  s.pairs.push_back({0, -1, 0.0, 1e6, false});
  const auto engine = make_engine("condensed", s);
  std::vector<double> load(s.dofs(), 1.0);
  std::vector<double> before(5);
  std::vector<double> after(5);
  engine->respond({load, 1.0, 1}, before);
  engine->switch_spring(4, true);
  engine->respond({load, 1.0, 1}, after);
  CHECK(after == before);
  CHECK(after[4] == 0.0);
}

TEST_CASE(
    "the condensed engine adds the springs of all pairs in contact before the first response of a free "
    "beam") {
  const linear_structure s =
      build(beam{{0, 1, 2}, {605, 605}}, {}, {{0, -1, -1e-4, 300.0, false}, {2, -1, -5e-5, 250.0, false}});
  const auto engine = make_engine("condensed", s);
  engine->switch_spring(0, true);
  engine->switch_spring(1, true);
  const std::vector<double> load = {0, 0, -2.0, 0, 0, 0};
  std::vector<double> d_star(2);
  engine->respond({load, 1.0, 1}, d_star);
  CHECK(d_star[0] == Approx(-1.0 / 300).epsilon(1e-12));
  CHECK(d_star[1] == Approx(-1.0 / 250).epsilon(1e-12));
}

TEST_CASE(
    "after a spring 1e18 times as stiff as the others is removed, the condensed engine gives the response "
    "before it") {
  linear_structure s = cantilever_over_stops(6);
  s.pairs[2].stiffness = 1e18 * s.pairs[2].stiffness;
  const auto engine = make_engine("condensed", s);
  std::vector<double> load(s.dofs());
  load[12] = -10.0;
  std::vector<double> before(6);
  std::vector<double> after(6);
  engine->respond({load, 1.0, 1}, before);
  for (const bool closed : {true, false}) {
    engine->switch_spring(2, closed);
    engine->respond({load, 1.0, 1}, after);
    CHECK((relative_difference(before, after) <= 1e-12) != closed);
  }
  const engine_counts counts = engine->counts();
  CHECK(counts.checks >= 1);
  CHECK(counts.solves == counts.factors + counts.checks);  // one for each factor, and one for each check
}

TEST_CASE("if a beam is too ill-conditioned, the condensed engine is made but fails at the first response") {
  // A mechanism with elements of length 1 and 1e7, whose path needs no response.
  beam b;
  b.x = {-1, 0, 1, 2, 3, 4, 10000004, 20000004, 30000004};
  b.EI.assign(8, 1e7);
  const support turning{7, 1, false, 1e7, false};
  const linear_structure s = build(b, std::vector{turning}, {{7, 1, 1e7, 1e7, false}});
  const auto engine = make_engine("condensed", s);
  const std::vector<double> load(s.dofs(), 1.0);
  std::vector<double> d_star(1);
  CHECK_THROWS_AS(engine->respond({load, 1.0, 1}, d_star), no_factor);
  CHECK_THROWS_AS(engine->respond({load, 1.0, 1}, d_star), no_factor);
}
