// Tests paths that do not reach their end: mechanisms, cycles and limits.
#include <cmath>
#include <functional>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "support/beams.hpp"
#include "support/made_kernel.hpp"

using namespace contct;

TEST_CASE(
    "a path that ends in a mechanism reports the pair whose separation caused it, and the share of the "
    "step") {
  // A beam on two springs. An additional force beyond the second spring lifts the beam off the first.
  beam_problem p{even_beam(4.0, 4, 100.0), {}, {{1, -1, 0.0, 10.0, true}, {3, -1, 0.0, 10.0, true}}, {}};
  p.steps = {{{{2, 0, -4.0}}, {}}, {{{2, 0, -4.0}, {4, 0, -6.0}}, {}}};
  recorder r;
  const path_end end = p.run("fortran", {&r});
  CHECK(end.status == path_status::mechanism);
  CHECK(end.step == 2);
  CHECK(end.pairs == std::vector<int>{0});
  // About pair 2 the moments are 4 * 1 = F * 1, so F = 4, a share of 2/3 of 6.
  CHECK(end.fraction == Approx(2.0 / 3).epsilon(1e-10));
  // In the final state the contact force of the first pair is 0.
  REQUIRE(r.steps.size() == 2);
  CHECK(r.steps[1].fraction == end.fraction);
  CHECK(r.steps[1].u[2] == Approx(0.0).margin(1e-12));
  CHECK(r.steps[1].u[6] == Approx(-0.8).epsilon(1e-9));
  CHECK(r.steps[1].isep == std::vector<int>{separated, in_contact});
}

TEST_CASE("a free beam on a bed can be unloaded, so that all pairs separate, and loaded again") {
  // A force lifts the middle of the beam, or presses it so that other parts lift off. Then all load is
  // removed.
  for (const double force : {4.0, -50.0, -100.0}) {
    beam_problem p = free_beam_on_springs(20.0, 100, 1.0, 4.0);
    const load heavy{{}, {{{-1.0}, {}}}};
    load pulled = heavy;
    pulled.points = {{50, 0, force}};
    p.steps = {heavy, pulled, {{}, {{{0.0}, {}}}}, heavy, pulled};
    recorder r;
    const path_end end = p.run("fortran", {&r});
    INFO(force);
    CHECK(end.status == path_status::solved);
    REQUIRE(r.steps.size() == 5);
    for (const double w : r.steps[2].u) CHECK(std::abs(w) < 1e-6);
    CHECK(r.steps[3].u[100] == Approx(r.steps[0].u[100]).epsilon(1e-6));
    CHECK(r.steps[4].u[100] == Approx(r.steps[1].u[100]).epsilon(1e-8));
  }
}

TEST_CASE("a pair and a hinged support hold a beam, but a rotational spring alone does not") {
  beam_problem hinged{
      even_beam(2.0, 2, 10.0), {{0, 0, true}}, {{2, -1, 0.0, 5.0, true}}, {tip_load(1, -1.0)}};
  CHECK(hinged.run("fortran", {}).status == path_status::solved);
  beam_problem turning = hinged;
  turning.supports = {{0, 1, false, 3.0}};
  turning.pairs[0].closed = false;
  CHECK(turning.run("fortran", {}).status == path_status::path_ended);
}

TEST_CASE("a long span with a condition number above 1e13 is not reported as a mechanism") {
  beam_problem p{even_beam(3000.0, 3000, 1.0), {{0, 0, true}, {3000, 0, true}}, {}, {{{}, {{{-1e-9}, {}}}}}};
  recorder r;
  CHECK(p.run("fortran", {&r}).status == path_status::solved);
  CHECK(r.steps[0].rcond < 1e-13);
}

