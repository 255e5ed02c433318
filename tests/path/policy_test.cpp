// What the driver does for a leader whose rule is not the listing's.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "catch.hpp"
#include "contct/kernel/corrected.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/solve/spring_engine.hpp"
#include "support/beams.hpp"
#include "support/made_kernel.hpp"

using namespace contct::app;

namespace {

/// A free beam above stops at its ends, 0.1 and 0.3 below it.
beam_problem beam_above_stops() {
  return {even_beam(4.0, 4, 1e3),
          {},
          {{0, face_below, -0.1, 50.0, false}, {4, face_below, -0.3, 50.0, false}},
          {tip_load(3, -8.0)}};
}

std::vector<bool> snaps_of(const recorder& r) {
  std::vector<bool> snaps;
  for (const auto& i : r.increments) snaps.push_back(i.snaps);
  return snaps;
}

/// An equilibrium for beam_above_stops, so wrong that nobody else would find it.
equilibrium_state made_up_rest() {
  return {std::vector<double>(10, -7.0), {1, 1}};
}

}  // namespace

TEST_CASE("a free beam dropped onto stops moves rigidly at constant load until it lies on them") {
  const beam_problem p = beam_above_stops();
  recorder r;
  const path_end end = p.run("corrected", {&r});
  CHECK(end.status == path_status::solved);
  REQUIRE(r.increments.size() == 3);
  CHECK(snaps_of(r) == std::vector<bool>{true, true, false});
  CHECK(r.increments[0].fraction == 0.0);
  CHECK(r.increments[1].fraction == 0.0);
  CHECK(r.increments[2].fraction == 1.0);
  // The load is nearer to the second stop, and sinks there faster: up by u and turned by t it moves both
  // ends by u - t and u + t in the ratio of the work on u and t, 8 and 4, that is by 1/2 and 3/2 of u.
  CHECK(r.events() == std::vector<event>{{1, change::make}, {0, change::make}});
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].u[0] == Approx(-0.1 - 2.0 / 50).epsilon(1e-12));
  CHECK(r.steps[0].u[8] == Approx(-0.3 - 6.0 / 50).epsilon(1e-12));
  CHECK_FALSE(r.steps[0].from_fallback);
}

TEST_CASE("a beam thrown from the stops below it to the stops above it, and back") {
  beam_problem p = beam_above_stops();
  p.pairs.push_back({0, face_above, 0.2, 50.0, false});
  p.pairs.push_back({4, face_above, 0.2, 50.0, false});
  p.steps = {tip_load(3, -8.0), tip_load(1, 8.0), tip_load(3, -8.0)};
  recorder r;
  CHECK(p.run("corrected", {&r}).status == path_status::solved);
  REQUIRE(r.steps.size() == 3);
  CHECK(r.steps[1].u[0] == Approx(0.2 + 6.0 / 50).epsilon(1e-12));
  CHECK(r.steps[1].u[8] == Approx(0.2 + 2.0 / 50).epsilon(1e-12));
  CHECK(r.steps[1].isep == std::vector<int>{separated, separated, in_contact, in_contact});
  CHECK(r.steps[2].u[0] == Approx(-0.1 - 2.0 / 50).epsilon(1e-12));
  CHECK(r.steps[2].u[8] == Approx(-0.3 - 6.0 / 50).epsilon(1e-12));
  // Where it lets go of one side, in each of the steps, no load passes until it lies on the other.
  for (std::size_t i = 1; i < r.increments.size(); ++i) {
    if (r.increments[i].snaps && r.increments[i].number > 1)
      CHECK(r.increments[i].fraction == r.increments[i - 1].fraction);
  }
  const std::vector<bool> snaps = snaps_of(r);
  CHECK(std::count(snaps.begin(), snaps.end(), true) >= 4);
}

