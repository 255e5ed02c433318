// Tests the reference solution against closed forms and exact paths.
#include "contct/certify/reference_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/solve/factored_stiffness.hpp"
#include "support/beams.hpp"
#include "support/tried_problem.hpp"

using namespace contct;
using outcome = reference_answer::outcome;

namespace {

/// Returns the exact final states of a path's steps.
std::vector<exact_step_end> exact_ends(const problem& p) {
  return follow_corrected_path(exact_problem_of(p)).steps;
}

std::vector<double> forces_of(const model& m, const load& l) {
  std::vector<double> f(dofs(m));
  add_consistent_loads(m, l, f);
  return f;
}

load even_load(double q) {
  return {{}, {{{q}, {}}}};
}

std::vector<double> forces_of(const beam& b, const load& l) {
  return forces_of(model{b}, l);
}

long double extended(const rational& x) {
  return rounded(x);
}
long double extended(long double x) {
  return x;
}

/// The largest deflection, and the largest difference between two states' deflections.
struct comparison {
  std::size_t stride = 2;  // dofs of a node
  long double size = 0.0L;
  long double off = 0.0L;

  template <class Other>
  void take(const std::vector<double>& u, const Other& other) {
    for (std::size_t dof = 0; dof < u.size(); dof += stride) {
      const long double mine = u[dof];
      const long double yours = extended(other[dof]);
      size = std::max({size, std::abs(mine), std::abs(yours)});
      off = std::max(off, std::abs(mine - yours));
    }
  }
  [[nodiscard]] double relative() const { return off == 0 ? 0.0 : static_cast<double>(off / size); }
};

/// Returns the allowed relative error in the middle of a span of unit elements with EI = 1 after refinement.
/// The residual of each row is rounded in long double by at most eps/2 * 48 |u|, which acts like a force and
/// moves the middle by at most force times `compliance`. The n roundings have random signs, so that their sum
/// is about sqrt(n) times one rounding.
double rounded_residuals(int elements, double compliance) {
  constexpr auto rounding = static_cast<double>(std::numeric_limits<long double>::epsilon() / 2);
  return std::sqrt(elements) * 48 * compliance * rounding;
}

}  // namespace

TEST_CASE(
    "the reference solution equals the hand calculation of a cantilever over a stop (PB1) at each of four "
    "steps") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  reference_solver o(s);
  const double f = 8.0 / 3 / 1e4;
  const auto pressed = [&](double load) { return (load * f - 0.004) / (f + 1 / 5e4); };
  const double tips[] = {-10 * f, -0.004 - pressed(60) / 5e4, -0.004 - pressed(30) / 5e4, 20 * f};
  const char presses[] = {0, 1, 1, 0};
  for (std::size_t step = 0; step < 4; ++step) {
    const reference_answer a = o.solve(forces_of(p.geometry, p.steps[step]));
    CHECK(a.how == outcome::found);
    CHECK(a.unique);
    CHECK(a.displacement[4] == Approx(tips[step]).epsilon(1e-14));
    CHECK(a.pressed[0] == presses[step]);
  }
}

TEST_CASE(
    "the reference solution finds the exact equilibria of thousands of beams with and without supports") {
  std::map<std::string_view, int> of_layout;
  int two_sided_pressed = 0;
  int several_pressed = 0;
  double worst = 0.0;
  int compared = 0;
  for (std::uint64_t number = 0; number < 2500; ++number) {
    const random_problem p = make_random_problem(11, number, {.plate_share = 0.0, .most_elements = 4});
    const std::vector<exact_step_end> ends = exact_ends(p);
    const linear_structure s = build(p.geometry, p.supports, p.pairs);
    reference_solver o(s);
    comparison c;  // over all steps, because an unloaded state has no largest deflection
    for (std::size_t step = 0; step < ends.size(); ++step) {
      if (ends[step].fraction != 1) continue;
      const reference_answer a = o.solve(forces_of(p.geometry, p.steps[step]));
      INFO(number);
      REQUIRE(a.how == outcome::found);
      if (!a.unique) continue;
      c.take(a.displacement, ends[step].displacement);
      ++compared;
      const auto pressed = std::count(a.pressed.begin(), a.pressed.end(), char{1});
      several_pressed += pressed > 1 ? 1 : 0;
      two_sided_pressed += p.layout == face_layout::two_sided && pressed > 0 ? 1 : 0;
      ++of_layout[name_of(p.layout)];
    }
    worst = std::max(worst, c.relative());
  }
  INFO("worst " << worst << ", compared " << compared << ", several pressed " << several_pressed
                << ", two-sided and pressed " << two_sided_pressed);
  CHECK(worst < 1e-10);
  CHECK(compared > 5000);
  CHECK(several_pressed > 1000);
  CHECK(two_sided_pressed > 500);
  for (const auto& [layout, times] : of_layout) CHECK(times > 500);
  CHECK(of_layout.size() == face_layouts);
}

