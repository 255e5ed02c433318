#include "catch.hpp"
#include "contct/solve/spring_engine.hpp"
#include "support/beam_over_stops.hpp"

using namespace contct;

TEST_CASE("when a pair toggles, the updated engine gives the response of a new factor without a new factor") {
  const linear_structure s = cantilever_over_stops(12);
  const auto engine = make_engine("updated", s);
  std::vector<double> load(s.dofs());
  load[24] = -10.0;
  load[9] = 3.0;
  std::vector<double> d_star(s.pairs.size());
  engine->respond({load, 1.0, 1}, d_star);
  std::vector<char> closed(s.pairs.size());
  for (const int pair : {11, 4, 0, 11, 7}) {
    closed[pair] = closed[pair] == 0 ? 1 : 0;
    engine->switch_spring(pair, closed[pair] != 0);
    engine->respond({load, 1.0, 1}, d_star);
    CHECK(relative_difference(response_by_factor(s, closed, load), d_star) <= 1e-10);
  }
  CHECK(engine->counts().updates == 5);
  CHECK(engine->counts().factors == 1);
  CHECK(engine->counts().solves == 1 + 5);  // the load, and a column for each toggle
}

TEST_CASE("the updated engine checks the drift after 16 responses, and then after 32 more") {
  const linear_structure s = cantilever_over_stops(6);
  const auto engine = make_engine("updated", s);
  std::vector<double> load(s.dofs(), 1.0);
  std::vector<double> d_star(s.pairs.size());
  engine->switch_spring(2, true);
  engine->respond({load, 1.0, 1}, d_star);
  engine->switch_spring(1, true);  // a first update, which needs a check
  const auto respond = [&](int times) {
    for (int i = 0; i < times; ++i) engine->respond({load, 1.0, 1}, d_star);
    return engine->counts().checks;
  };
  CHECK(respond(15) == 0);
  CHECK(respond(1) == 1);
  CHECK(respond(31) == 1);
  CHECK(respond(1) == 2);
}

TEST_CASE(
    "the updated engine takes a new factor after it removes a much stiffer spring, because digits cancel") {
  linear_structure s = cantilever_over_stops(6);
  s.pairs[5].stiffness = 1e9;
  const auto engine = make_engine("updated", s);
  std::vector<double> load(s.dofs(), 1.0);
  std::vector<double> d_star(s.pairs.size());
  engine->respond({load, 1.0, 1}, d_star);
  engine->switch_spring(5, true);
  engine->respond({load, 1.0, 1}, d_star);
  CHECK(engine->counts().factors == 1);
  engine->switch_spring(5, false);
  engine->respond({load, 1.0, 1}, d_star);
  CHECK(engine->counts().factors == 2);
  CHECK(engine->counts().updates == 1);
  CHECK(relative_difference(response_by_factor(s, std::vector<char>(6), load), d_star) <= 1e-12);
}