TEST_CASE("a beam balanced on one pair stands, and bends over it") {
  // Both halves are cantilevers under 2 a length: q l^4 / 8 EI at their tips.
  beam_problem p{
      even_beam(4.0, 4, 1e3), {}, {{2, face_below, -0.1, 50.0, false}, {0, face_below, -9, 1e3, false}}, {}};
  p.steps = {{{}, {{{-2.0}, {}}}}};
  recorder r;
  CHECK(p.run("corrected", {&r}).status == path_status::solved);
  REQUIRE(r.steps.size() == 1);
  const double middle = -0.1 - 8.0 / 50;
  const double droop = 2.0 * 16 / 8 / 1e3;
  CHECK(r.steps[0].u[4] == Approx(middle).epsilon(1e-12));
  CHECK((r.steps[0].u[0] + r.steps[0].u[8]) / 2 == Approx(middle - droop).epsilon(1e-12));
  CHECK(r.steps[0].isep == std::vector<int>{in_contact, separated});
  CHECK(r.steps[0].rcond > 0.0);  // with the spring that it leans on
}

TEST_CASE("a pair that comes into contact at the end of a step, by rounding alone, has its spring there") {
  // The beam may turn about its pin, and the loads do not turn it. The pair at its face holds it for a solve;
  // for 10 of these loads it then is beyond its face by rounding.
  for (int i = 1; i <= 100; ++i) {
    const double w = i / 64.0;
    const beam_problem p{even_beam(1.4, 2, 1e-3),
                         {{0, 0, true}},
                         {{2, face_above, 0.0, 1e3, false}},
                         {{{{1, 0, -2 * w}, {2, 0, w}}, {}}}};
    recorder r;
    CHECK(p.run("corrected", {&r}).status == path_status::solved);
    REQUIRE(r.steps.size() == 1);
    CAPTURE(w, r.steps[0].isep);
    CHECK(r.steps[0].rcond > 1e-9);
  }
}

TEST_CASE("a beam balanced on its one pair ends early without other means, and is no mechanism") {
  beam_problem p{even_beam(4.0, 4, 1e3), {}, {{2, face_below, 0.0, 50.0, true}}, {}};
  p.steps = {{{}, {{{-2.0}, {}}}}};
  const path_end end = p.run("corrected", {});
  CHECK(end.status == path_status::path_ended);
  CHECK(end.has_equilibrium == true);
}

TEST_CASE("a beam that falls on one pair and turns for ever ends where it met that pair, without a force") {
  beam_problem p{even_beam(2.0, 2, 1e3), {}, {{1, face_below, -0.5, 1e4, false}}, {}};
  p.steps = {tip_load(2, -1.0)};
  recorder r;
  const path_end end = p.run("corrected", {&r});
  CHECK(end.status == path_status::mechanism);
  CHECK(end.has_equilibrium == false);
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].isep == std::vector<int>{in_contact});
  CHECK(r.steps[0].u[2] == -0.5);
  CHECK(r.steps[0].u[0] == Approx(0.0).margin(1e-15));
  CHECK(r.steps[0].u[4] == Approx(-1.0).epsilon(1e-15));
}

TEST_CASE("the exact path goes on from the path's own events, also where those were at the same share") {
  beam_problem p{even_beam(2.0, 2, 1e3), {}, {{1, face_below, -0.5, 1e4, false}}, {}};
  p.steps = {tip_load(1, -1.0)};
  path_limits limits;
  limits.exactly = [](int) -> std::optional<followed_step> {
    return followed_step{
        path_status::solved,
        {{0.0, {}, false, {0.0}}, {0.0, {{0, change::make}}, true, {-0.5}}, {1.0, {}, false, {-0.5001}}},
        1.0,
        {-0.5001, 0, -0.5001, 0, -0.5001, 0},
        {1}};
  };
  recorder r;
  CHECK(p.run("corrected", {&r}, limits).status == path_status::solved);
  REQUIRE(r.increments.size() == 2);
  REQUIRE(r.increments[0].events.size() == 1);
  CHECK(r.increments[0].events[0].what == change::make);
  CHECK(r.increments[1].events.empty());
}

TEST_CASE("lifted off its stops for good, the state reached is told, with the load that it carried") {
  beam_problem p = beam_above_stops();
  p.steps = {tip_load(2, -8.0), tip_load(2, 8.0)};
  recorder r;
  const path_end end = p.run("corrected", {&r});
  CHECK(end.status == path_status::mechanism);
  CHECK(end.step == 2);
  CHECK(end.fraction == Approx(0.5).epsilon(1e-12));
  CHECK_FALSE(end.pairs.empty());
  REQUIRE(r.steps.size() == 2);
  CHECK(r.steps[1].fraction == end.fraction);
  CHECK(r.steps[1].u[0] == Approx(-0.1).epsilon(1e-12));
  CHECK(r.steps[1].u[8] == Approx(-0.3).epsilon(1e-12));
}

