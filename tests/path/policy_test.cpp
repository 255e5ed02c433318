// Tests the driver's policy for rules other than the 1989 rule. paths_test.cpp has more paths of free beams.
#include "contct/path/policy.hpp"

#include <algorithm>

#include "catch.hpp"
#include "contct/kernel/contct.hpp"
#include "support/judged_run.hpp"
#include "support/made_kernel.hpp"

using namespace contct;

namespace {

beam_problem beam_on_stops() {
  return beam_above_stops({tip_load(3, -8.0)});
}

/// Returns a cantilever with a stop at its tip, and a pair in its middle that every load presses.
beam_problem cantilever_on_two() {
  return cantilever({{1, face_below, 0.0, 5e4, true}, {2, face_below, -1e-4, 5e4, false}},
                    {tip_load(2, -10), tip_load(2, -60)});
}

/// Returns a kernel that toggles both pairs in turn without progress and without end.
made_kernel endless(contact_rule rule = contact_rule::corrected) {
  return made_kernel(
      [calls = 0](call<double>& c) mutable {
        c.smin = 0.0;
        c.isep[calls++ % 2] *= -1;
      },
      rule);
}

void check_equal_end(const recorder::seen_step& a, const recorder::seen_step& b) {
  CHECK(a.isep == b.isep);
  for (std::size_t dof = 0; dof < b.u.size(); ++dof)
    CHECK(a.u[dof] == Approx(b.u[dof]).epsilon(1e-12).margin(1e-18));
}

}  // namespace

TEST_CASE("a free beam moves as a rigid body at constant load between stops below and above") {
  beam_problem p = beam_on_stops();
  p.pairs.push_back({0, face_above, 0.2, 50.0, false});
  p.pairs.push_back({4, face_above, 0.2, 50.0, false});
  p.steps = {tip_load(3, -8.0), tip_load(1, 8.0), tip_load(3, -8.0)};
  const auto [end, r] = path_of(p, "corrected");
  CHECK(end.status == path_status::solved);
  REQUIRE(r.steps.size() == 3);
  CHECK(r.steps[1].isep == std::vector<int>{separated, separated, in_contact, in_contact});
  for (const auto& [step, left, right] : {std::tuple(0, -0.1 - 2.0 / 50, -0.3 - 6.0 / 50),
                                          {1, 0.2 + 6.0 / 50, 0.2 + 2.0 / 50},
                                          {2, -0.1 - 2.0 / 50, -0.3 - 6.0 / 50}}) {
    CHECK(r.steps[step].u[0] == Approx(left).epsilon(1e-12));
    CHECK(r.steps[step].u[8] == Approx(right).epsilon(1e-12));
    CHECK(r.steps[step].from == origin::path);
  }
  std::vector<bool> snaps;
  for (std::size_t i = 0; i < r.increments.size(); ++i) {
    snaps.push_back(r.increments[i].snaps);
    // The load does not increase between the separation from one side and the contact with the other.
    if (snaps[i] && r.increments[i].number > 1)
      CHECK(r.increments[i].fraction == r.increments[i - 1].fraction);
  }
  CHECK(std::vector(snaps.begin(), snaps.begin() + 3) == std::vector{true, true, false});
  CHECK(std::count(snaps.begin(), snaps.end(), true) >= 6);
}

TEST_CASE("a beam balances on a pair and bends over it, and K with this spring has a condition number") {
  // Both halves are cantilevers under q = 2, whose tips deflect by q l^4 / 8 EI.
  const auto r = path_of(balanced_beam({uniform(-2)}), "corrected");
  REQUIRE(r.seen.steps.size() == 1);
  CHECK(r.seen.steps[0].rcond > 0.0);
  const std::vector<double>& u = r.seen.steps[0].u;
  CHECK((u[0] + u[8]) / 2 == Approx(u[4] - 2.0 * 16 / 8 / 1e3).epsilon(1e-12));
}

TEST_CASE("by the 1989 rule, the path of a free beam above its stops ends at the start, without a fallback") {
  for (const char* name : {"fortran", "cpp"}) {
    const judged_run r(beam_on_stops().as_problem(), name);
    CHECK(r.end.status == path_status::path_ended);
    CHECK(r.end.has_equilibrium == true);
    CHECK(r.end.fraction == 0.0);
    CHECK(r.end.pairs.empty());
    CHECK(r.seen.increments.empty());
    REQUIRE(r.steps.size() == 1);
    CHECK(r.steps[0].from == origin::path);
    CHECK_FALSE(r.steps[0].judged);
    CHECK(r.u(1) == std::vector<double>(10, 0.0));
  }
}

