// Tests what is observed on a path, steps that start from the unloaded structure, and the state of a path.
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/harness/compare.hpp"
#include "contct/path/path_state.hpp"
#include "contct/results/path_observers.hpp"
#include "support/beams.hpp"
#include "support/made_kernel.hpp"
#include "support/one_pair.hpp"

using namespace contct;

namespace {

/// Follows PB1 with `second` as the second kernel, and passes its explained increments to `take`.
explained_path explained_pb1(
    const std::vector<std::string>& second, increments_wanted wanted = {},
    std::function<void(const explained_increment&)> take = [](const auto&) {}) {
  explained_path path(facts_of_kernel("fortran"), second, wanted, std::move(take));
  (void)cantilever_over_a_stop().run("fortran", {&path});
  return path;
}

load from_zero(load l) {
  l.from_zero = true;
  return l;
}

/// Returns a clamped beam between stops. The first load presses the beam on the stops below, and the second
/// load, a step from zero, on a stop above.
beam_problem between_stops() {
  load second = from_zero(tip_load(7, 13.0));
  second.points.push_back({3, 0, -30.0});
  return {even_beam(4.0, 8, 100.0),
          {{0, 0}, {0, 1}},
          {{2, face_below, -0.001, 5e3, false},
           {4, face_below, 0.0, 2e3, true},
           {5, face_above, 0.002, 7e3, false},
           {8, face_below, -0.03, 1e4, false}},
          {tip_load(8, -40.0), second}};
}

/// Returns the paths of between_stops with an engine, and of its second step alone.
std::pair<recorder, recorder> with_and_without_first_step(const char* engine, const char* kernel) {
  beam_problem p = between_stops();
  recorder both;
  const solved_path path = follow(p.as_problem(), p.structure(), engine, *make_kernel(kernel), {&both});
  CHECK(path.end.status == path_status::solved);
  both.take(path);
  p.steps.erase(p.steps.begin());
  const auto [end, alone] = path_of(p, kernel);
  CHECK(end.status == path_status::solved);
  REQUIRE(both.steps.size() == 2);
  CHECK(both.steps[1].isep == alone.steps[0].isep);
  return {both, alone};
}

}  // namespace

TEST_CASE("every increment of PB1 is explained and compared with a second kernel") {
  const explained_path all = explained_pb1({"cpp"}, {}, [](const explained_increment& i) {
    INFO("step " << i.what.step << ", increment " << i.what.number);
    REQUIRE(i.other != nullptr);
    CHECK(i.other->smin == i.call.smin);
    CHECK_FALSE(i.apart);
    CHECK((i.call.winner == 0) == (i.call.smin < 1.0));
    CHECK((i.fraction_before > 0.0) == (i.what.number == 2));
  });
  CHECK(all.calls() == 6);
  CHECK(all.explained() == 6);
  CHECK(all.steps() == 4);
  CHECK(all.most_increments() == 2);
  CHECK(all.compared().values == 6L * 4);
  CHECK(all.compared().mismatches == 0);
  CHECK_FALSE(all.first());
}

TEST_CASE("one increment of one kernel can be explained without a second kernel") {
  int increments = 0;
  const explained_path one = explained_pb1({}, {2, 2}, [&increments](const explained_increment& i) {
    ++increments;
    CHECK((i.what.step == 2 && i.what.number == 2));
    CHECK(i.fraction_before > 0.0);
    CHECK(i.other == nullptr);
  });
  CHECK(increments == 1);
  CHECK(one.compared().values == 0);
  CHECK(one.calls() == 6);
  CHECK_THROWS_AS(explained_pb1({"corrected"}), std::invalid_argument);
}

TEST_CASE("a toggle before the face is early, and its distance is relative to the largest deflection") {
  early_toggles early;
  const std::vector<event> events = {{0, change::make}};
  const auto called = [&early](double face) {
    small_call<double> c({{0.0, -2.0, face, apart, below}});
    c.ask_by([](call<double>& answered) {
      answered.smin = answered.ss[0] = 0.5;
      answered.isep[0] = in_contact;
    });
    early.called(c.answered());
  };
  called(-1.0);  // the pair reaches its face
  early.incremented({1, 1, 0.5, 0.5, events});
  CHECK(early.all().empty());
  called(-1.25);                            // the pair is 0.25 before its face
  early.incremented({1, 2, 0.5, 1.0, {}});  // the driver has undone the toggle
  CHECK(early.all().empty());
  called(-1.25);
  early.incremented({2, 1, 0.5, 0.5, events});
  REQUIRE(early.all().size() == 1);
  CHECK((early.all()[0].step == 2 && early.all()[0].number == 1));
  CHECK(early.all()[0].what == events[0]);
  CHECK(early.all()[0].distance == 0.25);
  CHECK(early.all()[0].share == 0.25);
}