TEST_CASE("a balanced beam lifted off its one pair ends where it was then, not where it began") {
  beam_problem p{
      even_beam(4.0, 4, 1e3), {}, {{2, face_below, -0.1, 50.0, false}, {0, face_below, -9, 1e3, false}}, {}};
  p.steps = {{{}, {{{-2.0}, {}}}}, {{}, {{{2.0}, {}}}}};
  recorder r;
  const path_end end = p.run("corrected", {&r});
  CHECK(end.status == path_status::mechanism);
  CHECK(end.step == 2);
  CHECK(end.fraction == Approx(0.5).epsilon(1e-10));
  REQUIRE(r.steps.size() == 2);
  CHECK(r.steps[1].fraction == end.fraction);
  CHECK(r.steps[1].u[4] == Approx(-0.1).epsilon(1e-10));
}

TEST_CASE("driven away from the start, a beam that nothing holds has not moved") {
  beam_problem p = beam_above_stops();
  p.steps = {tip_load(2, 8.0)};
  recorder r;
  const path_end end = p.run("corrected", {&r});
  CHECK(end.status == path_status::mechanism);
  CHECK(end.fraction == 0.0);
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].u == std::vector<double>(10, 0.0));
}

TEST_CASE("the listing's rule gets none of this: the path of a beam above its stops ends at the start") {
  for (const char* name : {"fortran", "cpp"}) {
    bool asked = false;
    const path_limits limits{0,
                             [&](int, double, std::span<const double>) -> std::optional<equilibrium_state> {
                               asked = true;
                               return made_up_rest();
                             }};
    recorder r;
    const path_end end = beam_above_stops().run(name, {&r}, limits);
    CHECK(end.status == path_status::path_ended);
    CHECK(end.fraction == 0.0);
    CHECK(r.increments.empty());
    CHECK_FALSE(asked);
    REQUIRE(r.steps.size() == 1);
    CHECK_FALSE(r.steps[0].from_fallback);
  }
}

namespace {

/// Toggles pair 0 at a standstill for as long as it responds, and else follows the corrected rule.
/// Remembers the calls in which it did not respond.
struct restless_first_pair {
  int toggles = 0;
  int quiet = 0;
  void operator()(call<double>& c) {
    const auto dof = static_cast<std::size_t>(c.dof.dof_of(c.id[0]) - 1);
    if (c.dtest[dof] == 0.0) {
      ++quiet;
      contct_corrected(c);
      return;
    }
    ++toggles;
    c.smin = 0.0;
    c.isep[0] = -c.isep[0];
  }
};

/// A cantilever with a pair in its middle, pressed all the time, and a stop at its tip.
beam_problem cantilever_on_two() {
  return {even_beam(2.0, 2, 1e4),
          {{0, 0, true}, {0, 1, true}},
          {{1, face_below, 0.0, 5e4, true}, {2, face_below, -1e-4, 5e4, false}},
          {tip_load(2, -10), tip_load(2, -60)}};
}

}  // namespace

TEST_CASE(
    "a pair that toggles twice running at a standstill is kept closed, and not asked until load passes") {
  restless_first_pair restless;
  made_kernel k([&restless](call<double>& c) { restless(c); });
  const beam_problem p = cantilever_on_two();
  recorder r;
  const path_end end = p.run(k, {&r});
  CHECK(end.status == path_status::solved);
  recorder sound;
  REQUIRE(p.run("corrected", {&sound}).status == path_status::solved);
  // Two toggles and quiet until the tip has met its stop; in the second step the same again.
  CHECK(restless.toggles >= 4);
  CHECK(restless.quiet >= 3);
  REQUIRE(r.steps.size() == 2);
  for (std::size_t step = 0; step < 2; ++step) {
    CHECK(r.steps[step].isep == sound.steps[step].isep);
    for (std::size_t dof = 0; dof < 6; ++dof)
      CHECK(r.steps[step].u[dof] == Approx(sound.steps[step].u[dof]).epsilon(1e-12).margin(1e-18));
  }
}

