// Tests settling supports against textbook formulas for continuous beams, with every engine, with and without
// contact.
#include <cmath>
#include <stdexcept>

#include "catch.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/path/solve_problem.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

constexpr double rounding = 1e-11;

/// Returns a beam over two spans of length 3 `unit`, of four elements each, with three pinned nodes.
problem two_spans(double unit = 1.0, double EI = 1e4) {
  problem p;
  beam b;
  for (int i = 0; i <= 8; ++i) b.x.push_back(unit * i * 0.75);
  b.EI.assign(8, EI);
  p.geometry = {b};
  p.supports = {{0, 0, true}, {4, 0, true}, {8, 0, true}};
  return p;
}

struct solved_path {
  path_end end;
  recorder seen;
  std::vector<std::optional<certificate>> certificates;
  [[nodiscard]] const std::vector<double>& u(std::size_t step) const { return seen.steps.at(step - 1).u; }
};

solved_path follow_certified(const problem& p, const std::string& engine = "refactor",
                             const std::string& kernel = "fortran") {
  const linear_structure s = structure_of(p);
  certifier judged(p, s);
  solved_path path;
  path.end = follow(p, s, engine, *make_kernel(kernel), {&judged, &path.seen}, {0, judged.ends()});
  path.certificates = judged.steps();
  for (const auto& c : path.certificates) CHECK(c.value().certified);
  return path;
}

load settle(int node, double value) {
  return {{}, {}, {{node, 0, value}}};
}

std::vector<double> reactions_at_end(const problem& p, const solved_path& path, std::size_t step) {
  return reactions(p, p.steps[step - 1], path.u(step), path.seen.steps[step - 1].isep);
}

}  // namespace

TEST_CASE("If the middle support of two spans l settles by d, it pulls with the force 6 EI d / l^3") {
  for (const double unit : {1e-9, 1.0, 1e9}) {
    problem p = two_spans(unit);
    const double l = 3 * unit;
    const double d = -0.01 * unit;
    p.steps = {settle(4, d)};
    const solved_path path = follow_certified(p);
    REQUIRE(path.end.status == path_status::solved);
    CHECK(path.u(1)[8] == d);  // to the bit
    const std::vector<double> r = reactions_at_end(p, path, 1);
    const double middle = 6 * 1e4 * d / (l * l * l);
    CHECK(r[1] == Approx(middle).epsilon(rounding));
    CHECK(r[0] == Approx(-middle / 2).epsilon(rounding));
    CHECK(r[2] == Approx(-middle / 2).epsilon(rounding));
    CHECK(path.u(1)[4] == Approx(d * 11 / 16).epsilon(rounding));  // (3 l^2 x - x^3) / 2 l^3 at x = l / 2
  }
}

TEST_CASE("Equal settlements of all supports move a beam without bending it") {
  problem p = two_spans();
  p.steps = {{{}, {}, {{0, 0, -0.5}, {4, 0, -0.5}, {8, 0, -0.5}}}};
  const solved_path path = follow_certified(p, "refactor", "corrected");
  for (std::size_t node = 0; node < 9; ++node) CHECK(path.u(1)[2 * node] == Approx(-0.5).epsilon(1e-12));
  for (const double r : reactions_at_end(p, path, 1)) CHECK(std::abs(r) < 1e-9);
}

TEST_CASE("Forces that are only rounding are not certified") {
  problem p = two_spans();
  p.steps = {{{}, {}, {{0, 0, -0.5}, {4, 0, -0.5}, {8, 0, -0.5}}}};
  const linear_structure s = structure_of(p);
  certifier judged(p, s);
  (void)follow(p, s, "refactor", *make_kernel("fortran"), {&judged});
  REQUIRE(judged.steps().size() == 1);
  CHECK_FALSE(judged.steps()[0]->certified);
  CHECK(judged.steps()[0]->proved);
}

TEST_CASE("A clamp that rotates by t has the moment 4 EI t / l if the other end of the beam is clamped") {
  problem p = two_spans();
  p.supports = {{0, 0, true}, {0, 1, true}, {8, 0, true}, {8, 1, true}};
  p.steps = {{{}, {}, {{0, 1, 0.002}}}};
  const solved_path path = follow_certified(p);
  const std::vector<double> r = reactions_at_end(p, path, 1);
  CHECK(r[1] == Approx(4 * 1e4 * 0.002 / 6).epsilon(rounding));
  CHECK(r[3] == Approx(2 * 1e4 * 0.002 / 6).epsilon(rounding));
}