TEST_CASE("a pair that toggles twice without progress stays in contact until the load increases") {
  // Toggles pair 0 without progress whenever its response is not 0, and otherwise follows the corrected rule.
  int toggles = 0, quiet = 0;
  made_kernel k([&](call<double>& c) {
    if (c.dtest[static_cast<std::size_t>(c.dof.dof_of(c.id[0]) - 1)] == 0.0) {
      ++quiet;
      contct_corrected(c);
      return;
    }
    ++toggles;
    c.smin = 0.0;
    c.isep[0] = -c.isep[0];
  });
  const auto [end, r] = path_of(cantilever_on_two(), k);
  CHECK(end.status == path_status::solved);
  const auto [sound_end, sound] = path_of(cantilever_on_two(), "corrected");
  REQUIRE(sound_end.status == path_status::solved);
  // In each step pair 0 toggles twice, and then has no response until the tip reaches its stop.
  CHECK(toggles >= 4);
  CHECK(quiet >= 3);
  REQUIRE(r.steps.size() == 2);
  for (std::size_t step = 0; step < 2; ++step) check_equal_end(r.steps[step], sound.steps[step]);
}

TEST_CASE("early toggles leave an error in D by the 1989 rule, and none by the corrected rule") {
  for (const contact_rule rule : {contact_rule::corrected, contact_rule::listing}) {
    // Every event comes at 0.999 of its s.
    made_kernel k(
        [](call<double>& c) {
          contct_corrected(c);
          if (c.smin > 0.0 && c.smin < 1.0) c.smin *= 0.999;
        },
        rule);
    const auto [end, r] = path_of(cantilever_over_a_stop(), k);
    const auto [sound_end, sound] = path_of(cantilever_over_a_stop(), "corrected");
    CHECK(end.status == path_status::solved);
    REQUIRE(r.steps.size() == 4);
    if (rule == contact_rule::corrected) {
      for (const std::size_t step : {1, 2, 3})
        CHECK(r.steps[step].u[4] == Approx(sound.steps[step].u[4]).epsilon(1e-12));
    } else {
      CHECK(r.steps[1].u[4] != Approx(sound.steps[1].u[4]).epsilon(1e-6));
      CHECK(r.steps[1].u[4] == Approx(sound.steps[1].u[4]).epsilon(1e-3));
    }
  }
}

TEST_CASE("if a path cannot continue, it ends in the reference solution, except by the 1989 rule") {
  const problem p = cantilever_on_two().as_problem();
  const linear_structure s = structure_of(p);
  const judged_run sound(p, "corrected");
  for (const contact_rule rule : {contact_rule::corrected, contact_rule::listing}) {
    made_kernel k = endless(rule);
    certifier proof(p, s);
    const solved_path lost = follow(p, s, "refactor", k, {}, &proof);
    const bool is_1989 = rule == contact_rule::listing;
    CHECK(lost.end.status == (is_1989 ? path_status::cycle : path_status::solved));
    REQUIRE(lost.steps.size() == (is_1989 ? 1U : 2U));
    if (is_1989) CHECK((lost.steps[0].from == origin::path && lost.steps[0].fraction == 0.0));
    for (std::size_t step = 0; step < 2 && !is_1989; ++step) {
      CHECK(lost.steps[step].from == origin::reference);
      CHECK(lost.steps[step].fraction == 1.0);
      CHECK(lost.steps[step].judged->certified);
      CHECK(lost.steps[step].isep == sound.steps[step].isep);
      CHECK(lost.steps[step].displacement[4] == Approx(sound.u(step + 1)[4]).epsilon(1e-14));
    }
  }
}