TEST_CASE("the same pair goes round in circles under the listing's rule") {
  restless_first_pair restless;
  made_kernel k([&restless](call<double>& c) { restless(c); }, contact_rule::listing);
  const path_end end = cantilever_on_two().run(k, {});
  CHECK(end.status == path_status::cycle);
  CHECK(end.pairs == std::vector<int>{0});
  CHECK(restless.quiet == 0);
}

namespace {

/// The corrected rule with a hasty hand: events come a thousandth too early.
void hasty(call<double>& c) {
  contct_corrected(c);
  if (c.smin > 0.0 && c.smin < 1.0) c.smin *= 0.999;
}

}  // namespace

TEST_CASE("at a step's end D is where the springs' law has it, whatever the way there") {
  const beam_problem p = cantilever_over_a_stop();
  made_kernel k(hasty);
  recorder r;
  CHECK(p.run(k, {&r}).status == path_status::solved);
  REQUIRE(r.steps.size() == 4);
  const double f = 8.0 / 3 / 1e4;
  CHECK(r.steps[1].u[4] == Approx(-0.004 - (60 * f - 0.004) / (f + 1 / 5e4) / 5e4).epsilon(1e-12));
  CHECK(r.steps[2].u[4] == Approx(-0.004 - (30 * f - 0.004) / (f + 1 / 5e4) / 5e4).epsilon(1e-12));
  CHECK(r.steps[3].u[4] == Approx(20 * f).epsilon(1e-12));
}

TEST_CASE("under the listing's rule an early toggle stays in the sum, as it did in 1989") {
  const beam_problem p = cantilever_over_a_stop();
  made_kernel k(hasty, contact_rule::listing);
  recorder r;
  CHECK(p.run(k, {&r}).status == path_status::solved);
  REQUIRE(r.steps.size() == 4);
  const double f = 8.0 / 3 / 1e4;
  const double right = -0.004 - (60 * f - 0.004) / (f + 1 / 5e4) / 5e4;
  CHECK(r.steps[1].u[4] != Approx(right).epsilon(1e-6));
  CHECK(r.steps[1].u[4] == Approx(right).epsilon(1e-3));
}

TEST_CASE("at full load the kernel is asked once more where a pair is on the wrong side of its face") {
  // This one never lets go of its first pair on the way.
  made_kernel k([](call<double>& c) {
    const auto dof = static_cast<std::size_t>(c.dof.dof_of(c.id[0]) - 1);
    const bool pulled = c.isep[0] == in_contact && c.dtest[dof] > 0.0 && c.dd[dof] < c.cc[0];
    if (pulled) {
      c.smin = 1.0;
      return;
    }
    contct_corrected(c);
  });
  const beam_problem p = cantilever_over_a_stop();
  recorder r;
  CHECK(p.run(k, {&r}).status == path_status::solved);
  REQUIRE(r.steps.size() == 4);
  CHECK(r.steps[3].isep == std::vector<int>{separated});
  CHECK(r.steps[3].u[4] == Approx(20 * 8.0 / 3 / 1e4).epsilon(1e-12));
  CHECK(r.increments.back().fraction == 1.0);
}

namespace {

/// Toggles both pairs in turn at a standstill, for ever.
made_kernel endless(contact_rule rule = contact_rule::corrected) {
  return made_kernel(
      [calls = 0](call<double>& c) mutable {
        c.smin = 0.0;
        const std::size_t i = calls++ % 2 == 0 ? 0 : 1;
        c.isep[i] = -c.isep[i];
      },
      std::move(rule));
}

}  // namespace

TEST_CASE("a path that cannot go on is rescued by an equilibrium from elsewhere, which is told") {
  made_kernel k = endless();
  const beam_problem p = cantilever_on_two();
  std::vector<double> asked_for;
  equilibrium_state rest{{0, 0, -1, -2, -3, -4}, {1, 0}};
  const path_limits limits{
      0, [&](int, double, std::span<const double> load) -> std::optional<equilibrium_state> {
        asked_for.assign(load.begin(), load.end());
        return rest;
      }};
  recorder r;
  const path_end end = p.run(k, {&r}, limits);
  CHECK(end.status == path_status::solved);
  CHECK(asked_for == std::vector<double>{0, 0, 0, 0, -60, 0});
  REQUIRE(r.steps.size() == 2);
  for (const auto& step : r.steps) {
    CHECK(step.from_fallback);
    CHECK(step.fraction == 1.0);
    CHECK(step.u == rest.displacement);
    CHECK(step.isep == std::vector<int>{in_contact, separated});
  }
}