TEST_CASE("a cycle of statuses without progress ends the path, and the pairs of the cycle are reported") {
  // Toggles pairs 1 and 3 in turn without any progress.
  int calls = 0;
  made_kernel k([&calls](call<double>& c) {
    c.smin = 0.0;
    const std::size_t i = calls++ % 2 == 0 ? 0 : 2;
    c.isep[i] = -c.isep[i];
  });
  beam_problem p = cantilever_over_a_stop();
  p.pairs = {{2, -1, 0.0, 1.0, true}, {1, -1, 0.0, 1.0, true}, {1, 1, 0.0, 1.0, true}};
  const path_end end = p.run(k, {});
  CHECK(end.status == path_status::cycle);
  CHECK(end.pairs == std::vector<int>{0, 2});
  CHECK(calls < 50);
}

namespace {

/// The engine refactor, except that one response fails. It records which springs are applied.
class failing_engine final : public stiffness_engine {
 public:
  failing_engine(const linear_structure& s, int failing_response)
      : inner_(make_engine("refactor", s)), fails_at_(failing_response) {
    for (const contact_pair& p : s.pairs) springs.push_back(p.closed);
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

TEST_CASE("if a factorisation fails, the path ends with the share of the step that it reached") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  failing_engine engine(s, 2);
  const load_history total = [](int, std::span<double> f) { f[4] = -60.0; };
  const path_end end = follow_path(s, 1, total, engine, *make_kernel("cpp"), {});
  CHECK(end.status == path_status::not_factored);
  CHECK(end.step == 1);
  CHECK(end.fraction == Approx(0.25).epsilon(1e-12));  // the tip reaches its stop at -15 of -60
}

TEST_CASE("after a failed solve, the engine has the springs of the pairs in contact in the next step") {
  // The beam balances on pair 1. The spring of pair 2 is applied only to make the matrix regular.
  const beam_problem p{even_beam(4.0, 4, 1e3), {}, {{2, -1, 0.0, 50.0, true}, {0, -1, -9.0, 1e3, false}}, {}};
  const linear_structure s = p.structure();
  failing_engine engine(s, 1);
  const load_history total = [](int step, std::span<double> f) { f[4] = -2.0 * step; };
  const full_load_state both{std::vector<double>(10), {in_contact, in_contact}, {}, true};
  const path_limits limits{0, [&](int, const full_load_state*) { return found_end{both, true}; }};
  CHECK(follow_path(s, 2, total, engine, *make_kernel("corrected"), {}, limits).status ==
        path_status::solved);
  CHECK(engine.responses >= 2);
  CHECK(engine.springs == std::vector<bool>{true, true});
}

TEST_CASE("the limit of increments increases with the number of pairs, and does not overflow") {
  CHECK(increments_allowed({}, 0) == 1000);
  CHECK(increments_allowed({}, 200) == 11000);
  CHECK(increments_allowed({}, 50'000'000) == most_increments);  // 2.5e9 exceeds an int
  CHECK(increments_allowed({7}, 50'000'000) == 7);
}

TEST_CASE("slow progress does not count as a cycle, and the path ends at the limit of increments") {
  made_kernel k([](call<double>& c) {
    c.smin = 0.001;
    c.isep[0] = -c.isep[0];
  });
  beam_problem p = cantilever_over_a_stop();
  const path_end end = p.run(k, {}, {300, nullptr});
  CHECK(end.status == path_status::iteration_limit);
  CHECK(end.pairs == std::vector<int>{0});
  CHECK(end.fraction == Approx(1 - std::pow(0.999, 300)).epsilon(1e-12));
}

TEST_CASE("loads beyond the range of doubles end the path, and no reported state has an infinite number") {
  beam_problem p = cantilever_over_a_stop();
  p.steps = {tip_load(2, -1e308), tip_load(2, 1e308)};
  recorder r;
  const path_end end = p.run("fortran", {&r});
  CHECK(end.status == path_status::not_factored);
  p.pairs.clear();
  CHECK(p.run("fortran", {&r}).status == path_status::not_factored);
  for (const auto& step : r.steps) {
    for (const double x : step.u) CHECK(std::isfinite(x));
  }
}
