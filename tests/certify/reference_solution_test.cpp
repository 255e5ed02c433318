// The reference solution against closed forms, and against every set of closed pairs there is.
#include "contct/certify/reference_solution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "catch.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/solve/factored_stiffness.hpp"
#include "support/beams.hpp"
#include "support/tried_problem.hpp"

using namespace contct;
using outcome = reference_answer::outcome;

namespace {

// The truth about a small contact problem: every set of closed pairs is tried, dense, in long double.
using extended_numbers = std::vector<long double>;

/// A set of closed pairs: bit i for pair i.
using pair_bits = unsigned;

bool is_in(pair_bits set, std::size_t pair) {
  return (set >> pair & 1U) != 0;
}

/// Solve A x = b in place by a dense Cholesky factor; A [n * n] is overwritten.
void solve_dense(extended_numbers& a, extended_numbers& b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) {
      for (std::size_t i = j; i < n; ++i) a[i * n + j] -= a[i * n + k] * a[j * n + k];
    }
    const long double pivot = std::sqrt(a[j * n + j]);
    for (std::size_t i = j; i < n; ++i) a[i * n + j] /= pivot;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
}

/// Where the structure stands with the springs of `set` working both ways and all others out.
extended_numbers stands_with(const linear_structure& s, std::span<const double> load, pair_bits set) {
  const std::size_t n = load.size();
  const auto row = [&s](std::size_t dof) { return s.row_of(dof); };
  extended_numbers a(n * n);
  extended_numbers b(n);
  for (int j = 0; j < s.dofs(); ++j) {
    for (int i = j; i <= std::min(j + s.stiffness.band().subdiagonals(), s.dofs() - 1); ++i)
      a[i * n + j] = s.stiffness.band().at(i, j);
  }
  for (std::size_t dof = 0; dof < n; ++dof) b[row(dof)] = load[dof];
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    if (!is_in(set, i)) continue;
    const std::size_t at = row(s.dof_of_pair(i));
    a[at * n + at] += s.pairs[i].stiffness;
    b[at] += static_cast<long double>(s.pairs[i].stiffness) * s.pairs[i].face;
  }
  for (std::size_t dof = 0; dof < n; ++dof) {
    if (s.fixed[dof] != 0) b[row(dof)] = 0.0L;
  }
  solve_dense(a, b);
  extended_numbers u(n);
  for (std::size_t dof = 0; dof < n; ++dof) u[dof] = b[row(dof)];
  return u;
}

/// n (w - c) of a pair.
long double pressing(const linear_structure& s, const extended_numbers& u, std::size_t pair) {
  const contact_pair& p = s.pairs[pair];
  return p.surface * (u[s.dof_of_pair(pair)] - p.face);
}

long double largest_deflection(const linear_structure& s, const extended_numbers& u) {
  long double largest = 0.0L;
  for (std::size_t dof = 0; dof < u.size(); dof += s.dofs_per_node)
    largest = std::max(largest, std::abs(u[dof]));
  return largest;
}

/// The farthest that a pair of `set` is from its face, or any other one beyond it, of the largest deflection.
long double wrong_with(const linear_structure& s, const extended_numbers& u, pair_bits set) {
  long double wrong = 0.0L;
  for (std::size_t i = 0; i < s.pairs.size(); ++i)
    wrong = std::max(wrong, is_in(set, i) ? -pressing(s, u, i) : pressing(s, u, i));
  return wrong > 0 ? wrong / largest_deflection(s, u) : 0.0L;
}

/// The equilibrium, the pairs that its set closes, and what that leaves wrong.
struct equilibrium {
  extended_numbers u;
  pair_bits set = 0;
  long double wrong = std::numeric_limits<long double>::infinity();
};

/// Of all sets the one least wrong, where supports hold the structure: the energy is convex, so a set that is
/// not wrong at all has the equilibrium.
equilibrium least_wrong(const linear_structure& s, std::span<const double> load) {
  equilibrium best;
  for (pair_bits set = 0; set < 1U << s.pairs.size(); ++set) {
    const extended_numbers u = stands_with(s, load, set);
    const long double wrong = wrong_with(s, u, set);
    if (wrong < best.wrong) best = {u, set, wrong};
  }
  return best;
}

std::vector<double> forces_of(const model& m, const load& l) {
  std::vector<double> f(static_cast<std::size_t>(dofs(m)), 0.0);
  add_consistent_loads(m, l, f);
  return f;
}

