// Tests paths that can be calculated by hand, and paths that end early: mechanisms, cycles and limits.
#include <cmath>

#include "catch.hpp"
#include "contct/path/path.hpp"
#include "support/beams.hpp"
#include "support/made_kernel.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

using enum path_status;

/// A displacement at the end of a step, from 1.
struct stated_displacement {
  std::size_t step, dof;
  double value;
  double margin = 1e-15;
};

struct stated_path {
  const char* what;
  beam_problem p;
  struct {
    std::vector<const char*> kernels;
    path_status status;
    int step;
    double share;          // of the step
    const char* statuses;  // at the end, such as "in out" for a pair in contact and a separated pair
    const char* events;    // of the whole path, such as "+0 -0" if pair 0 makes and breaks contact
    std::vector<stated_displacement> u = {};
    std::vector<double> shares = {};  // of all increments; not compared if empty
  } end;
};

std::string statuses_of(const std::vector<int>& isep) {
  std::string words;
  for (const int status : isep) words += status == in_contact ? " in" : " out";
  return words.substr(1);
}
std::string words_of(const std::vector<event>& events) {
  std::string words;
  for (const event& e : events) words += (e.what == change::make ? " +" : " -") + std::to_string(e.pair);
  return words.empty() ? "" : words.substr(1);
}

std::vector<stated_path> stated_paths() {
  const double f = 8.0 / 3 / 1e4;  // the flexibility at the tip of PB1
  const auto pressed = [f](double load, double face) {
    return face + (load * f - face) / (f + 1 / 5e4) / 5e4;
  };
  return {
      {"PB1: the tip of a cantilever meets the stop at F = -15",
       cantilever_over_a_stop(),
       {{"fortran", "cpp", "corrected"},
        solved,
        4,
        1,
        "out",
        "+0 -0",
        {{1, 4, -10 * f}, {2, 4, pressed(-60, -0.004)}, {3, 4, pressed(-30, -0.004)}, {4, 4, 20 * f}},
        {1, 0.1, 1, 1, 0.3, 1}}},
      {"a face above stops a beam that moves up; two pairs at one node",
       cantilever({{2, 1, 0.002, 5e4, false}, {2, -1, -0.004, 5e4, false}},
                  {tip_load(2, 30), tip_load(2, -30)}),
       {{"fortran"},
        solved,
        2,
        1,
        "out in",
        "+0 -0 +1",
        {{1, 4, pressed(30, 0.002)}, {2, 4, pressed(-30, -0.004)}}}},
      {"a pair and a hinged support hold a beam",
       {even_beam(2, 2, 10), {{0, 0, true}}, {{2, -1, 0.0, 5.0, true}}, {tip_load(1, -1.0)}},
       {{"fortran"}, solved, 1, 1, "in", "", {{1, 4, -0.5 / 5}}}},
      {"a rotational spring alone does not hold a beam",
       {even_beam(2, 2, 10), {{0, 1, false, 3.0}}, {{2, -1, 0.0, 5.0, false}}, {tip_load(1, -1.0)}},
       {{"fortran"}, path_ended, 1, 0, "out", ""}},
      // About pair 2 the moments are 4 * 1 = F * 1, so F = 4, a share of 2/3 of 6.
      {"a force beyond the second of two springs lifts a beam off the first",
       free_beam(100, {{1, -1, 0.0, 10.0, true}, {3, -1, 0.0, 10.0, true}},
                 {tip_load(2, -4), {{{2, 0, -4}, {4, 0, -6}}, {}}}),
       {{"fortran"}, mechanism, 2, 2.0 / 3, "out in", "-0", {{2, 2, 0, 1e-12}, {2, 6, -0.8}}}},
      // The load of 8 at x = 3 acts on the right half, so the right end falls faster: the ends move by 1/2
      // and 3/2 of the middle.
      {"a free beam falls on its stops at constant load",
       beam_above_stops({tip_load(3, -8)}),
       {{"corrected"},
        solved,
        1,
        1,
        "in in",
        "+1 +0",
        {{1, 0, -0.1 - 2.0 / 50}, {1, 8, -0.3 - 6.0 / 50}},
        {0, 0, 1}}},
      {"a beam is lifted off its stops",
       beam_above_stops({tip_load(2, -8), tip_load(2, 8)}),
       {{"corrected"}, mechanism, 2, 0.5, nullptr, nullptr, {{2, 0, -0.1}, {2, 8, -0.3}}}},
      {"a load drives a free beam away from its stops",
       beam_above_stops({tip_load(2, 8)}),
       {{"corrected"}, mechanism, 1, 0, "out out", "", {{1, 0, 0}, {1, 4, 0}, {1, 8, 0}}}},
      {"a beam balances on a pair",
       balanced_beam({uniform(-2)}),
       {{"corrected"}, solved, 1, 1, "in out", "+0", {{1, 4, -0.1 - 8.0 / 50}}}},
      {"a balanced beam is lifted off its pair",
       balanced_beam({uniform(-2), uniform(2)}),
       {{"corrected"}, mechanism, 2, 0.5, "out out", "+0 -0", {{2, 4, -0.1}}}},
      {"a beam falls on its only pair and rotates without limit",
       {even_beam(2, 2, 1e3), {}, {{1, face_below, -0.5, 1e4, false}}, {tip_load(2, -1)}},
       {{"corrected"}, mechanism, 1, 0, "in", "+0", {{1, 0, 0}, {1, 2, -0.5}, {1, 4, -1}}}},
      {"a beam balances on its only pair, but rounding ends the path",
       free_beam(1e3, {{2, face_below, 0.0, 50.0, true}}, {uniform(-2)}),
       {{"corrected"}, path_ended, 1, 0, "in", ""}},
  };
}

