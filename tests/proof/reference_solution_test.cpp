// Tests the reference solution against closed forms and exact paths.
#include "contct/proof/reference_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/linear/factored_stiffness.hpp"
#include "contct/results/random_problem.hpp"
#include "support/beams.hpp"
#include "support/tried_problem.hpp"

using namespace contct;
using enum path_status;

namespace {

/// Returns the exact final states of a path's steps.
std::vector<exact_step_end> exact_ends(const problem& p) {
  return follow_corrected_path(exact_problem_of(p)).steps;
}

load even_load(double q) {
  return {{}, {{{q}, {}}}};
}

/// The largest deflection, and the largest difference between two states' deflections.
struct comparison {
  std::size_t stride = 2;  // dofs of a node
  double size = 0.0;
  double off = 0.0;

  void take(const std::vector<double>& u, const std::vector<double>& other) {
    for (std::size_t dof = 0; dof < u.size(); dof += stride) {
      size = std::max({size, std::abs(u[dof]), std::abs(other[dof])});
      off = std::max(off, std::abs(u[dof] - other[dof]));
    }
  }
  [[nodiscard]] double relative() const { return off == 0.0 ? 0.0 : off / size; }
};

/// Returns true if the supports and the pairs whose force exceeds rounding hold the structure. Otherwise
/// other displacements are equilibria too.
bool is_unique(const linear_structure& s, const solved_step& a) {
  const auto force = [&](std::size_t i) {
    return force_of(s.pairs[i], s.pairs[i].seen_in(a.displacement), true);
  };
  double largest = 0.0;
  for (std::size_t i = 0; i < s.pairs.size(); ++i) largest = std::max(largest, force(i));
  return s.is_held(s.held_by([&](std::size_t i) { return force(i) > 1e-9 * largest; }));
}

std::vector<double> rounded_all(const rational_vector& exact) {
  std::vector<double> all;
  for (const rational& x : exact) all.push_back(rounded(x));
  return all;
}

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
  const std::pair<double, int> tips[] = {{-10 * f, separated},
                                         {-0.004 - pressed(60) / 5e4, in_contact},
                                         {-0.004 - pressed(30) / 5e4, in_contact},
                                         {20 * f, separated}};
  for (std::size_t step = 0; step < 4; ++step) {
    const solved_step a = o.solve(nodal_loads(p.geometry, p.steps[step]).force);
    CHECK(a.status == solved);
    CHECK(a.displacement[4] == Approx(tips[step].first).epsilon(1e-14));
    CHECK(a.isep[0] == tips[step].second);
  }
  std::vector<double> infinite(6, 0.0);
  infinite[4] = std::numeric_limits<double>::infinity();
  CHECK(o.solve(infinite).status == not_factored);  // does not decide whether an equilibrium exists
  CHECK(o.solve(nodal_loads(p.geometry, p.steps[0]).force).displacement[4] ==
        Approx(tips[0].first).epsilon(1e-14));
}

TEST_CASE("the reference solution finds the exact equilibria of 800 beams with and without supports") {
  constexpr int problems = 800;
  std::map<std::string_view, int> of_layout;
  int two_sided_pressed = 0;
  int several_pressed = 0;
  int compared = 0;
  for (std::uint64_t number = 0; number < problems; ++number) {
    const random_problem p = make_random_problem(11, number, {.plate_share = 0.0, .most_elements = 4});
    const std::vector<exact_step_end> ends = exact_ends(p);
    const linear_structure s = build(p.geometry, p.supports, p.pairs);
    reference_solver o(s);
    comparison c;  // over all steps, because an unloaded state has no largest deflection
    INFO(number);
    for (std::size_t step = 0; step < ends.size(); ++step) {
      if (ends[step].fraction != 1) continue;
      const solved_step a = o.solve(nodal_loads(p.geometry, p.steps[step]).force);
      REQUIRE(a.status == solved);
      if (!is_unique(s, a)) continue;
      c.take(a.displacement, rounded_all(ends[step].displacement));
      ++compared;
      const std::ptrdiff_t pressed = a.pairs_in_contact();
      several_pressed += pressed > 1 ? 1 : 0;
      two_sided_pressed += p.layout == face_layout::two_sided && pressed > 0 ? 1 : 0;
      ++of_layout[name_of(p.layout)];
    }
    CHECK(c.relative() < 1e-10);
  }
  CHECK(compared > 2 * problems);
  CHECK(several_pressed > problems * 2 / 5);
  CHECK(two_sided_pressed > problems / 5);
  for (const auto& [layout, times] : of_layout) CHECK(times > problems / 5);
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
  const solved_step a = solver.solve(nodal_loads(p.geometry, p.steps[0]).force);
  CHECK(a.status == solved);
  CHECK(a.isep == std::vector<int>{separated, separated, in_contact, separated});
  CHECK(solver.factorisations() < 10);
  const exact_step_end truth = exact_ends(p.as_problem()).back();
  CHECK(truth.isep == std::vector<int>{separated, separated, in_contact, separated});
  for (std::size_t dof = 0; dof < a.displacement.size(); ++dof)
    CHECK(a.displacement[dof] == Approx(rounded(truth.displacement[dof])).epsilon(1e-14));
}

