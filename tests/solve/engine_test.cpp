// Tests every engine against the engine refactor: the same responses through hundreds of toggles, and the
// same events and final states on whole paths, with springs over eight decades.
#include "contct/solve/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/model/problem.hpp"
#include "contct/number/random.hpp"
#include "contct/path/path.hpp"
#include "contct/solve/spring_engine.hpp"
#include "support/beams.hpp"
#include "support/tried_problem.hpp"

using namespace contct;

namespace {

/// Returns the kind of random problems with supports and moderate condition numbers. The allowed difference
/// grows with the condition number.
random_problem_kind held_problems(double plates) {
  random_problem_kind kind;
  kind.least_unit = 1e-3;
  kind.most_unit = 1e3;
  kind.free_share = 0.0;
  kind.plate_share = plates;
  return kind;
}

std::vector<double> load_of(const random_problem& p, const linear_structure& s) {
  std::vector<double> f(static_cast<std::size_t>(s.dofs()));
  add_consistent_loads(p.geometry, p.steps[0], f);
  return f;
}

/// Returns the largest difference between two responses relative to `size`, the largest deflection of any
/// node, since the responses at the pairs may be only rounding.
double difference(const std::vector<double>& a, const std::vector<double>& b, double size) {
  double off = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) off = std::max(off, std::abs(a[i] - b[i]));
  return size > 0.0 ? off / size : off;
}

double largest_deflection(const linear_structure& s, const std::vector<double>& u) {
  double size = 0.0;
  for (auto dof = static_cast<std::size_t>(s.deflection); dof < u.size();
       dof += static_cast<std::size_t>(s.dofs_per_node))
    size = std::max(size, std::abs(u[dof]));
  return size;
}

/// Returns the allowed difference between two answers, each of which may have the certificate's error of 1024
/// eps / rcond.
double allowed(stiffness_engine& e) {
  return std::max(1e-10, 2 * 1024 * std::numeric_limits<double>::epsilon() / e.reciprocal_condition());
}

struct toggled {
  int responses = 0;
  int toggles = 0;
  double worst = 0.0;  // relative to the allowed difference
};

/// Toggles one of the first `choices` pairs `toggles` times, and compares every response with that of
/// refactor.
toggled toggle_back_and_forth(const random_problem& p, const std::string& engine, int toggles, int choices,
                              random_numbers& random) {
  toggled t;
  const linear_structure s = build(p.geometry, p.supports, p.pairs);
  if (engine == "condensed" && !can_be_condensed(s)) return t;
  const auto reference = make_engine("refactor", s);
  const auto tried = make_engine(engine, s);
  const std::vector<double> f = load_of(p, s);
  std::vector<char> closed;
  for (const contact_pair& pair : s.pairs) closed.push_back(pair.closed ? 1 : 0);
  std::vector<double> a(s.pairs.size());
  std::vector<double> b(s.pairs.size());
  std::vector<double> u(f.size());
  std::vector<double> v(f.size());
  const std::vector<double> no_forces(s.pairs.size());
  const int most = std::min(choices, static_cast<int>(s.pairs.size()));
  for (int k = 0; k < toggles; ++k) {
    const auto pair = static_cast<std::size_t>(random.whole(0, most - 1));
    closed[pair] = closed[pair] != 0 ? 0 : 1;
    for (stiffness_engine* e : {reference.get(), tried.get()})
      e->switch_spring(static_cast<int>(pair), closed[pair] != 0);
    ++t.toggles;
    reference->respond({f, 1.0, 1}, a);
    tried->respond({f, 1.0, 1}, b);
    ++t.responses;
    reference->recover(f, no_forces, u);
    t.worst = std::max(t.worst, difference(a, b, largest_deflection(s, u)) / allowed(*reference));
  }
  tried->recover(f, no_forces, v);
  t.worst = std::max(t.worst, difference(u, v, largest_deflection(s, u)) / allowed(*reference));
  return t;
}

}  // namespace

TEST_CASE(
    "while pairs toggle hundreds of times, every engine gives the same response as the engine refactor") {
  for (const std::string& engine : engine_names()) {
    if (engine == "refactor") continue;
    random_numbers random(5);
    toggled all;
    for (std::uint64_t number = 1; number <= 40; ++number) {
      const random_problem p =
          make_random_problem(11, number, held_problems(engine == "condensed" ? 0.0 : 0.5));
      const toggled t = toggle_back_and_forth(p, engine, 300, number % 2 == 0 ? 3 : 1000, random);
      INFO(engine << ", problem " << number);
      CHECK(t.worst <= 1.0);
      all.responses += t.responses;
      all.toggles += t.toggles;
    }
    CHECK(all.responses >= 10'000);
  }
}

TEST_CASE("the corrected kernel's paths of structures with supports are certified with every engine") {
  for (const std::string& engine : engine_names()) {
    const auto kernel = make_kernel("corrected");
    int certified = 0;
    path_counts counted;
    random_problem_kind kind;  // any unit, and springs over eight decades
    kind.free_share = 0.0;
    kind.plate_share = engine == "condensed" ? 0.0 : 0.25;
    for (std::uint64_t number = 1; number <= 150; ++number) {
      const random_problem p = make_random_problem(2026, number, kind);
      const linear_structure s = build(p.geometry, p.supports, p.pairs);
      if (engine == "condensed" && !can_be_condensed(s)) continue;
      const problem_result t = try_structure(p, s, *kernel, engine, {&counted});
      INFO(engine << ", problem " << number << ": " << name_of(t.came_to) << ", needs " << needed_by(t));
      CHECK(t.came_to == verdict::certified);
      ++certified;
    }
    CHECK(certified >= 140);
    CHECK(counted.makes >= 300);
    CHECK(counted.breaks >= 150);
  }
}

TEST_CASE("a structure without supports ends in the same state with every engine") {
  random_problem_kind kind;
  kind.free_share = 1.0;
  int same = 0;
  for (std::uint64_t number = 1; number <= 100; ++number) {
    const random_problem p = make_random_problem(77, number, kind);
    const auto kernel = make_kernel("corrected");
    const verdict reference = try_problem(p, *kernel, "refactor").came_to;
    for (const std::string& engine : engine_names()) {
      if (engine == "condensed" && !can_be_condensed(build(p.geometry, p.supports, p.pairs))) continue;
      INFO(engine << ", problem " << number);
      CHECK(try_problem(p, *kernel, engine).came_to == reference);
      ++same;
    }
  }
  CHECK(same >= 250);
}

TEST_CASE("an engine is made by its name, and the message about an unknown name lists the known names") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  for (const std::string& name : engine_names()) CHECK(make_engine(name, s) != nullptr);
  CHECK_THROWS_WITH(make_engine("warp", s), Catch::Matchers::Contains("refactor"));
}