/// The engine refactor, except that one response fails. It records which springs are applied.
class failing_engine final : public stiffness_engine {
 public:
  failing_engine(const linear_structure& s, int failing_response)
      : inner_(make_engine("refactor", s)), fails_at_(failing_response) {
    for (const pair_in<double>& p : s.pairs) springs.push_back(p.closed);
  }
  void switch_spring(int pair, bool closed) override {
    springs[pair] = closed;
    inner_->switch_spring(pair, closed);
  }
  void respond(const residual_load& residual, std::span<double> d_star) override {
    if (++responses == fails_at_) throw no_factor("made for a test");
    inner_->respond(residual, d_star);
  }
  void recover(std::span<const double> load, std::span<const double> forces, std::span<double> u) override {
    inner_->recover(load, forces, u);
  }
  double reciprocal_condition() override { return inner_->reciprocal_condition(); }

  std::vector<bool> springs;  // [pairs]
  int responses = 0;

 private:
  std::unique_ptr<stiffness_engine> inner_;
  int fails_at_;
};

}  // namespace

TEST_CASE("paths of small beams have the ends, displacements, statuses and events of hand calculations") {
  for (const auto& [what, p, expected] : stated_paths()) {
    for (const char* kernel : expected.kernels) {
      const auto [end, seen] = path_of(p, kernel);
      INFO(what << ": " << kernel);
      CHECK(end.status == expected.status);
      CHECK(end.step == expected.step);
      if (end.status != solved) CHECK(end.fraction == Approx(expected.share).epsilon(1e-10));
      if (end.status != solved) CHECK(end.has_equilibrium == (end.status != mechanism));
      CHECK(end.pairs.empty() == (end.status != mechanism || expected.share == 0.0));
      REQUIRE(seen.steps.size() == static_cast<std::size_t>(expected.step));
      CHECK(seen.steps.back().fraction == end.fraction);
      for (const auto& [step, dof, value, margin] : expected.u) {
        INFO("step " << step << ", dof " << dof);
        CHECK(seen.steps[step - 1].u[dof] == Approx(value).epsilon(1e-12).margin(margin));
      }
      for (std::size_t i = 0; i < expected.shares.size(); ++i)
        CHECK(seen.increments.at(i).fraction == Approx(expected.shares[i]).epsilon(1e-12));
      if (expected.statuses == nullptr) continue;  // rounding decides about a tie
      CHECK(statuses_of(seen.steps.back().isep) == expected.statuses);
      CHECK(words_of(seen.events()) == expected.events);
    }
  }
  const recorder pb1 = path_of(cantilever_over_a_stop(), "fortran").seen;
  CHECK(pb1.increments.size() == 6);
  CHECK(pb1.increments[1].s == Approx(0.1).epsilon(1e-13));
  CHECK(pb1.text.find("BREAKING CONTACT") != std::string::npos);
}