TEST_CASE(
    "If a support settles onto a face, contact is at the proportional share, and the next step ends "
    "contact") {
  problem p = two_spans();
  p.supports = {{0, 0, true}, {8, 0, true}};
  p.pairs = {{4, face_below, -0.005, 2e3, false}};
  p.steps = {settle(8, -0.04), settle(8, -0.02), {}};
  for (const std::string& engine : engine_names()) {
    CAPTURE(engine);
    const solved_path path = follow_certified(p, engine);
    REQUIRE(path.seen.increments.size() == 5);
    // The middle moves half as far as the support.
    CHECK(path.seen.increments[0].fraction == Approx(0.25).epsilon(1e-12));
    CHECK(path.seen.increments[0].events.size() == 1);
    // After contact, the spring k and the beam, with 48 EI / L^3 at midspan, act in parallel.
    const double beam_k = 48 * 1e4 / 216.0;
    const double w = (-0.02 * beam_k - 0.005 * 2e3) / (beam_k + 2e3);
    CHECK(path.u(1)[8] == Approx(w).epsilon(1e-10));
    const std::vector<double> r = reactions_at_end(p, path, 1);
    const double contact = -2e3 * (w + 0.005);
    CHECK(r[0] == Approx(-contact / 2).epsilon(1e-9));
    CHECK(path.u(2)[8] == Approx((-0.01 * beam_k - 0.005 * 2e3) / (beam_k + 2e3)).epsilon(1e-10));
    CHECK(path.seen.increments[3].events.at(0).what == change::break_);
    CHECK(path.u(3)[8] == Approx(0.0).margin(1e-15));
  }
}

TEST_CASE(
    "The reaction of a support that settles does not contain the contact force of a pair at the same node") {
  problem p = two_spans();
  p.pairs = {{4, face_below, -0.004, 3e4, false}, {4, face_above, 0.0, 1e5, true}};
  p.steps = {settle(4, -0.01)};
  for (const std::string& engine : engine_names()) {
    CAPTURE(engine);
    const solved_path path = follow_certified(p, engine, "corrected");
    REQUIRE(path.seen.steps[0].isep == std::vector<int>{in_contact, separated});
    const std::vector<double> r = reactions_at_end(p, path, 1);
    const double beam_needs = 6 * 1e4 * -0.01 / 27;
    CHECK(r[1] == Approx(beam_needs - 3e4 * 0.006).epsilon(1e-10));
    CHECK(r[0] + r[1] + r[2] + 3e4 * 0.006 == Approx(0.0).margin(1e-10));
  }
}

TEST_CASE("The displacements of loads and settlements add up, on a plate and on a matrix") {
  problem p;
  p.geometry = {plate{{0, 1, 2, 3}, {0, 1, 2}, 100.0, 0.3}};
  for (const int node : {0, 3, 8, 11}) p.supports.push_back({node, 0, true});
  const load both{{{5, 0, -4.0}}, {{{-2.0}, {}}}, {{11, 0, -0.1}}};
  p.steps = {both, {both.points, both.distributed, {}}, {{}, {}, both.settlements}};
  const solved_path path = follow_certified(p);
  for (std::size_t dof = 0; dof < path.u(1).size(); ++dof)
    CHECK(path.u(1)[dof] == Approx(path.u(2)[dof] + path.u(3)[dof]).epsilon(1e-9).margin(1e-13));
  CHECK(path.u(3)[15] == Approx(-0.1 / 6).epsilon(1e-10));  // w = -0.1 x y / 6 between the four corners
  CHECK(path.u(3)[33] == -0.1);

  const linear_structure s = build(p.geometry, {}, {});
  assembled a;
  a.stiffness = entries_of(s);
  a.rows = s.rows;
  for (const bool as_band : {true, false}) {
    if (!as_band && !sparse_factor::available()) continue;
    problem q;
    a.as_band = as_band;
    q.geometry = {a};
    for (const int node : {0, 3, 8, 11}) q.supports.push_back({3 * node, 0, true});
    q.steps = {{{}, {}, {{33, 0, -0.1}}}};
    const solved_path same = follow_certified(q, as_band ? "refactor" : "updated");
    for (std::size_t dof = 0; dof < same.u(1).size(); ++dof)
      CHECK(same.u(1)[dof] == Approx(path.u(3)[dof]).epsilon(1e-10).margin(1e-13));
  }
}

TEST_CASE(
    "The reference solution equals the state of the path after a settlement, and a wrong settlement is not "
    "certified") {
  problem p = two_spans();
  p.pairs = {{2, face_below, -0.001, 1e5, false}, {6, face_above, 0.002, 1e5, false}};
  p.steps = {{{{6, 0, 300.0}}, {}, {{4, 0, -0.01}, {0, 0, 0.003}}}};
  const solved_path path = follow_certified(p, "refactor", "corrected");
  const linear_structure s = structure_of(p);
  recorder ends;
  observer* const observers[] = {&ends};
  CHECK(certifier(p, s).find_final_states(observers).status == path_status::solved);
  for (std::size_t dof = 0; dof < path.u(1).size(); ++dof)
    CHECK(ends.steps.at(0).u[dof] == Approx(path.u(1)[dof]).epsilon(1e-10).margin(1e-15));
  certifier judged(p, s);
  std::vector<double> u = path.u(1);
  u[8] *= 1 + 1e-5;
  judged.step_ended({1, 1.0, u, path.seen.steps[0].isep, 1e-3});
  CHECK_FALSE(judged.all_certified());
}

TEST_CASE("add_settlements refuses a dof for which the structure was built without settlements") {
  problem p = two_spans();
  p.steps = {settle(4, -0.01)};
  const linear_structure rigid = build(p.geometry, p.supports, p.pairs);
  std::vector<double> f(rigid.dofs());
  CHECK_THROWS_AS(add_settlements(rigid, p.steps[0], f), std::logic_error);
}
