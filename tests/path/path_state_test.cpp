#include "contct/path/path_state.hpp"

#include <limits>
#include <vector>

#include "catch.hpp"
#include "contct/solve/engine.hpp"
#include "support/beams.hpp"
#include "support/made_kernel.hpp"

using namespace contct;

TEST_CASE(
    "the cycle detector finds a cycle of statuses of any length, whatever statuses come before the cycle") {
  for (int lead : {0, 1, 5, 17}) {
    for (int loop : {1, 2, 3, 7, 20}) {
      cycle_detector watch;
      int increments = 0;
      bool found = false;
      while (!found && increments < 1000) {
        const int state = increments < lead ? 1000 + increments : (increments - lead) % loop;
        found = watch.repeats(false, std::vector<int>{state}, {});
        ++increments;
      }
      INFO("lead " << lead << ", loop " << loop);
      CHECK(found);
      CHECK(increments <= 4 * (lead + loop) + 4);
    }
  }
}

TEST_CASE("the cycle detector reports no cycle if statuses recur after a movement") {
  cycle_detector watch;
  for (int i = 0; i < 100; ++i) CHECK_FALSE(watch.repeats(true, std::vector<int>{1}, {}));
  CHECK_FALSE(watch.repeats(false, std::vector<int>{1}, {}));
  CHECK(watch.repeats(false, std::vector<int>{1}, {}));
}

TEST_CASE("the pairs of a cycle are those that toggled twice within 200 increments") {
  cycle_detector watch;
  const std::vector<int> status = {1, 1, 1};
  const std::vector<event> both = {{0, change::make}, {1, change::make}};
  const std::vector<event> first = {{0, change::break_}};
  watch.repeats(true, status, both);
  watch.repeats(true, status, first);
  CHECK(watch.restless_pairs() == std::vector<int>{0});
  for (int i = 0; i < 200; ++i) watch.repeats(true, status, {});
  CHECK(watch.restless_pairs().empty());
  watch.repeats(true, status, first);
  watch.repeats(true, status, first);
  watch.reset();
  CHECK(watch.restless_pairs().empty());
}

TEST_CASE("if the response of any pair is infinite or NaN, the kernel is not called") {
  beam_problem p{even_beam(9.0, 9, 1e4), {{0, 0, true}, {0, 1, true}}, {}, {}};
  for (int node = 1; node <= 9; ++node) p.pairs.push_back({node, face_below, -1.0, 1.0, false});
  const linear_structure s = p.structure();
  const auto engine = make_engine("refactor", s);
  for (const double bad : {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    for (std::size_t pair = 0; pair < 9; ++pair) {
      path_state now(s, *engine, {}, false);
      int calls = 0;
      made_kernel k([&calls](call<double>& c) {
        ++calls;
        c.smin = 1.0;
      });
      CHECK(now.ask(k, now.d_star) == 1.0);
      now.d_star[pair] = bad;
      CAPTURE(bad, pair);
      CHECK_THROWS_AS(now.ask(k, now.d_star), no_factor);
      CHECK(calls == 1);
    }
  }
}