TEST_CASE("a pair at a fixed dof does not change the path") {
  beam_problem p = cantilever_over_a_stop();
  const recorder without = path_of(p, "fortran").seen;
  p.pairs.push_back({0, -1, -1.0, 1e9, false});
  const auto [end, with] = path_of(p, "fortran");
  CHECK(end.status == solved);
  for (std::size_t i = 0; i < 4; ++i) CHECK(with.steps[i].u == without.steps[i].u);
}

TEST_CASE("at the end of a step, elastic forces and contact forces of a beam on springs balance the load") {
  beam_problem p = free_beam_on_springs(6.0, 24, 1.0, 4.0);
  p.steps = {tip_load(10, -1), {{{12, 0, -2.0}, {20, 0, -0.2}}, {}}};
  const auto [end, seen] = path_of(p, "fortran");
  REQUIRE(end.status == solved);
  const linear_structure s = p.structure();
  for (std::size_t step = 0; step < p.steps.size(); ++step) {
    const std::vector<double> f = nodal_loads(p.geometry, p.steps[step]).force;
    std::vector<double> ku = product(s.stiffness.band(), seen.steps[step].u);
    for (std::size_t i = 0; i < p.pairs.size(); ++i)
      if (seen.steps[step].isep[i] == in_contact)
        ku[2 * i] += p.pairs[i].stiffness * seen.steps[step].u[2 * i];
    for (std::size_t i = 0; i < f.size(); ++i) CHECK(ku[i] == Approx(f[i]).margin(1e-9));
  }
}

TEST_CASE("at the end of a step, a support has its prescribed settlement and the beam follows the support") {
  problem p;
  p.geometry = {even_beam(2.0, 2, 1e4)};
  p.supports = {{0, 0, true}, {2, 0, true}};
  p.steps = {{{}, {}, {{2, 0, -0.5}}}};
  const solved_path r = follow(p, structure_of(p), "refactor", *make_kernel("fortran"), {});
  REQUIRE(r.end.status == solved);
  CHECK(r.steps.at(0).displacement[4] == -0.5);
  CHECK(r.steps[0].displacement[2] == Approx(-0.25));
}

TEST_CASE("a free beam on a bed can be unloaded, so that all pairs separate, and loaded again") {
  // A force lifts the middle of the beam, or presses it so that other parts lift off. Then all load is
  // removed.
  for (const double force : {4.0, -50.0, -100.0}) {
    beam_problem p = free_beam_on_springs(20.0, 100, 1.0, 4.0);
    load pulled = uniform(-1);
    pulled.points = {{50, 0, force}};
    p.steps = {uniform(-1), pulled, uniform(0), uniform(-1), pulled};
    const auto [end, seen] = path_of(p, "fortran");
    INFO(force);
    CHECK(end.status == solved);
    REQUIRE(seen.steps.size() == 5);
    for (const double w : seen.steps[2].u) CHECK(std::abs(w) < 1e-6);
    CHECK(seen.steps[3].u[100] == Approx(seen.steps[0].u[100]).epsilon(1e-6));
    CHECK(seen.steps[4].u[100] == Approx(seen.steps[1].u[100]).epsilon(1e-8));
  }
}

TEST_CASE("a long span with a condition number above 1e13 is not reported as a mechanism") {
  const auto [end, seen] = path_of(
      {even_beam(3000.0, 3000, 1.0), {{0, 0, true}, {3000, 0, true}}, {}, {uniform(-1e-9)}}, "fortran");
  CHECK(end.status == solved);
  CHECK(seen.steps[0].rcond < 1e-13);
}