TEST_CASE("a path goes on from the state it is given, which may have other statuses") {
  const problem p = cantilever_on_two().as_problem();
  const linear_structure s = structure_of(p);
  for (const origin from : {origin::path, origin::reference}) {
    const auto engine = make_engine("refactor", s);
    const auto leader = make_kernel("corrected");
    const load_history loads(p, s);
    recorder seen;
    observer* const watching[] = {&seen};
    path way(s, loads, *engine, *leader, watching);
    REQUIRE(way.follow(1).status == path_status::solved);
    structure_state other = way.now().value();
    other.isep = {separated, separated};
    other.from = from;
    CHECK(way.go_on_from(other) > 0.0);
    CHECK(way.follow(2).status == path_status::solved);
    CHECK(way.now()->isep == std::vector<int>{in_contact, in_contact});
    CHECK(std::ranges::any_of(seen.increments, [](const auto& i) {
      return i.step == 2 && std::ranges::count(i.events, event{0, change::make}) > 0;
    }));
  }
}

TEST_CASE("only if certainly no equilibrium exists, a path that failed ends in a mechanism") {
  using enum path_status;
  using row = std::tuple<path_status, std::optional<bool>, bool, path_status>;
  for (const auto& [failed, exists, by_1989_rule, ends] :
       {row{mechanism, false, false, mechanism}, row{mechanism, {}, false, path_ended},
        row{mechanism, true, true, path_ended}, row{cycle, false, false, mechanism},
        row{cycle, false, true, cycle}, row{cycle, {}, false, cycle}, row{path_ended, false, true, mechanism},
        row{iteration_limit, true, false, iteration_limit}}) {
    path_end end{.status = failed, .opened = {3}, .has_equilibrium = exists, .by_1989_rule = by_1989_rule};
    end.conclude();
    CHECK(end.status == ends);
    CHECK((end.pairs == std::vector<int>{3}) == (failed == cycle && ends == mechanism));
  }
}

TEST_CASE("after a step that ends in the reference solution, the next step continues from this state") {
  // The kernel toggles without end in the first step, and then follows the corrected rule. Both pairs are in
  // contact after the first step, and separate in the second step.
  int calls = 0;
  made_kernel never = endless();
  made_kernel k([&](call<double>& c) { ++calls > 3 ? contct_corrected(c) : never.answer(c); });
  beam_problem p = cantilever_on_two();
  p.steps = {tip_load(2, -60), tip_load(2, 20)};
  const auto [sound_end, sound] = path_of(p, "corrected");
  REQUIRE(sound_end.status == path_status::solved);
  REQUIRE(sound.steps[0].isep == std::vector<int>{in_contact, in_contact});
  const problem what = p.as_problem();
  const linear_structure s = p.structure();
  certifier proof(what, s);
  recorder r;
  const solved_path path = follow(what, s, "refactor", k, {&r}, &proof, 3);
  r.take(path);
  CHECK(path.end.status == path_status::solved);
  REQUIRE(r.steps.size() == 2);
  CHECK((r.steps[0].from == origin::reference && r.steps[1].from == origin::path));
  for (std::size_t step = 0; step < 2; ++step) check_equal_end(r.steps[step], sound.steps[step]);
  CHECK(r.increments.back().number == 3);  // two increments with events, and one to full load
}

TEST_CASE("the reference solution replaces the end of a lost path, but not a proved mechanism") {
  problem driven_away = beam_on_stops().as_problem();
  driven_away.steps = {tip_load(2, 8.0)};
  CHECK(judged_run(driven_away, "corrected").end.status == path_status::mechanism);
  const problem p = beam_on_stops().as_problem();
  const linear_structure s = structure_of(p);
  certifier proof(p, s);
  const solved_path cut = follow(p, s, "refactor", *make_kernel("corrected"), {}, &proof, 1);
  CHECK(cut.end.status == path_status::solved);
  REQUIRE(cut.steps.size() == 1);
  CHECK(cut.steps[0].from == origin::reference);
}

TEST_CASE("after 20 + 4 n toggles at constant load, the driver toggles the first pair at its face") {
  // The kernel toggles pairs 2 and 3 in turn, although pair 1 is at its face too.
  made_kernel k([calls = 0](call<double>& c) mutable {
    c.smin = 0.0;
    std::fill(c.ss.begin(), c.ss.end(), 0.0);
    c.isep[calls++ % 2 == 0 ? 1 : 2] *= -1;
  });
  problem p = cantilever_on_two().as_problem();
  p.pairs.push_back({2, face_below, -1e-4, 5e4, false});
  const linear_structure s = structure_of(p);
  const load_history loads(p, s);
  const auto engine = make_engine("refactor", s);
  path_state now(s, loads, *engine, {}, false);
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
