// Tests the certificates of final states of paths, of fallbacks and of the reference solution.
#include "contct/proof/certificate.hpp"

#include <cmath>
#include <functional>

#include "catch.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/reference_solution.hpp"
#include "contct/results/path_observers.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

/// A state, which a test may change.
struct told_state {
  std::vector<double> u;
  std::vector<int> isep;
};

/// Returns the reference solution of step 1, whose errors in the certificate's measures are 0.
told_state right_state(const beam_problem& p) {
  const linear_structure s = p.structure();
  const std::vector<double> f = nodal_loads(p.geometry, p.steps.at(0)).force;
  const solved_step a = reference_solver(s).solve(f);
  REQUIRE(a.status == path_status::solved);
  return {a.displacement, a.isep};
}

/// Passes states to the certifier, one step after another.
struct judge {
  problem what;
  linear_structure s;
  certifier c;
  int step = 0;

  explicit judge(const beam_problem& p) : what(p.as_problem()), s(p.structure()), c(what, s) {}
  certificate of(const told_state& t) {
    solved_step told{{.step = ++step, .fraction = 1.0, .displacement = t.u, .isep = t.isep}};
    told.rcond = 1e-3;
    told.judged = c.certificate_of(told);
    c.complete(told);
    return *told.judged;
  }
};

certificate judged(const beam_problem& p, const told_state& t) {
  return judge(p).of(t);
}

/// Returns the letters of the measures that exceed the allowed error: D (displacement), S (any number), E
/// (equilibrium), P (penetration), T (tension).
std::string wrong_in(const certificate& c) {
  std::string wrong;
  for (const auto& [letter, error] : {std::pair('D', c.displacement_error),
                                      {'S', c.worst_share},
                                      {'E', c.equilibrium},
                                      {'P', c.penetration},
                                      {'T', c.tension}})
    if (!(error <= certified_share)) wrong += letter;
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

/// Returns the certificate of a beam without supports, on pairs that are separated, at this height.
certificate lying_at(double height, std::vector<double> x) {
  const int last = static_cast<int>(x.size()) - 1;
  const std::vector<double> EI(x.size() - 1, 92);
  const beam_problem p{
      {std::move(x), EI}, {}, {{0, face_below, 0, 1e5, true}, {last, face_below, 0, 1e5, true}}, {{}}};
  told_state t{{}, {separated, separated}};
  for (int node = 0; node <= last; ++node) t.u.insert(t.u.end(), {height, 0.0});
  return judged(p, t);
}

}  // namespace

TEST_CASE("a correct state is certified, and every error in the certificate is below 1e-12") {
  const beam_problem p = span_with_pairs();
  const told_state right = right_state(p);
  REQUIRE(right.isep == std::vector<int>{in_contact, in_contact, separated, separated});
  const certificate c = judged(p, right);
  CHECK(c.certified);
  CHECK(c.unique);
  CHECK(c.problem.empty());
  CHECK(c.displacement_error < 1e-12);
  CHECK(c.worst_share < 1e-12);
  CHECK(c.equilibrium < 1e-15);
  CHECK(c.penetration == 0.0);
  CHECK(c.tension == 0.0);
}

TEST_CASE("an error of a state changes all measures of its certificate that it affects") {
  // A wrong status of a pair with a weak spring changes no force, so only penetration or tension shows it.
  const beam_problem p = span_with_pairs();
  const told_state right = right_state(p);
  using fault = std::tuple<std::function<void(told_state&)>, const char*, double>;
  const double middle = right.u[8];
  for (const auto& [put, wrong, in_w] :
       std::vector<fault>{{[](told_state& t) { t.u[8] *= 1 + 1e-4; }, "DSE", 1e-4},
                          {[](told_state& t) { t.u[5] += 1e-3; }, "DSE", 0},
                          {[](told_state& t) { t.isep[1] = separated; }, "SP", 0},
                          {[](told_state& t) { t.isep[0] = separated; }, "SP", 0},
                          {[](told_state& t) { t.isep[3] = in_contact; }, "ST", 0},
                          {[](told_state& t) { t.isep[2] = in_contact; }, "ST", 0}}) {
    INFO(wrong);
    told_state t = right;
    put(t);
    const certificate c = judged(p, t);
    CHECK(wrong_in(c) == wrong);
    CHECK(says(c, "may be off by"));
    CHECK_FALSE(c.certified);
    CHECK(c.displacement_error >= in_w * (1 - 1e-12));
    const double beyond = t.isep[0] == separated ? -0.1 - t.u[8] : -0.05 - t.u[6];
    const double off = t.isep[3] == in_contact ? t.u[14] + 0.2 : t.u[2] + 0.2;
    if (wrong[1] == 'P') CHECK(c.penetration == Approx(beyond / std::abs(middle)).epsilon(1e-10));
    if (wrong[1] == 'T') CHECK(c.tension == Approx(off / std::abs(middle)).epsilon(1e-10));
  }
  told_state t = right;
  t.u[8] = middle * (1 + 1e-11);
  CHECK(judged(p, t).certified);
}