TEST_CASE("the reference solution finds the correct state even if the active-set iteration cycles") {
  // A cantilever between stops. The active set goes from no pair to pairs 2 and 3, to 3 and 4 and back to no
  // pair; the correct active set is pair 3 alone. No pair is near a tie: every pair is at least 0.08 from its
  // face.
  const beam_problem p{even_beam(3.0, 3, 1.0),
                       {{0, 0, true}, {0, 1, true}},
                       {{1, face_below, -3.0, 1e4, false},
                        {1, face_above, 9.0, 1e3, false},
                        {2, face_above, 1.0, 1e2, false},
                        {3, face_below, -8.0, 1e2, false}},
                       {{{{1, 0, 19.0}, {2, 0, 1.0}, {3, 0, 4.0}}, {}}}};
  const linear_structure s = p.structure();
  reference_solver solver(s);
  const reference_answer a = solver.solve(forces_of(p.geometry, p.steps[0]));
  CHECK(a.how == outcome::found);
  CHECK(a.pressed == std::vector<char>{0, 0, 1, 0});
  CHECK(solver.factorisations() < 10);
  const exact_step_end truth = exact_ends(p.as_problem()).back();
  CHECK(truth.closed == a.pressed);
  for (std::size_t dof = 0; dof < a.displacement.size(); ++dof)
    CHECK(a.displacement[dof] == Approx(rounded(truth.displacement[dof])).epsilon(1e-14));
}

TEST_CASE(
    "the reference solution finds no equilibrium of a free beam that its load lifts or tips off the faces") {
  beam_problem p = free_beam_on_springs(4.0, 4, 10.0, 1.0);
  const linear_structure s = p.structure();
  for (const load& l : {even_load(1.0), load{{{0, 0, -1.0}, {2, 0, 2.0}}, {}}, load{{{2, 1, 1.0}}, {}}}) {
    const std::vector<double> f = forces_of(p.geometry, l);
    CHECK(reference_solver(s).solve(f).how == outcome::none_seen);  // rounded loads prove nothing
    const reference_answer a = reference_solver(s).solve(f, s.truth->work_of(l));
    CHECK(a.how == outcome::no_equilibrium);
    CHECK_FALSE(a.unique);
  }
}

TEST_CASE(
    "the reference solution finds the equilibrium of a load even if the load before it had no equilibrium") {
  const beam_problem p = free_beam_on_springs(4.0, 4, 10.0, 1.0);
  const linear_structure s = p.structure();
  reference_solver o(s);
  CHECK(o.solve(forces_of(p.geometry, even_load(1.0))).how == outcome::none_seen);
  const reference_answer after = o.solve(forces_of(p.geometry, even_load(-1.0)));
  const reference_answer alone = reference_solver(s).solve(forces_of(p.geometry, even_load(-1.0)));
  CHECK(after.how == outcome::found);
  CHECK(after.unique);
  for (std::size_t dof = 0; dof < after.displacement.size(); ++dof)
    CHECK(after.displacement[dof] == Approx(alone.displacement[dof]).epsilon(1e-14).margin(1e-16));
}

TEST_CASE(
    "the reference solution finds the equilibrium of a beam balanced on one pair, and marks it as not "
    "unique") {
  beam_problem p{even_beam(4.0, 4, 1e3), {}, {{2, face_below, -0.1, 50.0, false}}, {}};
  const linear_structure s = p.structure();
  const reference_answer a = reference_solver(s).solve(forces_of(p.geometry, even_load(-2.0)));
  CHECK(a.how == outcome::found);
  CHECK_FALSE(a.unique);
  CHECK(a.displacement[4] == Approx(-0.1 - 8.0 / 50).epsilon(1e-13));
  // A small moment rotates the beam without limit.
  std::vector<double> f = forces_of(p.geometry, even_load(-2.0));
  f[6] -= 1e-6;
  CHECK(reference_solver(s).solve(f).how == outcome::none_seen);
}