load even_load(double q) {
  return {{}, {{{q}, {}}}};
}

std::vector<double> forces_of(const beam& b, const load& l) {
  return forces_of(model{b}, l);
}

/// The largest deflection of either, and the largest difference between the two.
struct comparison {
  std::size_t stride = 2;  // dofs of a node
  long double size = 0.0L;
  long double off = 0.0L;

  template <class Other>
  void take(const std::vector<double>& u, const Other& other) {
    for (std::size_t dof = 0; dof < u.size(); dof += stride) {
      const long double mine = u[dof];
      const long double yours = other[dof];
      size = std::max({size, std::abs(mine), std::abs(yours)});
      off = std::max(off, std::abs(mine - yours));
    }
  }
  [[nodiscard]] double relative() const { return off == 0 ? 0.0 : static_cast<double>(off / size); }
};

random_problem_kind small_held_beams() {
  random_problem_kind kind;
  kind.free_share = 0.0;
  kind.plate_share = 0.0;
  kind.most_elements = 4;
  return kind;
}

/// The relative error at the middle of a span of elements of length 1 and EI = 1 once refinement has
/// converged, whatever LAPACK solved. What is left is the rounding of each row's residual in long double,
/// eps/2 of the sum of |K_ij| |u_j|, at most 48 |u|. It acts as a force there, and moves the middle by at
/// most the middle's compliance. The signs of the rows' roundings are random, so n of them add up to sqrt(n).
double rounded_residuals(int elements, double compliance) {
  constexpr auto rounding = static_cast<double>(std::numeric_limits<long double>::epsilon() / 2);
  return std::sqrt(elements) * 48 * compliance * rounding;
}

}  // namespace