TEST_CASE("a path that cannot go on is followed by other means from the share that it has reached") {
  // The endless kernel toggles both pairs at share 0; exactly, only pair 1 is in contact there.
  made_kernel k = endless();
  beam_problem p = cantilever_on_two();
  int asked = 0;
  path_limits limits;
  limits.exactly = [&](int step) -> std::optional<followed_step> {
    ++asked;
    followed_step s{path_status::solved, {}, 1.0, {0, 0, -1, -2, -3, -4}, {1, 1}};
    if (step == 1)
      s.increments = {{0.25, {{1, change::make}}, false, {-0.5, -1.5}},
                      {0.5, {{0, change::break_}}, true, {-0.75, -2.0}},
                      {0.5, {{0, change::make}}, false, {-0.75, -2.0}}};
    s.increments.push_back({1.0, {}, false, {-1, -3}});
    return s;
  };
  recorder r;
  CHECK(p.run(k, {&r}, limits).status == path_status::solved);
  CHECK(asked == 2);
  REQUIRE(r.steps.size() == 2);
  CHECK_FALSE(r.steps[0].from_fallback);
  CHECK(r.steps[0].isep == std::vector<int>{in_contact, in_contact});
  std::vector<recorder::seen_increment> told;
  for (const auto& i : r.increments)
    if (i.step == 1 && i.fraction > 0.0) told.push_back(i);
  REQUIRE(told.size() == 4);
  CHECK(told[0].s == 0.25);
  CHECK(told[1].snaps);
  CHECK(told[1].s == 0.0);  // a rigid-body motion at constant load
  CHECK(told[1].events == std::vector<event>{{0, change::break_}});
  CHECK(told[3].fraction == 1.0);
  CHECK(told[3].s == 1.0);
  CHECK(told[3].number == told[0].number + 3);
  // Every status is told as it changes: the events lead from the first to the last ones.
  std::vector<int> isep = {in_contact, separated};
  for (const auto& i : r.increments)
    for (const event& e : i.events) {
      CHECK((e.what == change::make) == (isep[e.pair] == separated));
      isep[e.pair] = e.what == change::make ? in_contact : separated;
    }
  CHECK(isep == std::vector<int>{in_contact, in_contact});
}

TEST_CASE("what is followed by other means may end in a mechanism, at a pair's opening") {
  made_kernel k = endless();
  path_limits limits;
  limits.exactly = [](int) -> std::optional<followed_step> {
    return followed_step{path_status::mechanism,
                         {{0.125, {{1, change::make}}, false, {0, 0}},
                          {0.5, {{0, change::break_}}, false, {-1, -1}},
                          {0.75, {{1, change::break_}}, false, {-1, -1}}},
                         0.75,
                         {0, 0, 0, 0, -1, 0},
                         {0, 0}};
  };
  recorder r;
  const beam_problem p = cantilever_on_two();
  const path_end end = p.run(k, {&r}, limits);
  CHECK(end.status == path_status::mechanism);
  CHECK(end.fraction == 0.75);
  CHECK(end.pairs == std::vector<int>{1});
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].isep == std::vector<int>{separated, in_contact});  // as it was about to open
  made_kernel listing = endless(contact_rule::listing);
  CHECK(p.run(listing, {}, limits).status == path_status::cycle);  // the 1989 rule goes its own way
}

TEST_CASE("nobody rescues a path under the listing's rule, nor one without an equilibrium") {
  const beam_problem p = cantilever_on_two();
  int asked = 0;
  const path_limits none{0, [&](int, double, std::span<const double>) -> std::optional<equilibrium_state> {
                           ++asked;
                           return {};
                         }};
  made_kernel k = endless();
  recorder r;
  CHECK(p.run(k, {&r}, none).status == path_status::cycle);
  CHECK(asked == 7);  // for a state ahead, at six distances, and at the end
  REQUIRE(r.steps.size() == 1);
  CHECK_FALSE(r.steps[0].from_fallback);
  made_kernel listing = endless(contact_rule::listing);
  CHECK(p.run(listing, {}, none).status == path_status::cycle);
  CHECK(asked == 7);
}

