// Tests the driver's policy for rules other than the 1989 rule.
#include "contct/path/policy.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "catch.hpp"
#include "contct/kernel/contct.hpp"
#include "support/beams.hpp"
#include "support/made_kernel.hpp"

using namespace contct;

namespace {

/// Returns a free beam above stops at its ends, at distances of 0.1 and 0.3.
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

/// Returns a made-up final state of beam_above_stops, so wrong that no solve can give it.
full_load_state made_up_rest() {
  return {std::vector<double>(10, -7.0), {in_contact, in_contact}, {}, true};
}

}  // namespace

TEST_CASE("a free beam above its stops moves as a rigid body at constant load until it lies on the stops") {
  const beam_problem p = beam_above_stops();
  recorder r;
  const path_end end = p.run("corrected", {&r});
  CHECK(end.status == path_status::solved);
  REQUIRE(r.increments.size() == 3);
  CHECK(snaps_of(r) == std::vector<bool>{true, true, false});
  CHECK(r.increments[0].fraction == 0.0);
  CHECK(r.increments[1].fraction == 0.0);
  CHECK(r.increments[2].fraction == 1.0);
  // The load of 8 at x = 3 acts on the right half, so the right end falls faster: the ends move by 1/2 and
  // 3/2 of the middle.
  CHECK(r.events() == std::vector<event>{{1, change::make}, {0, change::make}});
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].u[0] == Approx(-0.1 - 2.0 / 50).epsilon(1e-12));
  CHECK(r.steps[0].u[8] == Approx(-0.3 - 6.0 / 50).epsilon(1e-12));
  CHECK_FALSE(r.steps[0].from_fallback);
}

TEST_CASE("if the load reverses, a free beam moves from the stops below to the stops above, and back") {
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
  // In each step, the load does not increase between the separation from one side and the contact with the
  // other.
  for (std::size_t i = 1; i < r.increments.size(); ++i) {
    if (r.increments[i].snaps && r.increments[i].number > 1)
      CHECK(r.increments[i].fraction == r.increments[i - 1].fraction);
  }
  const std::vector<bool> snaps = snaps_of(r);
  CHECK(std::count(snaps.begin(), snaps.end(), true) >= 4);
}

TEST_CASE("a beam that balances on one pair is in equilibrium, and bends over the pair") {
  // Both halves are cantilevers under q = 2, whose tips deflect by q l^4 / 8 EI.
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
  CHECK(r.steps[0].rcond > 0.0);  // K with the pair's spring
}

TEST_CASE("the path of a beam that balances on its only pair ends early, although an equilibrium exists") {
  beam_problem p{even_beam(4.0, 4, 1e3), {}, {{2, face_below, 0.0, 50.0, true}}, {}};
  p.steps = {{{}, {{{-2.0}, {}}}}};
  const path_end end = p.run("corrected", {});
  CHECK(end.status == path_status::path_ended);
  CHECK(end.has_equilibrium == true);
}

