// Tests the certificates of final states of paths, of fallbacks and of the reference solution.
#include "contct/certify/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/path/solve_problem.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

/// A state with its reported numbers, which a test may change.
struct told_state {
  std::vector<double> u;
  std::vector<int> isep;
  double rcond = 1e-3;
  double fraction = 1.0;

  [[nodiscard]] step_state at(int step) const { return {step, fraction, u, isep, rcond}; }
};

/// Returns the reference solution under `l`, whose errors in the certificate's measures are 0.
told_state right_state(const beam_problem& p, const load& l) {
  const linear_structure s = p.structure();
  std::vector<double> f(static_cast<std::size_t>(s.dofs()), 0.0);
  add_consistent_loads(p.geometry, l, f);
  const reference_answer a = reference_solver(s).solve(f);
  REQUIRE(a.how == reference_answer::outcome::found);
  told_state t{a.displacement, {}};
  for (const char pressed : a.pressed) t.isep.push_back(pressed != 0 ? in_contact : separated);
  return t;
}

/// Passes states to the certifier, one step after another.
struct judge {
  problem what;
  linear_structure s;
  certifier c;

  explicit judge(const beam_problem& p) : what(p.as_problem()), s(p.structure()), c(what, s) {}
  certificate of(const told_state& t) {
    c.step_ended(t.at(static_cast<int>(c.steps().size()) + 1));
    return c.steps().back().value();
  }
};

certificate judged(const beam_problem& p, const told_state& t) {
  return judge(p).of(t);
}

/// Returns the letters of the measures that exceed the allowed error: D (displacement), S (shape), E
/// (equilibrium), P (penetration), T (tension).
std::string wrong_in(const certificate& c) {
  std::string wrong;
  if (!(c.displacement_error <= certified_share)) wrong += 'D';
  if (!(c.shape_error <= certified_share)) wrong += 'S';
  if (!(c.equilibrium <= certified_share)) wrong += 'E';
  if (!(c.penetration <= certified_share)) wrong += 'P';
  if (!(c.tension <= certified_share)) wrong += 'T';
  return wrong;
}

bool says(const certificate& c, const std::string& words) {
  return c.problem.find(words) != std::string::npos;
}

constexpr double weak = 1e-12;  // a spring that is too weak to change any equilibrium
constexpr double stiff = 1e12;

/// A span with two pressed pairs and two separated pairs. The second pair of each kind has a weak spring.
/// Node 4 sinks below -0.1, and node 1 stays above -0.2.
beam_problem span_with_pairs() {
  return {even_beam(8.0, 8, 1e3),
          {{0, 0, true}, {8, 0, true}},
          {{4, face_below, -0.1, 500.0, false},
           {3, face_below, -0.05, weak, false},
           {1, face_below, -0.2, 500.0, false},
           {7, face_below, -0.2, weak, false}},
          {{{}, {{{-12.0}, {}}}}}};
}

}  // namespace

TEST_CASE("a correct state is certified, and every error in the certificate is below 1e-12") {
  const beam_problem p = span_with_pairs();
  const told_state right = right_state(p, p.steps[0]);
  REQUIRE(right.isep == std::vector<int>{in_contact, in_contact, separated, separated});
  const certificate c = judged(p, right);
  CHECK(c.certified);
  CHECK(c.unique);
  CHECK(c.problem.empty());
  CHECK(c.displacement_error < 1e-12);
  CHECK(c.shape_error < 1e-12);
  CHECK(c.equilibrium < 1e-15);
  CHECK(c.penetration == 0.0);
  CHECK(c.tension == 0.0);
  CHECK(c.rcond == right.rcond);
}