TEST_CASE("a kernel that replays the recorded trace of its own path gives the recorded answers") {
  std::string text;
  trace_recorder recorder(header_for(facts_of_kernel("fortran"), "a checksum"),
                          [&text](std::string_view part) { text += part; });
  CHECK(text.starts_with(trace_format));
  (void)cantilever_over_a_stop().run("fortran", {&recorder});
  trace_reader calls(text, "recorded");
  const trace_header h = calls.read_header();
  CHECK(h.name == "fortran");
  CHECK(h.listing == "a checksum");
  const auto cpp = make_kernel("cpp");
  follower f = follower_of(h, *cpp);
  CHECK(replay(calls, f) == 6);
  CHECK(f.compared.values == 6L * 4);
  CHECK(f.compared.mismatches == 0);
}

TEST_CASE("the path of a step from zero is the same to the bit with and without a step before it") {
  for (const char* kernel : {"fortran", "cpp", "corrected"}) {
    const auto [both, alone] = with_and_without_first_step("refactor", kernel);
    REQUIRE(both.steps[0].isep != alone.steps[0].isep);
    CHECK(both.steps[1].u == alone.steps[0].u);
    const std::size_t before = both.increments.size() - alone.increments.size();
    REQUIRE(alone.increments.size() >= 3);
    for (std::size_t i = 0; i < alone.increments.size(); ++i) {
      CHECK(both.increments[before + i].s == alone.increments[i].s);
      CHECK(both.increments[before + i].events == alone.increments[i].events);
    }
  }
}

TEST_CASE("with an engine that keeps a factor, a step from zero also starts from the unloaded structure") {
  for (const char* engine : {"updated", "condensed"}) {
    const auto [both, alone] = with_and_without_first_step(engine, "cpp");
    for (std::size_t dof = 0; dof < alone.steps[0].u.size(); ++dof)
      CHECK(both.steps[1].u[dof] == Approx(alone.steps[0].u[dof]).epsilon(1e-10).margin(1e-14));
  }
}

TEST_CASE("after a mechanism, only a step from zero and the steps that continue it are followed") {
  const load up = from_zero(tip_load(1, 7.0)), down = tip_load(2, -8.0);
  // A beam that lies on stops at its ends, each of which has half of the load.
  const beam_problem p = free_beam(100.0, {{0, face_below, 0.0, 1e4, true}, {4, face_below, 0.0, 1e4, true}},
                                   {up, down, from_zero(down), tip_load(2, -4.0), up, from_zero(down)});
  for (const char* kernel : {"fortran", "corrected"}) {
    const auto [end, seen] = path_of(p, kernel);
    CHECK((end.status == path_status::mechanism && end.step == 1));
    REQUIRE(end.others.size() == 1);
    CHECK((end.others[0].status == path_status::mechanism && end.others[0].step == 5));
    REQUIRE(seen.steps.size() == 5);
    for (const auto& [i, step, w] : {std::tuple(1, 3, -4.0 / 1e4), {2, 4, -2.0 / 1e4}, {4, 6, -4.0 / 1e4}}) {
      CHECK(seen.steps[i].step == step);
      CHECK(seen.steps[i].u[0] == Approx(w).epsilon(1e-12));
    }
  }
}

TEST_CASE("the cycle detector finds a cycle of any length at any time, but no cycle if anything moves") {
  for (const int lead : {0, 1, 5, 17}) {
    for (const int loop : {1, 2, 3, 7, 20}) {
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
  cycle_detector moving;
  for (int i = 0; i < 100; ++i) CHECK_FALSE(moving.repeats(true, std::vector<int>{1}, {}));
  CHECK_FALSE(moving.repeats(false, std::vector<int>{1}, {}));
  CHECK(moving.repeats(false, std::vector<int>{1}, {}));
}

TEST_CASE("the pairs of a cycle are those that toggled twice within 200 increments") {
  cycle_detector watch;
  const std::vector<int> status = {1, 1, 1};
  const std::vector<event> both = {{0, change::make}, {1, change::make}}, first = {{0, change::break_}};
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
  const problem what = p.as_problem();
  const linear_structure s = p.structure();
  const load_history loads(what, s);
  const auto engine = make_engine("refactor", s);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {infinite, -infinite, std::nan("")}) {
    for (std::size_t pair = 0; pair < 9; ++pair) {
      path_state now(s, loads, *engine, {}, false);
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