TEST_CASE("the reference solution finds no equilibrium of a beam that its load lifts off the faces") {
  const beam_problem p = free_beam_on_springs(4.0, 4, 10.0, 1.0);
  const linear_structure s = p.structure();
  for (const load& l : {even_load(1.0), load{{{0, 0, -1.0}, {2, 0, 2.0}}, {}}, load{{{2, 1, 1.0}}, {}}}) {
    const std::vector<double> f = nodal_loads(p.geometry, l).force;
    CHECK(reference_solver(s).solve(f).status == path_ended);  // rounded loads prove nothing
    CHECK(reference_solver(s).solve(f, s.truth->work_of(l)).status == mechanism);
  }
  reference_solver o(s);
  CHECK(o.solve(nodal_loads(p.geometry, even_load(1.0)).force).status == path_ended);
  const solved_step after = o.solve(nodal_loads(p.geometry, even_load(-1.0)).force);
  const solved_step alone = reference_solver(s).solve(nodal_loads(p.geometry, even_load(-1.0)).force);
  CHECK(after.status == solved);
  for (std::size_t dof = 0; dof < after.displacement.size(); ++dof)
    CHECK(after.displacement[dof] == Approx(alone.displacement[dof]).epsilon(1e-14).margin(1e-16));
}

TEST_CASE("the reference solution finds the equilibrium of a beam balanced on one pair") {
  beam_problem p{even_beam(4.0, 4, 1e3), {}, {{2, face_below, -0.1, 50.0, false}}, {}};
  const linear_structure s = p.structure();
  const solved_step a = reference_solver(s).solve(nodal_loads(p.geometry, even_load(-2.0)).force);
  CHECK(a.status == solved);
  CHECK(a.displacement[4] == Approx(-0.1 - 8.0 / 50).epsilon(1e-13));
  // A small moment rotates the beam without limit.
  std::vector<double> f = nodal_loads(p.geometry, even_load(-2.0)).force;
  f[6] -= 1e-6;
  CHECK(reference_solver(s).solve(f).status == path_ended);
}

TEST_CASE("the reference solution of an unloaded structure is 0, also after a load") {
  beam_problem p = free_beam_on_springs(4.0, 4, 10.0, 1.0);
  const std::vector<double> nothing(10, 0.0);
  const linear_structure free = p.structure();
  reference_solver o(free);
  CHECK(o.solve(nothing).displacement == nothing);
  REQUIRE(o.solve(nodal_loads(p.geometry, even_load(-1.0)).force).status == solved);
  const solved_step unloaded = o.solve(nothing);
  CHECK(unloaded.status == solved);
  for (const double w : unloaded.displacement) CHECK(std::abs(w) < 1e-15);

  p.supports = {{0, 0, true}, {4, 0, true}};
  const linear_structure held = p.structure();
  CHECK(reference_solver(held).solve(nothing).displacement == nothing);
}

TEST_CASE(
    "the reference solution of a long simply supported span is exact except for the rounding of residuals") {
  // With elements of length 1 and loads of 6 and 1, matrix and load are exact in doubles.
  for (const int elements : {100, 400, 1000}) {
    const beam_problem p{even_beam(elements, elements, 1.0), {{0, 0, true}, {elements, 0, true}}, {}, {}};
    const linear_structure s = p.structure();
    const std::vector<double> f = nodal_loads(p.geometry, even_load(-12.0)).force;
    const solved_step a = reference_solver(s).solve(f);
    REQUIRE(a.status == solved);

    comparison refined;
    std::vector<double> exact(f.size());
    const long double l = elements;
    for (std::size_t i = 0; i < exact.size() / 2; ++i) {
      const auto x = static_cast<long double>(i);
      exact[2 * i] = static_cast<double>(-x * (l - x) * (l * l + l * x - x * x) / 2);
    }
    refined.take(a.displacement, exact);
    INFO(elements << ": " << refined.relative());
    CHECK(refined.relative() < rounded_residuals(elements, std::pow(elements, 3) / 48));
  }
}

TEST_CASE(
    "the reference solution does not depend on loads that were solved before, even if these were much "
    "larger") {
  int compared = 0;
  for (std::uint64_t number = 0; number < 200; ++number) {
    const random_problem p = make_random_problem(7, number);
    const linear_structure s = build(p.geometry, p.supports, p.pairs);
    const std::vector<double> before = nodal_loads(p.geometry, p.steps[0]).force;
    for (const double ratio : {-1.0, 1e-6, 1e-15}) {
      std::vector<double> f = before;
      for (double& force : f) force *= ratio;
      reference_solver warm(s);
      if (warm.solve(before).status != solved) continue;
      const solved_step a = warm.solve(f);
      const solved_step alone = reference_solver(s).solve(f);
      INFO(number << ", " << ratio);
      REQUIRE(a.status == alone.status);
      if (a.status != solved || !is_unique(s, alone)) continue;
      comparison c{static_cast<std::size_t>(s.dofs_per_node)};
      c.take(a.displacement, alone.displacement);
      CHECK(c.relative() < 1e-10);
      ++compared;
    }
  }
  CHECK(compared > 450);
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
    const solved_step a = solver.solve(std::vector<double>{0, 0, 0, 0, load, 0});
    REQUIRE(a.closed(0) == (load > 1));
    const int so_far = solver.factorisations();
    CHECK(
        solver.reciprocal_condition() ==
        Approx(anew.reciprocal_condition(std::vector<char>{static_cast<char>(a.closed(0))})).epsilon(1e-12));
    CHECK(solver.factorisations() == so_far);
  }
}