TEST_CASE(
    "an error of a state changes all measures of the certificate that it affects, and the message names the "
    "worst") {
  // A wrong status of a pair with a weak spring does not disturb equilibrium, so only penetration or
  // tension detects the wrong status.
  const beam_problem p = span_with_pairs();
  const told_state right = right_state(p, p.steps[0]);
  struct fault {
    std::function<void(told_state&)> put;
    const char *wrong, *words;
  };
  const double middle = right.u[8];
  for (const fault& f : std::vector<fault>{
           {[](told_state& t) { t.u[8] *= 1 + 1e-4; }, "DSE", " 0.01 % of the largest deflection"},
           {[](told_state& t) { t.u[5] += 1e-3; }, "SE", "the displacements are off"},
           {[](told_state& t) { t.isep[1] = separated; }, "P", "a separated pair is beyond its face"},
           {[](told_state& t) { t.isep[0] = separated; }, "EP", "a separated pair is beyond its face"},
           {[](told_state& t) { t.isep[3] = in_contact; }, "T", "a pair in contact pulls"},
           {[](told_state& t) { t.isep[2] = in_contact; }, "ET", "a pair in contact pulls"}}) {
    INFO(f.wrong);
    told_state t = right;
    f.put(t);
    const certificate c = judged(p, t);
    CHECK(wrong_in(c) == f.wrong);
    CHECK(says(c, f.words));
    CHECK_FALSE(c.certified);
    if (f.wrong[0] == 'D') CHECK(c.displacement_error == Approx(1e-4).epsilon(1e-3));
    if (f.wrong[0] == 'S') CHECK(c.displacement_error == 0.0);
    if (f.wrong[0] == 'P') CHECK(c.penetration == Approx((-0.05 - t.u[6]) / std::abs(middle)).epsilon(1e-10));
    if (f.wrong[0] == 'T') CHECK(c.tension == Approx((t.u[14] + 0.2) / std::abs(middle)).epsilon(1e-10));
  }
  told_state t = right;
  t.u[8] = middle * (1 + 1e-11);
  CHECK(judged(p, t).certified);
}

TEST_CASE(
    "only comparison with the reference solution detects an error in w that hardly disturbs equilibrium") {
  // A nearly rigid beam on soft springs, with a deflection that is 1e-5 too large.
  beam_problem p = free_beam_on_springs(4.0, 4, 1e10, 1.0);
  p.steps = {{{}, {{{-1.0}, {}}}}};
  told_state t = right_state(p, p.steps[0]);
  for (std::size_t i = 0; i < t.u.size(); i += 2) t.u[i] *= 1 + 1e-5;
  const certificate c = judged(p, t);
  CHECK(wrong_in(c) == "DS");
  CHECK(c.displacement_error == Approx(1e-5).epsilon(1e-3));
}

TEST_CASE("a missing force on a stiff support violates equilibrium, but hardly changes displacements") {
  // The load is changed at a nearly rigid support.
  beam_problem p = span_with_pairs();
  p.pairs[0] = {4, face_below, -0.1, stiff, false};
  const told_state t = right_state(p, p.steps[0]);
  REQUIRE(judged(p, t).certified);
  beam_problem changed = p;
  changed.steps[0].points = {{4, 0, -1e2}};
  const certificate c = judged(changed, t);
  CHECK(wrong_in(c) == "E");
  CHECK(says(c, "loads and forces do not balance"));
  changed.steps[0].points = {{2, 0, -1e2}};
  CHECK(wrong_in(judged(changed, t)) == "DSE");
}

TEST_CASE(
    "the certificate does not check the equilibrium of a fixed dof, because the support carries the load") {
  beam_problem p = span_with_pairs();
  const told_state t = right_state(p, p.steps[0]);
  p.steps[0].points = {{0, 0, -1e6}};
  CHECK(judged(p, t).certified);
}

TEST_CASE("a pair exactly at its face may be separated or in contact in a certified state") {
  beam_problem p = span_with_pairs();
  p.supports.push_back({0, 1, true});
  told_state t = right_state(p, {});
  p.pairs[2].face = 0.0;
  p.steps = {{}};
  for (const int status : {in_contact, separated}) {
    t.isep[2] = status;
    CHECK(judged(p, t).certified);
  }
}