TEST_CASE("a cycle of statuses without progress ends the path, and the pairs of the cycle are reported") {
  // Toggles pairs 1 and 3 in turn without any progress.
  int calls = 0;
  made_kernel k([&calls](call<double>& c) {
    c.smin = 0.0;
    c.isep[calls++ % 2 == 0 ? 0 : 2] *= -1;
  });
  const beam_problem p = cantilever(
      {{2, -1, 0.0, 1.0, true}, {1, -1, 0.0, 1.0, true}, {1, 1, 0.0, 1.0, true}}, {tip_load(2, -10)});
  const path_end end = p.run(k, {}).end;
  CHECK(end.status == cycle);
  CHECK(end.pairs == std::vector<int>{0, 2});
  CHECK(calls < 50);
}

TEST_CASE("if a factorisation fails, the path ends with the share of the step that it reached") {
  const problem p = cantilever({{2, -1, -0.004, 5e4, false}}, {tip_load(2, -60)}).as_problem();
  const linear_structure s = structure_of(p);
  failing_engine engine(s, 2);
  const load_history total(p, s);
  const auto leader = make_kernel("cpp");
  path way(s, total, engine, *leader, {});
  const path_end end = way.follow(1);
  CHECK_FALSE(way.now());
  CHECK(end.status == not_factored);
  CHECK(end.step == 1);
  CHECK(end.fraction == Approx(0.25).epsilon(1e-12));  // the tip reaches its stop at -15 of -60
}

TEST_CASE("after a failed solve, the engine has the springs of the pairs in contact in the next step") {
  // The beam balances on pair 1. The spring of pair 2 is applied only to make the matrix regular.
  problem p = balanced_beam({tip_load(2, -2), tip_load(2, -4)}).as_problem();
  p.pairs[0] = {2, -1, 0.0, 50.0, true};
  const linear_structure s = structure_of(p);
  failing_engine engine(s, 1);
  const load_history total(p, s);
  const auto leader = make_kernel("corrected");
  path way(s, total, engine, *leader, {});
  CHECK(way.follow(1).status == not_factored);
  (void)way.go_on_from({.step = 1,
                        .fraction = 1.0,
                        .displacement = std::vector<double>(10),
                        .isep = {in_contact, in_contact},
                        .from = origin::reference});
  CHECK(way.follow(2).status == solved);
  CHECK(engine.responses >= 2);
  CHECK(engine.springs == std::vector<bool>{true, true});
}

TEST_CASE("the limit of increments increases with the number of pairs, and does not overflow") {
  CHECK(increments_allowed(0, 0) == 1000);
  CHECK(increments_allowed(0, 200) == 11000);
  CHECK(increments_allowed(0, 50'000'000) == most_increments);  // 2.5e9 exceeds an int
  CHECK(increments_allowed(7, 50'000'000) == 7);
}

TEST_CASE("slow progress does not count as a cycle, and the path ends at the limit of increments") {
  made_kernel k([](call<double>& c) {
    c.smin = 0.001;
    c.isep[0] = -c.isep[0];
  });
  const path_end end = cantilever_over_a_stop().run(k, {}, 300).end;
  CHECK(end.status == iteration_limit);
  CHECK(end.pairs == std::vector<int>{0});
  CHECK(end.fraction == Approx(1 - std::pow(0.999, 300)).epsilon(1e-12));
}

TEST_CASE("loads beyond the range of doubles end the path, and no reported state has an infinite number") {
  beam_problem p = cantilever_over_a_stop();
  p.steps = {tip_load(2, -1e308), tip_load(2, 1e308)};
  for (const bool with_pairs : {true, false}) {
    if (!with_pairs) p.pairs.clear();
    const auto [end, seen] = path_of(p, "fortran");
    CHECK(end.status == not_factored);
    for (const auto& step : seen.steps)
      for (const double x : step.u) CHECK(std::isfinite(x));
  }
}