TEST_CASE(
    "the reference solution of an unloaded structure is unique exactly if supports hold the structure") {
  beam_problem p = free_beam_on_springs(4.0, 4, 10.0, 1.0);
  const std::vector<double> nothing(10, 0.0);
  const linear_structure free = p.structure();
  reference_solver o(free);
  const reference_answer at_once = o.solve(nothing);
  CHECK(at_once.how == outcome::found);
  CHECK_FALSE(at_once.unique);
  CHECK(at_once.displacement == nothing);
  REQUIRE(o.solve(forces_of(p.geometry, even_load(-1.0))).unique);
  const reference_answer unloaded = o.solve(nothing);
  CHECK(unloaded.how == outcome::found);
  CHECK_FALSE(unloaded.unique);
  for (const double w : unloaded.displacement) CHECK(std::abs(w) < 1e-15);

  p.supports = {{0, 0, true}, {4, 0, true}};
  const linear_structure held = p.structure();
  const reference_answer a = reference_solver(held).solve(nothing);
  CHECK(a.unique);
  CHECK(a.displacement == nothing);
}

TEST_CASE(
    "the reference solution of a long simply supported span is exact except for the rounding of residuals") {
  // With elements of length 1 and loads of 6 and 1, matrix and load are exact in doubles.
  for (const int elements : {100, 400, 1000}) {
    const beam_problem p{even_beam(elements, elements, 1.0), {{0, 0, true}, {elements, 0, true}}, {}, {}};
    const linear_structure s = p.structure();
    const std::vector<double> f = forces_of(p.geometry, even_load(-12.0));
    const reference_answer a = reference_solver(s).solve(f);
    REQUIRE(a.how == outcome::found);
    CHECK(a.unique);

    comparison refined;
    std::vector<long double> exact(f.size());
    for (int i = 0; i <= elements; ++i) {
      const auto x = static_cast<long double>(i);
      const long double l = elements;
      exact[std::size_t{2} * i] = -x * (l - x) * (l * l + l * x - x * x) / 2;
    }
    refined.take(a.displacement, exact);
    INFO(elements << ": " << refined.relative());
    CHECK(refined.relative() < rounded_residuals(elements, std::pow(elements, 3) / 48));
  }
}

TEST_CASE(
    "the reference solution does not depend on loads that were solved before, even if these were much "
    "larger") {
  double worst = 0.0;
  int compared = 0;
  for (std::uint64_t number = 0; number < 500; ++number) {
    const random_problem p = make_random_problem(7, number);
    const linear_structure s = build(p.geometry, p.supports, p.pairs);
    const std::vector<double> before = forces_of(p.geometry, p.steps[0]);
    for (const double ratio : {-1.0, 1e-6, 1e-15}) {
      std::vector<double> f = before;
      for (double& force : f) force *= ratio;
      reference_solver warm(s);
      if (warm.solve(before).how != outcome::found) continue;
      const reference_answer a = warm.solve(f);
      const reference_answer alone = reference_solver(s).solve(f);
      INFO(number << ", " << ratio);
      REQUIRE(a.how == alone.how);
      if (a.how != outcome::found || !alone.unique) continue;
      comparison c{static_cast<std::size_t>(s.dofs_per_node)};
      c.take(a.displacement, alone.displacement);
      worst = std::max(worst, c.relative());
      ++compared;
    }
  }
  INFO("worst " << worst << ", compared " << compared);
  CHECK(worst < 1e-10);
  CHECK(compared > 1200);
}

TEST_CASE(
    "for a load with a NaN or infinite number, the reference solution gives no state, and does not decide "
    "whether an equilibrium exists") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  reference_solver o(s);
  std::vector<double> f(6, 0.0);
  f[4] = std::numeric_limits<double>::infinity();
  CHECK(o.solve(f).how == outcome::not_found);
  f[4] = -10.0;  // a finite load is still solved
  const reference_answer after = o.solve(f);
  CHECK(after.how == outcome::found);
  CHECK(after.displacement[4] == Approx(-10 * 8.0 / 3 / 1e4).epsilon(1e-14));
}

TEST_CASE(
    "the condition number of a reference solution is that of the stiffness with the pairs in contact, and "
    "needs no new factor") {
  const beam_problem p{
      even_beam(2.0, 2, 1.0), {{0, 0, true}, {0, 1, true}}, {{2, face_above, 1.0, 10.0, false}}, {}};
  const linear_structure s = p.structure();
  factored_stiffness anew(s);
  reference_solver solver(s);
  for (const double load : {4.0, 0.1}) {  // with and without contact
    const reference_answer a = solver.solve(std::vector<double>{0, 0, 0, 0, load, 0});
    REQUIRE(a.pressed[0] == (load > 1 ? 1 : 0));
    const int so_far = solver.factorisations();
    CHECK(solver.reciprocal_condition() == Approx(anew.reciprocal_condition(a.pressed)).epsilon(1e-12));
    CHECK(solver.factorisations() == so_far);
  }
}
