// Tests every engine against the engine refactor: the same responses through hundreds of toggles, and the
// same events and final states on whole paths, with springs over eight decades.
#include "contct/linear/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/linear/spring_engine.hpp"
#include "contct/number/random.hpp"
#include "support/beams.hpp"
#include "support/tried_problem.hpp"

using namespace contct;

namespace {

/// Returns the largest difference between two responses or displacements.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double off = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - b[i]));
  return off;
}

/// Toggles one of the first `choices` pairs `toggles` times and compares every response, and at the end all
/// displacements, with those of refactor. Returns the worst difference relative to the largest deflection and
/// to the allowed difference: each answer may have the certificate's error of 1024 eps / rcond.
double worst_after_toggles(const random_problem& p, const std::string& engine, int toggles, int choices,
                           random_numbers& random) {
  const linear_structure s = build(p.geometry, p.supports, p.pairs);
  const auto reference = make_engine("refactor", s), tried = make_engine(engine, s);
  const std::vector<double> f = nodal_loads(p.geometry, p.steps[0]).force;
  std::vector<double> a(s.pairs.size()), b(s.pairs.size()), u(f.size()), v(f.size());
  const std::vector<double> no_forces(s.pairs.size());
  std::vector<bool> closed;
  for (const pair_in<double>& pair : s.pairs) closed.push_back(pair.closed);
  double worst = 0.0;
  const auto compare = [&](const std::vector<double>& x, const std::vector<double>& y) {
    reference->recover(f, no_forces, u);
    double size = 0.0;
    for (std::size_t dof = 0; dof < u.size(); dof += s.dofs_per_node) size = std::max(size, std::abs(u[dof]));
    const double allowed =
        std::max(1e-10, 2048 * std::numeric_limits<double>::epsilon() / reference->reciprocal_condition());
    worst = std::max(worst, difference(x, y) / (size > 0.0 ? size : 1.0) / allowed);
  };
  for (int k = 0; k < toggles; ++k) {
    const int pair = random.whole(0, std::min(choices, static_cast<int>(s.pairs.size())) - 1);
    closed[pair] = !closed[pair];
    for (stiffness_engine* e : {reference.get(), tried.get()}) e->switch_spring(pair, closed[pair]);
    reference->respond({f, 1.0, 1}, a);
    tried->respond({f, 1.0, 1}, b);
    compare(a, b);
  }
  tried->recover(f, no_forces, v);
  compare(u, v);
  return worst;
}

bool can_use(const std::string& engine, const random_problem& p) {
  return engine != "condensed" || can_be_condensed(build(p.geometry, p.supports, p.pairs));
}

/// The flexibility at the tip of PB1.
constexpr double tip = 8.0 / 3 / 1e4;

}  // namespace

TEST_CASE("while pairs toggle hundreds of times, every engine gives the response of refactor") {
  for (const std::string& engine : engine_names()) {
    if (engine == "refactor") continue;
    // The allowed difference grows with the condition number, which is moderate here.
    random_problem_kind kind;
    kind.least_unit = 1e-3;
    kind.most_unit = 1e3;
    kind.free_share = 0.0;
    kind.plate_share = engine == "condensed" ? 0.0 : 0.5;
    random_numbers random(5);
    int compared = 0;
    for (std::uint64_t number = 1; number <= 20; ++number) {
      const random_problem p = make_random_problem(11, number, kind);
      if (!can_use(engine, p)) continue;
      INFO(engine << ", problem " << number);
      CHECK(worst_after_toggles(p, engine, 300, number % 2 == 0 ? 3 : 1000, random) <= 1.0);
      ++compared;
    }
    CHECK(compared >= 17);
  }
}

TEST_CASE("the corrected rule's paths of held structures are certified with every engine, without fallback") {
  for (const std::string& engine : engine_names()) {
    const auto kernel = make_kernel("corrected");
    const int problems = engine == "refactor" ? 400 : 60;
    int certified = 0;
    path_counts counted;
    std::map<face_layout, int> layouts;
    random_problem_kind kind;  // any unit, and springs over eight decades
    kind.free_share = 0.0;
    if (engine == "condensed") kind.plate_share = 0.0;
    for (int number = 1; number <= problems; ++number) {
      const random_problem p = make_random_problem(2026, number, kind);
      if (!can_use(engine, p)) continue;
      const problem_result t =
          try_structure(p, build(p.geometry, p.supports, p.pairs), *kernel, engine, {&counted});
      INFO(engine << ", problem " << number << ", " << name_of(p.layout) << ": " << name_of(t.came_to)
                  << ", needs " << needed_by(t));
      CHECK(t.came_to == verdict::certified);
      CHECK(std::ranges::count(t.followed.steps, origin::reference, &solved_step::from) == 0);
      ++certified;
      ++layouts[p.layout];
    }
    CHECK(certified >= problems * 9 / 10);
    CHECK(counted.makes >= 2 * problems);
    CHECK(counted.breaks >= problems);
    CHECK(counted.at_rest >= problems / 2);
    CHECK(counted.snaps == 0);
    CHECK(layouts.size() == face_layouts);
  }
}