TEST_CASE(
    "a beam that falls on its only pair and then rotates without limit ends in a mechanism at this contact") {
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

TEST_CASE("if a beam is lifted off its stops, the last state is reported with the share of the separation") {
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

TEST_CASE("if a balanced beam is lifted off its pair, the path ends in the state at the separation") {
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

TEST_CASE("a free beam is a mechanism at share 0 if the load drives it away from its stops") {
  beam_problem p = beam_above_stops();
  p.steps = {tip_load(2, 8.0)};
  recorder r;
  const path_end end = p.run("corrected", {&r});
  CHECK(end.status == path_status::mechanism);
  CHECK(end.fraction == 0.0);
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].u == std::vector<double>(10, 0.0));
}

TEST_CASE("by the 1989 rule, the path of a free beam above its stops ends at the start") {
  for (const char* name : {"fortran", "cpp"}) {
    bool asked = false;
    const path_limits limits{0, [&](int, const full_load_state*) {
                               asked = true;
                               return found_end{made_up_rest(), true};
                             }};
    recorder r;
    const path_end end = beam_above_stops().run(name, {&r}, limits);
    CHECK(end.status == path_status::path_ended);
    CHECK(end.has_equilibrium == true);
    CHECK(end.fraction == 0.0);
    CHECK(end.pairs.empty());
    CHECK(r.increments.empty());
    CHECK_FALSE(asked);
    REQUIRE(r.steps.size() == 1);
    CHECK_FALSE(r.steps[0].from_fallback);
    CHECK(r.steps[0].u == std::vector<double>(10, 0.0));
  }
}

namespace {

/// Toggles pair 0 without progress of the load in each call in which the response of pair 0 is not 0, and
/// otherwise follows the corrected rule. Counts both kinds of calls.
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

/// Returns a cantilever with a stop at its tip, and a pair in its middle that every load presses.
beam_problem cantilever_on_two() {
  return {even_beam(2.0, 2, 1e4),
          {{0, 0, true}, {0, 1, true}},
          {{1, face_below, 0.0, 5e4, true}, {2, face_below, -1e-4, 5e4, false}},
          {tip_load(2, -10), tip_load(2, -60)}};
}

}  // namespace

TEST_CASE(
    "a pair that toggles twice without progress of the load stays in contact until the load increases") {
  restless_first_pair restless;
  made_kernel k([&restless](call<double>& c) { restless(c); });
  const beam_problem p = cantilever_on_two();
  recorder r;
  const path_end end = p.run(k, {&r});
  CHECK(end.status == path_status::solved);
  recorder sound;
  REQUIRE(p.run("corrected", {&sound}).status == path_status::solved);
  // In each step pair 0 toggles twice, and then has no response until the tip reaches its stop.
  CHECK(restless.toggles >= 4);
  CHECK(restless.quiet >= 3);
  REQUIRE(r.steps.size() == 2);
  for (std::size_t step = 0; step < 2; ++step) {
    CHECK(r.steps[step].isep == sound.steps[step].isep);
    for (std::size_t dof = 0; dof < 6; ++dof)
      CHECK(r.steps[step].u[dof] == Approx(sound.steps[step].u[dof]).epsilon(1e-12).margin(1e-18));
  }
}

namespace {

/// Answers by the corrected rule, but with every event at 0.999 of its s.
void hasty(call<double>& c) {
  contct_corrected(c);
  if (c.smin > 0.0 && c.smin < 1.0) c.smin *= 0.999;
}

}  // namespace

TEST_CASE("by the corrected rule, early toggles leave no error in D at the ends of steps") {
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

TEST_CASE("by the 1989 rule, an early toggle leaves an error in the displacements") {
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

namespace {

/// Returns a kernel that toggles both pairs in turn without progress and without end.
made_kernel endless(contact_rule rule = contact_rule::corrected) {
  return made_kernel(
      [calls = 0](call<double>& c) mutable {
        c.smin = 0.0;
        const std::size_t i = calls++ % 2 == 0 ? 0 : 1;
        c.isep[i] = -c.isep[i];
      },
      rule);
}

}  // namespace

TEST_CASE("if a path cannot continue, it ends in the reference solution, and the state is marked as such") {
  made_kernel k = endless();
  const beam_problem p = cantilever_on_two();
  full_load_state rest{{0, 0, -1, -2, -3, -4}, {in_contact, separated}};
  rest.from_reference = true;
  int lost = 0;
  const path_limits limits{0, [&](int, const full_load_state* reached) {
                             lost += reached == nullptr ? 1 : 0;
                             return found_end{rest, true};
                           }};
  recorder r;
  const path_end end = p.run(k, {&r}, limits);
  CHECK(end.status == path_status::solved);
  CHECK(lost == 2);
  REQUIRE(r.steps.size() == 2);
  for (const auto& step : r.steps) {
    CHECK(step.from_fallback);
    CHECK(step.fraction == 1.0);
    CHECK(step.u == rest.displacement);
    CHECK(step.isep == std::vector<int>{in_contact, separated});
  }
}

TEST_CASE(
    "each state that a path reaches is passed to the prover, and the path continues with the proved "
    "statuses") {
  beam_problem p = cantilever_on_two();
  std::vector<std::vector<int>> reached;
  full_load_state answer{std::vector<double>(6), {separated, separated}};
  const path_limits limits{0, [&](int, const full_load_state* state) {
                             REQUIRE(state != nullptr);
                             reached.push_back(state->isep);
                             return found_end{answer, true};
                           }};
  recorder r;
  CHECK(p.run("corrected", {&r}, limits).status == path_status::solved);
  REQUIRE(reached.size() == 2);
  for (const auto& step : r.steps) {
    CHECK_FALSE(step.from_fallback);
    CHECK(step.u == answer.displacement);
    CHECK(step.isep == answer.isep);
  }
  const bool makes_again = std::any_of(r.increments.begin(), r.increments.end(), [](const auto& i) {
    return i.step == 2 &&
           std::find(i.events.begin(), i.events.end(), event{0, change::make}) != i.events.end();
  });
  CHECK(makes_again);  // pair 0 was separated in the proved state
}

TEST_CASE("if a path cannot continue and no equilibrium exists, the path ends in a mechanism") {
  made_kernel k = endless();
  const path_limits limits{0, [](int, const full_load_state*) { return found_end{std::nullopt, false}; }};
  recorder r;
  const beam_problem p = cantilever_on_two();
  const path_end end = p.run(k, {&r}, limits);
  CHECK(end.status == path_status::mechanism);
  CHECK(end.has_equilibrium == false);
  REQUIRE(r.steps.size() == 1);
  CHECK(r.steps[0].fraction == 0.0);
  made_kernel listing = endless(contact_rule::listing);
  CHECK(p.run(listing, {}, limits).status == path_status::cycle);  // the 1989 rule has no fallback
}

TEST_CASE("by the 1989 rule, or without a reference solution, a path that cannot continue has no fallback") {
  const beam_problem p = cantilever_on_two();
  int asked = 0;
  const path_limits none{0, [&](int, const full_load_state*) {
                           ++asked;
                           return found_end();
                         }};
  made_kernel k = endless();
  recorder r;
  CHECK(p.run(k, {&r}, none).status == path_status::cycle);
  CHECK(asked == 1);
  REQUIRE(r.steps.size() == 1);
  CHECK_FALSE(r.steps[0].from_fallback);
  made_kernel listing = endless(contact_rule::listing);
  CHECK(p.run(listing, {}, none).status == path_status::cycle);
  CHECK(asked == 1);
}

TEST_CASE("after a step that ends in the reference solution, the next step continues from this state") {
  // The kernel toggles without end in the first step, and then follows the corrected rule. Both pairs are in
  // contact after the first step, and separate in the second step.
  bool is_found = false;
  made_kernel never = endless();
  made_kernel k([&](call<double>& c) { is_found ? contct_corrected(c) : never.answer(c); });
  beam_problem p = cantilever_on_two();
  p.steps = {tip_load(2, -60), tip_load(2, 20)};
  recorder sound;
  REQUIRE(p.run("corrected", {&sound}).status == path_status::solved);
  REQUIRE(sound.steps[0].isep == std::vector<int>{in_contact, in_contact});
  const path_limits limits{0, [&](int, const full_load_state* reached) {
                             if (reached != nullptr) return found_end{*reached, true};
                             is_found = true;
                             full_load_state found{sound.steps[0].u, {in_contact, in_contact}};
                             found.from_reference = true;
                             return found_end{std::move(found), true};
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
  CHECK(r.increments.back().number == 3);  // two increments with events, and one to full load
}

TEST_CASE(
    "the reference solution replaces the end of a path if a factorisation failed or the limit of increments "
    "was reached, but not a proved mechanism") {
  const path_limits any{0, [](int, const full_load_state* reached) {
                          return found_end{reached != nullptr ? *reached : made_up_rest(), true};
                        }};
  beam_problem p = beam_above_stops();
  p.steps = {tip_load(2, 8.0)};
  recorder never_held;
  CHECK(p.run("corrected", {&never_held}, any).status == path_status::mechanism);
  p.steps = {tip_load(3, -8.0)};
  recorder limited;
  CHECK(p.run("corrected", {&limited}, {1, any.ends}).status == path_status::solved);
  p.geometry.EI.assign(4, 1e30);  // so stiff that the springs are lost to rounding
  recorder lost;
  CHECK(p.run("corrected", {&lost}, any).status == path_status::solved);
  for (const recorder* r : {&limited, &lost}) {
    REQUIRE_FALSE(r->steps.empty());
    CHECK(r->steps.back().from_fallback);
    CHECK(r->steps.back().u == made_up_rest().displacement);
  }
}

TEST_CASE(
    "after 20 + 4 n toggles of n pairs at constant load, the driver toggles the first pair at its face") {
  // The kernel toggles pairs 2 and 3 in turn, although pair 1 is at its face too.
  made_kernel k([calls = 0](call<double>& c) mutable {
    c.smin = 0.0;
    std::fill(c.ss.begin(), c.ss.end(), 0.0);
    c.isep[calls++ % 2 == 0 ? 1 : 2] *= -1;
  });
  beam_problem p = cantilever_on_two();
  p.pairs.push_back({2, face_below, -1e-4, 5e4, false});
  const linear_structure s = p.structure();
  const auto engine = make_engine("refactor", s);
  path_state now(s, *engine, {}, false);
  const auto policy = make_policy(now, k);
  CHECK(quick_answers_at_rest(3) == 32);
  for (int i = 0; i < 32; ++i) {
    CHECK(policy->decide() == 0.0);
    REQUIRE(now.events.size() == 1);
    CHECK(now.events[0].pair != 0);
    now.sprung = now.status;
  }
  CHECK(policy->decide() == 0.0);
  CHECK(now.events == std::vector<event>{{0, change::break_}});
}