TEST_CASE("a step that did not reach its full load has no certificate") {
  const beam_problem p = span_with_pairs();
  told_state t = right_state(p, p.steps[0]);
  judge j(p);
  t.fraction = std::nextafter(1.0, 0.0);
  j.c.step_ended(t.at(1));
  REQUIRE(j.c.steps().size() == 1);
  CHECK_FALSE(j.c.steps()[0].has_value());
  CHECK_FALSE(j.c.all_certified());
}

TEST_CASE("if there is no equilibrium, no state is certified, and the certificate gives this reason") {
  beam_problem p = free_beam_on_springs(4.0, 4, 10.0, 1.0);
  p.steps = {{{}, {{{1.0}, {}}}}};
  const certificate c = judged(p, {std::vector<double>(10, 0.0), std::vector<int>(5, separated)});
  CHECK_FALSE(c.certified);
  CHECK(says(c, "there is no equilibrium"));
}

TEST_CASE(
    "if a rigid-body motion is free, the certificate does not compare displacements, but checks everything "
    "else") {
  beam_problem p{even_beam(4.0, 4, 1e3), {}, {{2, face_below, -0.1, 50.0, false}}, {}};
  p.steps = {{{}, {{{-2.0}, {}}}}};
  told_state t = right_state(p, p.steps[0]);
  for (std::size_t i = 0; i < 5; ++i) {  // rotates the beam about its pair
    t.u[2 * i] += 0.01 * (static_cast<double>(i) - 2);
    t.u[2 * i + 1] += 0.01;
  }
  const certificate c = judged(p, t);
  CHECK_FALSE(c.unique);
  CHECK(wrong_in(c).empty());
  CHECK(c.displacement_error == 0.0);
  for (std::size_t i = 0; i < 5; ++i) t.u[2 * i] -= 0.01;
  CHECK(wrong_in(judged(p, t)) == "E");
}

TEST_CASE("the displacement error of an unloaded state is relative to the largest deflection of the path") {
  beam_problem p = span_with_pairs();
  p.steps.emplace_back();
  told_state loaded = right_state(p, p.steps[0]);
  told_state unloaded{std::vector<double>(loaded.u.size(), 0.0), std::vector<int>(4, separated)};
  CHECK(judged(p, right_state(p, p.steps[0])).certified);
  for (const double share : {1e-9, 1e-4}) {
    judge j(p);
    CHECK(j.of(loaded).certified);
    unloaded.u[8] = share * loaded.u[8];
    const certificate c = j.of(unloaded);
    CHECK(c.displacement_error == Approx(share).epsilon(1e-4));
    CHECK(c.certified == (share < 1e-6));
  }
  // Without an earlier loaded state, any deflection is 100 % of the largest.
  p.steps = {{}};
  CHECK(wrong_in(judged(p, unloaded)) == "DSE");
  unloaded.u[8] = 0.0;
  CHECK(judged(p, unloaded).certified);
}

TEST_CASE(
    "if a structure only rotates, the rounding of its deflections is not the scale of the displacement "
    "error") {
  // Under equal moments at both ends, the middle of a span deflects only by rounding.
  beam_problem p{
      even_beam(2.0, 2, 1.0), {{0, 0, true}, {2, 0, true}}, {{1, face_below, -1.0, 5.0, false}}, {}};
  p.steps = {{{{0, 1, 0.7}, {2, 1, 0.7}}, {}}};
  told_state t = right_state(p, p.steps[0]);
  REQUIRE(std::abs(t.u[2]) < 1e-15);
  REQUIRE(std::abs(t.u[1]) > 0.1);
  for (const double rounding : {-1e-17, 0.0, 3e-17}) {
    t.u[2] = rounding;
    CHECK(judged(p, t).certified);
  }
  t.u[2] = 1e-9;
  CHECK(judged(p, t).displacement_error > 1e-9);
}