TEST_CASE("the bounds show an error in w that hardly disturbs equilibrium") {
  // A nearly rigid beam on soft springs, with a deflection that is 1e-5 too large.
  beam_problem p = free_beam_on_springs(4.0, 4, 1e10, 1.0);
  p.steps = {{{}, {{{-1.0}, {}}}}};
  told_state t = right_state(p);
  for (std::size_t i = 0; i < t.u.size(); i += 2) t.u[i] *= 1 + 1e-5;
  const certificate c = judged(p, t);
  CHECK(wrong_in(c) == "DS");
  CHECK((c.displacement_error >= 0.999e-5 && c.displacement_error < 1e-4));
}

TEST_CASE("a missing force violates equilibrium, even on a stiff support, but not on a fixed dof") {
  const auto with_force = [](double stiffness, int node, double force) {  // the state does not know the force
    beam_problem p = span_with_pairs();
    p.pairs[0].stiffness = stiffness;
    const told_state t = right_state(p);
    p.steps[0].points = {{node, 0, force}};
    return judged(p, t);
  };
  CHECK(with_force(stiff, 4, 0).certified);
  CHECK(wrong_in(with_force(stiff, 4, -1e2)) == "DSE");
  CHECK(wrong_in(with_force(stiff, 2, -1e2)) == "DSE");
  CHECK(with_force(500, 0, -1e6).certified);  // a fixed dof, whose support carries the force
}

TEST_CASE("a pair exactly at its face may be separated or in contact in a certified state") {
  beam_problem p = span_with_pairs();
  p.supports.push_back({0, 1, true});
  p.steps = {{}};
  told_state t = right_state(p);
  p.pairs[2].face = 0.0;
  for (const int status : {in_contact, separated}) {
    t.isep[2] = status;
    CHECK(judged(p, t).certified);
  }
}

TEST_CASE("if there is no equilibrium, no state is found or certified, and the certificate says so") {
  beam_problem p = free_beam_on_springs(4.0, 4, 10.0, 1.0);
  p.steps = {tip_load(2, -1.0), tip_load(2, 1.0), tip_load(2, 1.0)};
  judge j(p);
  const solved_path found = certifier(j.what, j.s).find_final_states();
  CHECK(found.end.status == path_status::mechanism);
  CHECK(found.end.step == 2);
  REQUIRE(found.steps.size() == 1);
  CHECK(found.steps[0].displacement[4] < 0.0);
  p.steps = {{{}, {{{1.0}, {}}}}};
  const certificate c = judged(p, {std::vector<double>(10, 0.0), std::vector<int>(5, separated)});
  CHECK_FALSE(c.certified);
  CHECK(says(c, "there is no equilibrium"));
}

TEST_CASE(
    "if a rigid-body motion is free, displacements have no bound, but the certificate checks everything "
    "else") {
  beam_problem p{even_beam(4.0, 4, 1e3), {}, {{2, face_below, -0.1, 50.0, false}}, {}};
  p.steps = {{{}, {{{-2.0}, {}}}}};
  told_state t = right_state(p);
  for (std::size_t i = 0; i < 5; ++i) {  // rotates the beam about its pair
    t.u[2 * i] += 0.01 * (static_cast<double>(i) - 2);
    t.u[2 * i + 1] += 0.01;
  }
  const certificate c = judged(p, t);
  CHECK_FALSE(c.unique);
  CHECK(wrong_in(c).empty());
  CHECK(c.displacement_error == 0.0);
  for (std::size_t i = 0; i < 5; ++i) t.u[2 * i] -= 0.01;
  CHECK(wrong_in(judged(p, t)) == "SE");
}