TEST_CASE("after a rescue the path goes on from the equilibrium that it was given") {
  // The first step is endless, and then all goes by the corrected rule. Both pairs press after the first
  // step, and let go in the second.
  bool from_fallback = false;
  made_kernel k([&from_fallback, calls = 0](call<double>& c) mutable {
    if (from_fallback) {
      contct_corrected(c);
      return;
    }
    c.smin = 0.0;
    const std::size_t i = calls++ % 2 == 0 ? 0 : 1;
    c.isep[i] = -c.isep[i];
  });
  beam_problem p = cantilever_on_two();
  p.steps = {tip_load(2, -60), tip_load(2, 20)};
  recorder sound;
  REQUIRE(p.run("corrected", {&sound}).status == path_status::solved);
  REQUIRE(sound.steps[0].isep == std::vector<int>{in_contact, in_contact});
  const path_limits limits{
      0, [&](int, double share, std::span<const double>) -> std::optional<equilibrium_state> {
        if (share < 1.0) return {};  // not ahead
        from_fallback = true;
        return equilibrium_state{sound.steps[0].u, {1, 1}};
      }};
  recorder r;
  CHECK(p.run(k, {&r}, limits).status == path_status::solved);
  REQUIRE(r.steps.size() == 2);
  CHECK(r.steps[0].from_fallback);
  CHECK(r.steps[0].isep == sound.steps[0].isep);
  CHECK_FALSE(r.steps[1].from_fallback);
  CHECK(r.steps[1].isep == sound.steps[1].isep);
  for (std::size_t dof = 0; dof < 6; ++dof)
    CHECK(r.steps[1].u[dof] == Approx(sound.steps[1].u[dof]).epsilon(1e-12).margin(1e-18));
  // The second step's events come at the same loads.
  const auto fractions_of_second = [](const recorder& seen) {
    std::vector<double> fractions;
    for (const auto& i : seen.increments) {
      if (i.step == 2) fractions.push_back(i.fraction);
    }
    return fractions;
  };
  const std::vector<double> expected = fractions_of_second(sound);
  const std::vector<double> found = fractions_of_second(r);
  REQUIRE(expected.size() == 3);
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(found[i] == Approx(expected[i]).epsilon(1e-10));
}

TEST_CASE("a mechanism, an early limit and a lost factor are rescued too") {
  const fallback_solver fallback =
      [](int, double, std::span<const double>) -> std::optional<equilibrium_state> { return made_up_rest(); };
  beam_problem p = beam_above_stops();
  p.steps = {tip_load(2, 8.0)};
  recorder never_held;
  CHECK(p.run("corrected", {&never_held}, {0, fallback}).status == path_status::solved);
  p.steps = {tip_load(2, -8.0), tip_load(2, 8.0)};
  recorder lifted;
  CHECK(p.run("corrected", {&lifted}, {0, fallback}).status == path_status::solved);
  p.steps = {tip_load(3, -8.0)};
  recorder limited;
  CHECK(p.run("corrected", {&limited}, {1, fallback}).status == path_status::solved);
  p.geometry.EI.assign(4, 1e30);  // springs are lost beside it
  recorder lost;
  CHECK(p.run("corrected", {&lost}, {0, fallback}).status == path_status::solved);
  for (const recorder* r : {&never_held, &lifted, &limited, &lost}) {
    REQUIRE_FALSE(r->steps.empty());
    CHECK(r->steps.back().from_fallback);
    CHECK(r->steps.back().u == made_up_rest().displacement);
  }
  CHECK(lifted.steps.size() == 2);
  CHECK_FALSE(lifted.steps[0].from_fallback);
}