TEST_CASE("the errors in a certificate are relative, and do not change with units from 1e-12 to 1e12") {
  const auto in_units = [](double length, double force) {
    beam_problem p = span_with_pairs();
    for (double& x : p.geometry.x) x *= length;
    for (double& EI : p.geometry.EI) EI *= force * length * length;
    for (contact_pair& c : p.pairs) {
      c.face *= length;
      c.stiffness *= force / length;
    }
    p.steps[0].distributed[0].polynomial[0] *= force / length;
    return p;
  };
  const auto measured = [&](double length, double force) {
    const beam_problem p = in_units(length, force);
    told_state t = right_state(p, p.steps[0]);
    CHECK(judged(p, t).certified);
    t.u[8] += 1e-6 * length;
    t.u[3] += 1e-6;
    t.isep = {in_contact, separated, in_contact, separated};
    return judged(p, t);
  };
  const certificate here = measured(1, 1);
  REQUIRE(wrong_in(here) == "DSEPT");
  for (const double length : {1e-12, 1e-3, 1e12}) {
    for (const double force : {1e-12, 1.0, 1e12}) {
      const certificate there = measured(length, force);
      INFO(length << ", " << force);
      CHECK(there.displacement_error == Approx(here.displacement_error).epsilon(1e-8));
      CHECK(there.shape_error == Approx(here.shape_error).epsilon(1e-8));
      CHECK(there.equilibrium == Approx(here.equilibrium).epsilon(1e-8));
      CHECK(there.penetration == Approx(here.penetration).epsilon(1e-8));
      CHECK(there.tension == Approx(here.tension).epsilon(1e-8));
    }
  }
}

TEST_CASE("a state with a NaN or infinite displacement at any dof is not certified") {
  const beam_problem p = span_with_pairs();
  for (const double odd :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (const std::size_t dof : {std::size_t{5}, std::size_t{8}, std::size_t{10}}) {
      told_state t = right_state(p, p.steps[0]);
      t.u[dof] = odd;
      const certificate c = judged(p, t);
      CHECK_FALSE(c.certified);
      CHECK_FALSE(c.problem.empty());
    }
  }
}

TEST_CASE(
    "the early toggle behind an uncertified state of the 1989 rule is reported with step, pair and "
    "distance") {
  // Two equal stops under a symmetric load; the second is 0.3 % farther away, within EPSMUL of the first.
  const beam_problem p{even_beam(8.0, 8, 1e5),
                       {{0, 0, true}, {8, 0, true}},
                       {{2, face_below, -0.006, 1e5, false}, {6, face_below, -0.006 * 1.003, 1e5, false}},
                       {{{}, {{{-1.0}, {}}}}, {{}, {{{-60.0}, {}}}}}};
  for (const char* kernel : {"fortran", "cpp"}) {
    judge j(p);
    early_toggles early;
    REQUIRE(p.run(kernel, {&j.c, &early}).status == path_status::solved);
    REQUIRE(early.all().size() == 1);
    const early_toggle& e = early.all()[0];
    CHECK(e.step == 2);
    CHECK(e.number == 1);
    CHECK(e.what == event{1, change::make});
    CHECK(e.distance == Approx(0.006 * 0.003).epsilon(1e-9));
    CHECK(e.share == Approx(0.003).epsilon(1e-9));
    REQUIRE(j.c.steps().size() == 2);
    CHECK(j.c.steps()[0]->certified);
    CHECK_FALSE(j.c.steps()[1]->certified);
    CHECK(j.c.steps()[1]->displacement_error > 1e-5);
    CHECK_FALSE(j.c.all_certified());
  }
}