TEST_CASE("the displacement error of an unloaded state is relative to the largest deflection of the path") {
  beam_problem p = span_with_pairs();
  p.steps.emplace_back();
  told_state loaded = right_state(p);
  told_state unloaded{std::vector<double>(loaded.u.size(), 0.0), std::vector<int>(4, separated)};
  CHECK(judged(p, right_state(p)).certified);
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
  CHECK(wrong_in(judged(p, unloaded)) == "DS");
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
  told_state t = right_state(p);
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
  const auto measured = [](double length, double force) {
    beam_problem p = span_with_pairs();
    for (double& x : p.geometry.x) x *= length;
    for (double& EI : p.geometry.EI) EI *= force * length * length;
    for (contact_pair& c : p.pairs) {
      c.face *= length;
      c.stiffness *= force / length;
    }
    p.steps[0].distributed[0].polynomial[0] *= force / length;
    told_state t = right_state(p);
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
      for (double certificate::*const error : std::vector<double certificate::*>{
               &certificate::equilibrium, &certificate::penetration, &certificate::tension})
        CHECK(there.*error == Approx(here.*error).epsilon(1e-8));
      for (const auto bound : {&certificate::displacement_error, &certificate::worst_share})
        CHECK(there.*bound == Approx(here.*bound).epsilon(0.5));  // scales are powers of 2
    }
  }
}

TEST_CASE("a state with a NaN or infinite displacement at any dof is not certified") {
  const beam_problem p = span_with_pairs();
  for (const double odd : {std::nan(""), HUGE_VAL}) {
    for (const std::size_t dof : {5, 8, 10}) {
      told_state t = right_state(p);
      t.u[dof] = odd;
      CHECK_FALSE(judged(p, t).certified);
      CHECK_FALSE(judged(p, t).problem.empty());
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
    early_toggles early;
    const judged_run r(p.as_problem(), kernel, false, "refactor", &early);
    REQUIRE(r.end.status == path_status::solved);
    REQUIRE(early.all().size() == 1);
    const early_toggle& e = early.all()[0];
    CHECK((e.step == 2 && e.number == 1 && e.what == event{1, change::make}));
    CHECK(e.distance == Approx(0.006 * 0.003).epsilon(1e-9));
    CHECK(e.share == Approx(0.003).epsilon(1e-9));
    REQUIRE(r.steps.size() == 2);
    CHECK(r.of_step(1).certified);
    CHECK_FALSE(r.of_step(2).certified);
    CHECK(r.of_step(2).displacement_error > 1e-5);
  }
}

TEST_CASE("the reference solution replaces a state without a proof") {
  const problem stop = cantilever_over_a_stop().as_problem();
  const linear_structure s = structure_of(stop);
  certifier proof(stop, s);
  // The limit of one increment is enough only for the first step, which has no contact.
  const solved_path path = follow(stop, s, "refactor", *make_kernel("corrected"), {}, &proof, 1);
  REQUIRE(path.end.status == path_status::solved);
  REQUIRE(path.steps.size() == 4);
  CHECK((path.steps[0].from == origin::path && path.steps[1].from == origin::reference));
  CHECK(path.all_certified());

  structure_state far{
      .step = 2, .fraction = 1.0, .displacement = std::vector<double>(s.dofs()), .isep = {in_contact}};
  far.displacement[4] = 1.0;
  path_end end{path_status::solved, 2};
  const std::optional<solved_step> settled = certifier(stop, s).settle(end, far);
  REQUIRE(settled);
  const double f = 8.0 / 3 / 1e4;
  CHECK(settled->displacement[4] == Approx(-0.004 - (60 * f - 0.004) / (f + 1 / 5e4) / 5e4).epsilon(1e-14));
  CHECK(settled->isep == std::vector<int>{in_contact});
  CHECK(settled->numbers.any());

  far.fraction = std::nextafter(1.0, 0.0);  // a step that did not reach its full load has no certificate
  end = {path_status::cycle, 2, far.fraction, {}, {}, {}, false, true};
  CHECK_FALSE(certifier(stop, s).settle(end, far)->judged);
}

TEST_CASE("without load, a beam without supports is certified above its faces, but not below them") {
  for (const double height : {0.1, -0.1}) {
    CHECK(lying_at(height, {0, 1}).certified == (height > 0.0));
    CHECK_FALSE(lying_at(height, {0, 1}).unique);
  }
  for (const double shortest : {0.5, 1e-9}) {  // for 1e-9 the reference solution has no factor
    const certificate beyond = lying_at(-1, {0, 1, 1 + shortest, 3});
    CHECK_FALSE(beyond.certified);
    CHECK_FALSE(beyond.problem.empty());
  }
}