TEST_CASE("recovery is refined: a nearly rigid free beam keeps digits that a band solver alone loses") {
  const beam_problem p{
      even_beam(4.0, 4, 1e9), {}, {{0, face_below, 0.0, 3.0, true}, {4, face_below, 0.0, 5.0, true}}, {}};
  const linear_structure s = p.structure();
  double off_refined = 0.0;
  double off_alone = 0.0;
  for (const int node : {0, 1, 2, 3, 4}) {
    std::vector<double> load(10, 0.0);
    load[2 * static_cast<std::size_t>(node)] = -7.0;
    const double left = -7.0 * (4 - node) / 4 / 3;  // the springs share the load by the lever
    const double right = -7.0 * node / 4 / 5;
    const auto engine = make_engine("refactor", s);
    std::vector<double> refined(10);
    engine->recover(load, std::vector<double>{0.0, 0.0}, refined);
    off_refined = std::max({off_refined, std::abs(refined[0] - left), std::abs(refined[8] - right)});
    band_matrix k = s.stiffness.band();
    k.add(0, 0, 3.0);
    k.add(8, 8, 5.0);
    std::vector<double> alone = load;
    REQUIRE(factor(k));
    solve_with(k, alone);
    off_alone = std::max({off_alone, std::abs(alone[0] - left), std::abs(alone[8] - right)});
  }
  INFO(off_refined << " and " << off_alone);
  CHECK(off_refined < 2e-9);
  CHECK(off_alone > 50 * off_refined);
}

TEST_CASE("recovery is refined: a span of 40 elements has its middle to 14 digits, and fixed dofs stay") {
  const beam_problem p{
      even_beam(40.0, 40, 1.0), {{0, 0, true}, {40, 0, true}}, {{20, -1, 0.0, 2.0, true}}, {}};
  const linear_structure s = p.structure();
  const auto engine = make_engine("refactor", s);
  std::vector<double> load(82, 0.0);
  add_consistent_loads(p.geometry, {{{0, 0, 5.0}}, {{{-12.0}, {}}}}, load);
  std::vector<double> u(82);
  engine->recover(load, std::vector<double>{4.0}, u);  // a spring that stands at 2
  const double without = 12.0 * 5 / 384 * std::pow(40.0, 4);
  const double f = std::pow(40.0, 3) / 48;
  CHECK(u[40] == Approx((-without + 4 * f) / (1 + 2 * f)).epsilon(1e-14));
  CHECK(u[0] == 0.0);
  CHECK(u[80] == 0.0);
}

TEST_CASE("a path that would toggle for ever goes on from a state a billionth of the load ahead") {
  const beam_problem p = cantilever_on_two();
  recorder sound;
  REQUIRE(p.run("corrected", {&sound}).status == path_status::solved);
  std::vector<double> asked_for;
  made_kernel k([&asked_for, calls = 0](call<double>& c) mutable {
    if (!asked_for.empty()) return contct_corrected(c);
    c.smin = 0.0;
    const std::size_t i = calls++ % 2 == 0 ? 0 : 1;
    c.isep[i] = -c.isep[i];
  });
  const path_limits limits{
      0, [&](int, double share, std::span<const double> load) -> std::optional<equilibrium_state> {
        CHECK(share == 0x1p-30);
        asked_for.assign(load.begin(), load.end());
        return equilibrium_state{std::vector<double>(6), {0, 0}};
      }};
  recorder r;
  CHECK(p.run(k, {&r}, limits).status == path_status::solved);
  REQUIRE(asked_for.size() == 6);
  CHECK(asked_for[4] == Approx(p.steps[0].points[0].value * 0x1p-30).epsilon(1e-12));
  REQUIRE(r.steps.size() == sound.steps.size());
  CHECK_FALSE(r.steps[0].from_fallback);
  CHECK(r.steps[0].isep == sound.steps[0].isep);
  for (std::size_t dof = 0; dof < 6; ++dof)
    CHECK(r.steps[0].u[dof] == Approx(sound.steps[0].u[dof]).epsilon(1e-8));
  bool told = false;
  for (const auto& i : r.increments) told = told || i.fraction == 0x1p-30;
  CHECK(told);
}

TEST_CASE("where nothing is found a billionth ahead the path asks four times as far, to a millionth") {
  const beam_problem p = cantilever_on_two();
  made_kernel k = endless();
  std::vector<double> asked_at;
  const path_limits limits{
      0, [&](int, double share, std::span<const double>) -> std::optional<equilibrium_state> {
        asked_at.push_back(share);
        return {};
      }};
  CHECK(p.run(k, {}, limits).status == path_status::cycle);
  REQUIRE(asked_at.size() == 7);
  for (int i = 0; i < 6; ++i) CHECK(asked_at[i] == std::ldexp(0x1p-30, 2 * i));
  CHECK(asked_at[6] == 1.0);
}