TEST_CASE("a structure without supports ends in the same state with every engine") {
  random_problem_kind kind;
  kind.free_share = 1.0;
  int same = 0;
  const auto kernel = make_kernel("corrected");
  for (std::uint64_t number = 1; number <= 60; ++number) {
    const random_problem p = make_random_problem(77, number, kind);
    const verdict reference = try_problem(p, *kernel, "refactor").came_to;
    for (const std::string& engine : engine_names()) {
      if (!can_use(engine, p)) continue;
      INFO(engine << ", problem " << number);
      CHECK(try_problem(p, *kernel, engine).came_to == reference);
      ++same;
    }
  }
  CHECK(same >= 150);
}

TEST_CASE("an engine is made by its name, and the message about an unknown name lists the known names") {
  const linear_structure s = cantilever_over_a_stop().structure();
  for (const std::string& name : engine_names()) CHECK(make_engine(name, s) != nullptr);
  CHECK_THROWS_WITH(make_engine("warp", s), Contains("refactor"));
}

TEST_CASE("the response is proportional to the load, and depends on the springs of pairs in contact") {
  const linear_structure s = cantilever_over_a_stop().structure();
  const auto engine = make_engine("refactor", s);
  const std::vector<double> increment = {0, 0, 0, 0, 1, 0};
  std::vector<double> d_star(1);
  for (const auto& [closed, share, expected] : {std::tuple(false, 1.0, tip),
                                                {false, 0.25, tip / 4},
                                                {true, 1.0, 1 / (1 / tip + 5e4)},
                                                {false, 1.0, tip}}) {
    engine->switch_spring(0, closed);
    engine->respond({increment, share}, d_star);
    CHECK(d_star[0] == Approx(expected).epsilon(1e-13));
  }
}

TEST_CASE("an engine computes the displacements of all dofs from the load and the contact forces") {
  const linear_structure s = cantilever_over_a_stop().structure();
  std::vector<double> u(6);
  make_engine("refactor", s)->recover(std::vector<double>{7, 7, 0, 0, -2, 0}, std::vector<double>{1.0}, u);
  CHECK(u[4] == Approx(-tip).epsilon(1e-13));
  CHECK(u[0] == 0.0);  // the support has the load of a fixed dof
  CHECK(u[1] == 0.0);
}

TEST_CASE("the internal numbering of a plate does not affect which dofs supports, pairs and forces have") {
  // The same plate in two orientations: 5 by 2 elements, whose rows are numbered along y, and 2 by 5
  // elements.
  const plate lying{{0, 1, 2, 3, 4, 5}, {0, 0.5, 1.5}, 2.0, 0.3};
  const plate standing{lying.y, lying.x, lying.D, lying.nu};
  std::vector<std::vector<double>> answers;
  for (const plate* p : {&lying, &standing}) {
    const auto place = [&](int i, int j) { return p == &lying ? p->node_at(i, j) : p->node_at(j, i); };
    const int along = p == &lying ? 1 : 2;  // the slope along the long side
    const std::vector<support> supports = {{place(0, 0), 0, true},
                                           {place(0, 2), 0, true},
                                           {place(0, 1), along, true},
                                           {place(5, 0), 0, false, 3.0}};
    const linear_structure s =
        build(*p, supports, {{place(5, 2), -1, 0.0, 2.0, false}, {place(2, 1), -1, 0.0, 5.0, true}});
    CHECK(s.rows.empty() == (p == &standing));
    CHECK(s.stiffness.band().subdiagonals() == 14);
    const auto engine = make_engine("refactor", s);
    engine->switch_spring(0, true);
    std::vector<double> increment(p->dofs()), answer(2), u(increment.size());
    increment[std::size_t{3} * place(3, 2)] = -1.0;
    increment[3 * place(4, 0) + along] = 0.5;
    engine->respond({increment, 1.0}, answer);
    engine->recover(increment, std::vector<double>{0.25, -0.125}, u);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 3; ++j)
        answer.insert(answer.end(),
                      {u[std::size_t{3} * place(i, j)], u[std::size_t{3} * place(i, j) + along]});
    CHECK(u[std::size_t{3} * place(0, 2)] == 0.0);
    answers.push_back(answer);
  }
  for (std::size_t i = 0; i < answers[0].size(); ++i)
    CHECK(answers[0][i] == Approx(answers[1][i]).epsilon(1e-10).margin(1e-13));
}