TEST_CASE(
    "the response is proportional to the residual load, and depends on the springs of pairs in contact") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  const auto engine = make_engine("refactor", s);
  std::vector<double> increment(6, 0.0);
  increment[4] = 1.0;
  std::vector<double> d_star(1);
  const double f = 8.0 / 3 / 1e4;
  engine->respond({increment, 1.0}, d_star);
  CHECK(d_star[0] == Approx(f).epsilon(1e-13));
  engine->respond({increment, 0.25}, d_star);
  CHECK(d_star[0] == Approx(f / 4).epsilon(1e-13));
  engine->switch_spring(0, true);
  engine->respond({increment, 1.0}, d_star);
  CHECK(d_star[0] == Approx(1 / (1 / f + 5e4)).epsilon(1e-13));
  engine->switch_spring(0, false);
  engine->respond({increment, 1.0}, d_star);
  CHECK(d_star[0] == Approx(f).epsilon(1e-13));
}

TEST_CASE("an engine computes the displacements of all dofs from the load and the contact forces") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  const auto engine = make_engine("refactor", s);
  std::vector<double> u(6);
  engine->recover(std::vector<double>{7, 7, 0, 0, -2, 0}, std::vector<double>{1.0}, u);
  const double f = 8.0 / 3 / 1e4;
  CHECK(u[4] == Approx(-f).epsilon(1e-13));
  CHECK(u[0] == 0.0);  // the support has the load of a fixed dof
  CHECK(u[1] == 0.0);
}

TEST_CASE("the internal numbering of a plate does not affect which dofs supports, pairs and forces have") {
  // The same plate in two orientations: 5 by 2 elements, whose rows are numbered along y, and 2 by 5
  // elements.
  const plate lying{{0, 1, 2, 3, 4, 5}, {0, 0.5, 1.5}, 2.0, 0.3};
  const plate standing{lying.y, lying.x, lying.D, lying.nu};
  const auto place = [&](const plate& p, int i, int j) {
    return &p == &lying ? p.node_at(i, j) : p.node_at(j, i);
  };
  std::vector<std::vector<double>> answers;
  for (const plate* p : {&lying, &standing}) {
    const int along = p == &lying ? 1 : 2;  // the slope along the long side
    const std::vector<support> supports = {{place(*p, 0, 0), 0, true},
                                           {place(*p, 0, 2), 0, true},
                                           {place(*p, 0, 1), along, true},
                                           {place(*p, 5, 0), 0, false, 3.0}};
    const linear_structure s =
        build(*p, supports, {{place(*p, 5, 2), -1, 0.0, 2.0, false}, {place(*p, 2, 1), -1, 0.0, 5.0, true}});
    CHECK(s.rows.empty() == (p == &standing));
    CHECK(s.stiffness.band().subdiagonals() == 14);
    const auto engine = make_engine("refactor", s);
    engine->switch_spring(0, true);
    std::vector<double> increment(static_cast<std::size_t>(p->dofs()), 0.0);
    increment[static_cast<std::size_t>(3 * place(*p, 3, 2))] = -1.0;
    increment[static_cast<std::size_t>(3 * place(*p, 4, 0) + along)] = 0.5;
    std::vector<double> d_star(2);
    std::vector<double> u(increment.size());
    engine->respond({increment, 1.0}, d_star);
    engine->recover(increment, std::vector<double>{0.25, -0.125}, u);
    std::vector<double> answer = d_star;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 3; ++j) {
        const auto at = static_cast<std::size_t>(3 * place(*p, i, j));
        answer.insert(answer.end(), {u[at], u[at + static_cast<std::size_t>(along)]});
      }
    }
    CHECK(u[static_cast<std::size_t>(3 * place(*p, 0, 2))] == 0.0);
    answers.push_back(answer);
  }
  for (std::size_t i = 0; i < answers[0].size(); ++i)
    CHECK(answers[0][i] == Approx(answers[1][i]).epsilon(1e-10).margin(1e-13));
}