TEST_CASE("find_final_states finds no state for a load without an equilibrium") {
  // Two pairs below a free beam carry its weight, but no load upwards.
  beam_problem p{even_beam(4.0, 4, 1.0), {}, {{0, -1, 0.0, 1.0, true}, {4, -1, 0.0, 1.0, true}}, {}};
  p.steps = {tip_load(2, -1.0), tip_load(2, 1.0), tip_load(2, 1.0)};
  const problem what = p.as_problem();
  const linear_structure s = p.structure();
  recorder told;
  observer* const watching[] = {&told};
  const path_end end = certifier(what, s).find_final_states(watching);
  CHECK(end.status == path_status::mechanism);
  CHECK(end.step == 2);
  REQUIRE(told.steps.size() == 1);
  CHECK(told.steps[0].u[4] < 0.0);
}

TEST_CASE(
    "the certificate of a state that was taken from the reference solution is marked as not independent") {
  const problem stop = cantilever_over_a_stop().as_problem();
  const linear_structure s = structure_of(stop);
  certifier judged(stop, s);
  recorder seen;
  // The limit of one increment is enough only for the first step, which has no contact.
  REQUIRE(
      follow(stop, s, "refactor", *make_kernel("corrected"), {&seen, &judged}, {1, judged.ends()}).status ==
      path_status::solved);
  REQUIRE(judged.steps().size() == 4);
  CHECK_FALSE(seen.steps[0].from_fallback);
  CHECK(judged.steps()[0]->independent);
  CHECK(seen.steps[1].from_fallback);
  CHECK_FALSE(judged.steps()[1]->independent);
  CHECK(judged.all_certified());
}

TEST_CASE("if a final state cannot be proved, the reference solution replaces it") {
  const problem stop = cantilever_over_a_stop().as_problem();
  const linear_structure s = structure_of(stop);
  certifier judged(stop, s);
  full_load_state far{std::vector<double>(s.dofs()), {in_contact}};
  far.displacement[4] = 1.0;
  const found_end end = judged.ends()(2, &far);
  REQUIRE(end.state);
  const double f = 8.0 / 3 / 1e4;
  CHECK(end.state->displacement[4] == Approx(-0.004 - (60 * f - 0.004) / (f + 1 / 5e4) / 5e4).epsilon(1e-14));
  CHECK(end.state->isep == std::vector<int>{in_contact});
  CHECK(end.state->numbers.has_value());
}

TEST_CASE("without load, a beam without supports is certified above its faces, but not below them") {
  problem p;
  p.geometry.kind = beam{{0.0, 1.0}, {1e4}};
  p.pairs = {{0, face_below, 0.0, 10.0, false}, {1, face_below, 0.0, 10.0, false}};
  p.steps = {load{}};
  const linear_structure s = structure_of(p);
  const std::vector<int> open = {separated, separated};
  for (const double height : {0.1, -0.1}) {
    const std::vector<double> u = {height, 0.0, height, 0.0};
    certifier c(p, s);
    c.step_ended({1, 1.0, u, open, 0.5, false});
    CHECK(c.steps()[0]->certified == (height > 0.0));
    CHECK_FALSE(c.steps()[0]->unique);
  }
}

TEST_CASE("a structure beyond a face is not certified, whether or not there is a reference solution") {
  for (const double shortest : {0.5, 1e-9}) {  // for 1e-9 the reference solution has no factor
    problem p;
    beam b;
    b.x = {0, 1, 1 + shortest, 3};
    b.EI = {92, 92, 92};
    p.geometry.kind = b;
    p.pairs = {{0, face_below, 0.0, 1e5, true}, {3, face_below, 0.0, 1e5, true}};
    p.steps = {{}};
    const linear_structure s = structure_of(p);
    certifier judged(p, s);
    const std::vector<double> u = {-1, 0, -1, 0, -1, 0, -1, 0};
    const std::vector<int> isep = {separated, separated};
    judged.step_ended({1, 1.0, u, isep, 1e-3});
    CAPTURE(shortest, judged.steps()[0]->problem);
    CHECK_FALSE(judged.steps()[0]->certified);
    CHECK_FALSE(judged.steps()[0]->problem.empty());
  }
}