TEST_CASE(
    "the reference solution has PB1's hand calculation at every step, loading, unloading and reversed") {
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

TEST_CASE("the reference solution has PB6's closed form: a span over a settled middle support") {
  beam_problem p{even_beam(10.0, 10, 5e6), {{0, 0, true}, {10, 0, true}}, {{5, -1, -0.02, 2e6, false}}, {}};
  const linear_structure s = p.structure();
  reference_solver o(s);
  for (const double q : {400.0, 767.0, 769.0, 1600.0, 3200.0, 800.0, 0.0}) {
    const double without = 5 * q * 1e4 / 384 / 5e6;
    const double force = std::max(0.0, (without - 0.02) / (1000.0 / 48 / 5e6 + 1 / 2e6));
    const reference_answer a = o.solve(forces_of(p.geometry, even_load(-q)));
    INFO(q);
    CHECK(a.how == outcome::found);
    CHECK(a.displacement[10] == Approx(-without + force * 1000 / 48 / 5e6).epsilon(1e-13).margin(1e-30));
    CHECK(a.pressed[0] == (q > 768 ? 1 : 0));
  }
}

TEST_CASE(
    "of all sets of closed pairs the reference solution finds the one that is right: thousands of held "
    "beams") {
  std::map<std::string_view, int> of_layout;
  int two_sided_pressed = 0;
  int several_pressed = 0;
  double worst = 0.0;
  int compared = 0;
  for (std::uint64_t number = 0; number < 2500; ++number) {
    const random_problem p = make_random_problem(11, number, small_held_beams());
    if (p.pairs.size() > 8) continue;
    const linear_structure s = build(p.geometry, p.supports, p.pairs);
    reference_solver o(s);
    comparison c;  // over all steps: unloaded, a structure has no size
    for (const load& l : p.steps) {
      const std::vector<double> f = forces_of(p.geometry, l);
      const equilibrium truth = least_wrong(s, f);
      const reference_answer a = o.solve(f);
      INFO(number);
      REQUIRE(truth.wrong < 1e-10L);
      REQUIRE(a.how == outcome::found);
      REQUIRE(a.unique);
      c.take(a.displacement, truth.u);
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
  CHECK(worst < 1e-12);
  CHECK(compared > 5000);
  CHECK(several_pressed > 1000);
  CHECK(two_sided_pressed > 500);
  for (const auto& [layout, times] : of_layout) CHECK(times > 500);
  CHECK(of_layout.size() == face_layouts);
}

TEST_CASE(
    "where the plain active set goes round in circles the reference solution ends, at the right answer") {
  // A cantilever between stops. From the undeformed structure: none, then 2 and 3, then 3 and 4 press,
  // then none again; right is 3 alone. Nothing is near a tie: every pair stays 0.08 off its face.
  const beam_problem p{even_beam(3.0, 3, 1.0),
                       {{0, 0, true}, {0, 1, true}},
                       {{1, face_below, -3.0, 1e4, false},
                        {1, face_above, 9.0, 1e3, false},
                        {2, face_above, 1.0, 1e2, false},
                        {3, face_below, -8.0, 1e2, false}},
                       {}};
  const linear_structure s = p.structure();
  const std::vector<double> f = {0, 0, 19, 0, 1, 0, 4, 0};
  const equilibrium truth = least_wrong(s, f);
  reference_solver solver(s);
  const reference_answer a = solver.solve(f);
  CHECK(a.how == outcome::found);
  CHECK(a.pressed == std::vector<char>{0, 0, 1, 0});
  CHECK(truth.set == 4U);
  CHECK(solver.factorisations() < 10);
  for (std::size_t dof = 0; dof < f.size(); ++dof)
    CHECK(a.displacement[dof] == Approx(static_cast<double>(truth.u[dof])).epsilon(1e-14));
}

TEST_CASE("a free beam lifted off its faces, or tipped off them, has no equilibrium") {
  beam_problem p = free_beam_on_springs(4.0, 4, 10.0, 1.0);
  const linear_structure s = p.structure();
  for (const load& l : {even_load(1.0), load{{{0, 0, -1.0}, {2, 0, 2.0}}, {}}, load{{{2, 1, 1.0}}, {}}}) {
    const std::vector<double> f = forces_of(p.geometry, l);
    CHECK(reference_solver(s).solve(f).how == outcome::none_seen);  // of rounded loads
    const reference_answer a = reference_solver(s).solve(f, s.truth->work_of(l));
    CHECK(a.how == outcome::no_equilibrium);
    CHECK_FALSE(a.unique);
  }
}

TEST_CASE("after a load without equilibrium the reference solution has the next one's") {
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

TEST_CASE("a beam dropped onto stops below it comes to rest on them") {
  // Nothing touches in the beginning. Loaded nearer to the second stop: 1/4 and 3/4 of the force.
  beam_problem p{even_beam(4.0, 4, 1e3),
                 {},
                 {{0, face_below, -0.1, 50.0, false}, {4, face_below, -0.3, 50.0, false}},
                 {}};
  const linear_structure s = p.structure();
  const reference_answer a = reference_solver(s).solve(forces_of(p.geometry, tip_load(3, -8.0)));
  CHECK(a.how == outcome::found);
  CHECK(a.unique);
  CHECK(a.displacement[0] == Approx(-0.1 - 2.0 / 50).epsilon(1e-13));
  CHECK(a.displacement[8] == Approx(-0.3 - 6.0 / 50).epsilon(1e-13));
}

TEST_CASE("balanced on one pair an equilibrium is found, and known to be one of many") {
  beam_problem p{even_beam(4.0, 4, 1e3), {}, {{2, face_below, -0.1, 50.0, false}}, {}};
  const linear_structure s = p.structure();
  const reference_answer a = reference_solver(s).solve(forces_of(p.geometry, even_load(-2.0)));
  CHECK(a.how == outcome::found);
  CHECK_FALSE(a.unique);
  CHECK(a.displacement[4] == Approx(-0.1 - 8.0 / 50).epsilon(1e-13));
  // Off its balance by little it turns for ever.
  std::vector<double> f = forces_of(p.geometry, even_load(-2.0));
  f[6] -= 1e-6;
  CHECK(reference_solver(s).solve(f).how == outcome::none_seen);
}

TEST_CASE("unloaded, a free structure may lie anywhere between its faces, a held one may not") {
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

TEST_CASE("a long simply supported span keeps its digits where a band solver alone loses them") {
  // Elements of length 1 and loads of 6 and 1: matrix and load are stored without any rounding.
  for (const int elements : {100, 400, 1000}) {
    const auto n = static_cast<std::size_t>(elements);
    const beam_problem p{even_beam(elements, elements, 1.0), {{0, 0, true}, {elements, 0, true}}, {}, {}};
    const linear_structure s = p.structure();
    const std::vector<double> f = forces_of(p.geometry, even_load(-12.0));
    const reference_answer a = reference_solver(s).solve(f);
    REQUIRE(a.how == outcome::found);
    CHECK(a.unique);

    band_matrix k = s.stiffness.band();
    std::vector<double> alone = f;
    alone[0] = alone[2 * n] = 0.0;
    REQUIRE(factor(k));
    solve_with(k, alone);
    comparison refined;
    comparison unrefined;
    std::vector<long double> exact(f.size());
    for (std::size_t i = 0; i <= n; ++i) {
      const auto x = static_cast<long double>(i);
      const long double l = elements;
      exact[2 * i] = -x * (l - x) * (l * l + l * x - x * x) / 2;
    }
    refined.take(a.displacement, exact);
    unrefined.take(alone, exact);
    INFO(elements << ": " << refined.relative() << " and " << unrefined.relative());
    CHECK(refined.relative() < rounded_residuals(elements, std::pow(elements, 3) / 48));
    CHECK(unrefined.relative() > 1e3 * refined.relative());
  }
}

TEST_CASE("a long span over a settled support has its closed form to 10 digits") {
  const beam_problem p{
      even_beam(1000, 1000, 1.0), {{0, 0, true}, {1000, 0, true}}, {{500, -1, -1e11, 1e-6, false}}, {}};
  const linear_structure s = p.structure();
  const reference_answer a = reference_solver(s).solve(forces_of(p.geometry, even_load(-12.0)));
  const double without = 12.0 * 5 / 384 * 1e12;
  const double force = (without - 1e11) / (1e9 / 48 + 1e6);
  REQUIRE(a.how == outcome::found);
  const double compliance = 1 / (48 / 1e9 + 1e-6);
  CHECK(a.displacement[1000] == Approx(-1e11 - force * 1e6).epsilon(rounded_residuals(1000, compliance)));
}

TEST_CASE("what was solved before leaves no trace in the answer, however much larger it was") {
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

TEST_CASE("a load beyond the range of double precision is no answer, and no word about equilibrium") {
  const beam_problem p = cantilever_over_a_stop();
  const linear_structure s = p.structure();
  reference_solver o(s);
  std::vector<double> f(6, 0.0);
  f[4] = std::numeric_limits<double>::infinity();
  CHECK(o.solve(f).how == outcome::not_found);
  f[4] = -10.0;  // and it has not spoilt the reference solution
  const reference_answer after = o.solve(f);
  CHECK(after.how == outcome::found);
  CHECK(after.displacement[4] == Approx(-10 * 8.0 / 3 / 1e4).epsilon(1e-14));
}

TEST_CASE(
    "a beam that is pinned at one end turns onto the stop at its other end, and its pin stays where it is") {
  const beam_problem p{
      even_beam(2.0, 2, 1e4), {{0, 0, true}}, {{2, face_below, -0.1, 1e3, false}}, {tip_load(1, -10)}};
  const linear_structure s = p.structure();
  reference_solver o(s);
  const reference_answer a = o.solve(forces_of(p.geometry, p.steps[0]));
  CHECK(a.how == outcome::found);
  CHECK(a.unique);
  CHECK(a.displacement[0] == 0.0);
  const double tip = -0.1 - 5.0 / 1e3;
  CHECK(a.displacement[4] == Approx(tip).epsilon(1e-13));
  CHECK(a.displacement[2] == Approx(tip / 2 - 10.0 * 8 / 48 / 1e4).epsilon(1e-13));
}

TEST_CASE("the condition of the state that was found takes no factorisation, that of another state one") {
  const beam_problem p{
      even_beam(2.0, 2, 1.0), {{0, 0, true}, {0, 1, true}}, {{2, face_above, 1.0, 10.0, false}}, {}};
  const linear_structure s = p.structure();
  const std::vector<double> f = {0, 0, 0, 0, 4, 0};
  reference_solver solver(s);
  REQUIRE(solver.solve(f).how == outcome::found);
  const int so_far = solver.factorisations();
  REQUIRE(so_far > 0);
  factored_stiffness anew(s);
  const auto check = [&](const std::vector<char>& closed, int more) {
    CHECK(solver.reciprocal_condition(closed) == Approx(anew.reciprocal_condition(closed)).epsilon(1e-12));
    CHECK(solver.factorisations() == so_far + more);
  };
  check(solver.solve(f).pressed, 0);
  check({solver.solve(f).pressed[0] == 0 ? char{1} : char{0}}, 1);
  CHECK(anew.reciprocal_condition(std::vector<char>{0}) != anew.reciprocal_condition(std::vector<char>{1}));
}