TEST_CASE("where the path is no further than its last leap, the next one is longer") {
  const beam_problem p = cantilever_on_two();
  made_kernel k = endless();
  std::vector<double> asked_at;
  const path_limits limits{
      0, [&](int, double share, std::span<const double>) -> std::optional<equilibrium_state> {
        asked_at.push_back(share);
        if (share == 1.0) return {};
        return equilibrium_state{std::vector<double>(6), {0, 0}};
      }};
  CHECK(p.run(k, {}, limits).status == path_status::cycle);
  REQUIRE(asked_at.size() == 7);
  double share = 0.0;
  for (int i = 0; i < 6; ++i) CHECK(asked_at[i] == Approx(share += std::ldexp(0x1p-30, 2 * i)).epsilon(1e-9));
}

TEST_CASE(
    "a path that goes over to the exact one between two of its increments is told where that one is there") {
  struct places final : observer {
    std::vector<std::vector<double>> at_half;
    void incremented(const increment& i) override {
      if (i.fraction != 0.5 || i.ahead.empty()) return;
      CHECK_FALSE(i.snaps);
      at_half.emplace_back(i.ahead.begin(), i.ahead.end());
    }
  };
  const beam_problem p = cantilever_on_two();
  int told = 0;
  for (const bool first : {false, true}) {
    for (const bool second : {false, true}) {  // which pairs are in contact there, exactly
      made_kernel k([calls = 0](call<double>& c) mutable {
        c.smin = calls == 0 ? 0.5 : 0.0;  // half of the load, and then for ever the same two events
        const std::size_t i = calls++ % 2 == 0 ? 0 : 1;
        c.isep[i] = -c.isep[i];
      });
      path_limits limits;
      limits.exactly = [&](int /*step*/) -> std::optional<followed_step> {
        followed_step s{path_status::solved, {}, 1.0, {0, 0, -1, -2, -3, -4}, {first ? '\1' : '\0', '\1'}};
        s.increments.push_back({0.25, {}, false, {-0.5, -1.5}});
        if (second)
          s.increments.push_back({0.75, {}, false, {-0.75, -2.5}});
        else
          s.increments.push_back({0.75, {{1, change::make}}, false, {-0.75, -2.5}});
        s.increments.push_back({1.0, {}, false, {-1, -3}});
        return s;
      };
      places seen;
      CHECK(p.run(k, {&seen}, limits).status == path_status::solved);
      for (const std::vector<double>& d : seen.at_half) {
        CHECK(d == std::vector<double>{-0.625, -2.0});  // half of the way from 1/4 to 3/4
        ++told;
      }
    }
  }
  CHECK(told >= 2);
}

TEST_CASE("a separated pair that is exactly on its face where nothing moves is on its right side") {
  beam_problem p = cantilever_over_a_stop();
  p.pairs[0].face = 0.0;
  p.steps = {tip_load(2, 0.0)};
  int calls = 0;
  made_kernel k([&calls](call<double>& c) {
    ++calls;
    contct_corrected(c);
  });
  recorder r;
  CHECK(p.run(k, {&r}).status == path_status::solved);
  CHECK(calls == 1);  // there is nothing to settle at the end of the step
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].isep == std::vector<int>{separated});
}

TEST_CASE("a path that advances and toggles for ever by turns goes on ahead sixteen times in a step") {
  const beam_problem p = cantilever_on_two();
  bool advances = true;
  made_kernel k([&advances, calls = 0](call<double>& c) mutable {
    if (std::exchange(advances, false)) {
      c.smin = 0.01;
      return;
    }
    c.smin = 0.0;
    const std::size_t i = calls++ % 2 == 0 ? 0 : 1;
    c.isep[i] = -c.isep[i];
  });
  int asked = 0;
  const path_limits limits{
      0, [&](int, double share, std::span<const double>) -> std::optional<equilibrium_state> {
        if (share == 1.0) return {};
        ++asked;
        advances = true;
        return equilibrium_state{std::vector<double>(6), {0, 0}};
      }};
  CHECK(p.run(k, {}, limits).status == path_status::cycle);
  CHECK(asked == 16);
}
