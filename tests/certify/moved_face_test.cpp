// Tests faces that steps move: jacking, racks that settle and interference fits, with every engine and rule.
#include <cmath>

#include "catch.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/path/solve_problem.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

struct moved_path {
  path_end end;
  recorder seen;
  [[nodiscard]] const std::vector<double>& u(std::size_t step) const { return seen.steps.at(step - 1).u; }
};

/// Follows the path, and checks that every final state is certified.
moved_path follow_moved(const problem& p, const std::string& engine, const std::string& kernel) {
  const linear_structure s = structure_of(p);
  certifier judged(p, s);
  moved_path path;
  path.end = follow(p, s, engine, *make_kernel(kernel), {&judged, &path.seen}, {0, judged.ends()});
  for (const auto& c : judged.steps()) CHECK(c.value().certified);
  return path;
}

template <class Check>
void on_every_way(const problem& p, const Check& check) {
  for (const std::string& engine : engine_names()) {
    if (engine == "condensed" && !std::holds_alternative<beam>(p.geometry.kind)) continue;
    for (const std::string kernel : {"fortran", "corrected"}) {
      CAPTURE(engine, kernel);
      check(follow_moved(p, engine, kernel));
    }
  }
}

load moving(int node, double distance) {
  load l;
  l.moves = {{node, 0, distance}};
  return l;
}

double force_at(const problem& p, std::size_t step, std::size_t pair, const moved_path& path) {
  const contact_pair at = pairs_under(p, p.steps[step - 1])[pair];
  const std::size_t dof = std::size_t{1} * at.node * dofs_per_node(p.geometry);
  return force_of(at, path.u(step)[dof], path.seen.steps[step - 1].isep[pair] == in_contact);
}

/// A cantilever with 3 EI / l^3 = 3750 at its tip.
problem cantilever() {
  problem p;
  p.geometry.kind = even_beam(2.0, 4, 1e4);
  p.supports = {{0, 0, true}, {0, 1, true}};
  p.pairs = {{4, face_below, -0.004, 5e4, false}};
  return p;
}

}  // namespace

TEST_CASE("A stop raised by m under a cantilever presses with the force (m - gap) / (1 / k + l^3 / 3 EI)") {
  problem p = cantilever();
  p.steps = {moving(4, 0.01), {}};
  on_every_way(p, [&](const moved_path& path) {
    REQUIRE(path.end.status == path_status::solved);
    CHECK(path.seen.increments.at(0).fraction == Approx(0.4).epsilon(1e-12));  // gap / move
    const double force = 0.006 / (1 / 5e4 + 1 / 3750.0);
    CHECK(force_at(p, 1, 0, path) == Approx(force).epsilon(1e-9));
    CHECK(path.u(1)[8] == Approx(force / 3750).epsilon(1e-10));
    CHECK(path.u(1)[4] == Approx(force / 3750 * 5 / 16).epsilon(1e-10));  // x^2 (3 l - x) / 2 l^3 at l / 2
    CHECK(reactions(p, p.steps[0], path.u(1), path.seen.steps[0].isep)[0] == Approx(-force).epsilon(1e-9));
    CHECK(path.u(2)[8] == Approx(0.0).margin(1e-12));  // a step without a move returns the face to its place
    CHECK(path.seen.steps[1].isep[0] == separated);
  });
}

TEST_CASE(
    "A support that moves down separates from the beam at the deflection that the beam has without this "
    "support") {
  problem p;
  p.geometry.kind = even_beam(6.0, 4, 1e4);
  p.supports = {{0, 0, true}, {4, 0, true}};
  p.pairs = {{2, face_below, 0.0, 5e4, true}};
  const double alone = 5 * 8.0 * std::pow(6.0, 4) / (384 * 1e4);  // 5 q L^4 / 384 EI
  load down = moving(2, -2 * alone);
  down.distributed = {{{-8.0}, {}}};
  p.steps = {{{}, down.distributed}, down};
  on_every_way(p, [&](const moved_path& path) {
    const double beam_k = 48 * 1e4 / 216;
    CHECK(force_at(p, 1, 0, path) == Approx(alone / (1 / 5e4 + 1 / beam_k)).epsilon(1e-9));
    REQUIRE(path.seen.increments.size() == 3);
    CHECK(path.seen.increments[1].fraction == Approx(0.5).epsilon(1e-10));
    CHECK(path.seen.increments[1].events.at(0).what == change::break_);
    CHECK(path.u(2)[4] == Approx(-alone).epsilon(1e-10));
    const contact_pair at = pairs_under(p, p.steps[1])[0];
    CHECK(gap_of(at, path.u(2)[4], false) == Approx(alone).epsilon(1e-9));
  });
}

TEST_CASE(
    "A spring of stiffness K and a pair of stiffness k that overlap by m have the force m / (1 / K + 1 / "
    "k)") {
  assembled a;
  a.stiffness = {1, {{0, 0, 300.0}}};
  problem p;
  p.geometry.kind = a;
  p.pairs = {{0, face_below, 0.0, 700.0, true}};
  p.steps = {moving(0, 0.02)};
  on_every_way(p, [&](const moved_path& path) {
    CHECK(force_at(p, 1, 0, path) == Approx(0.02 / (1 / 300.0 + 1 / 700.0)).epsilon(1e-12));
    CHECK(path.u(1)[0] == Approx(0.014).epsilon(1e-12));
  });
}

TEST_CASE("A face moves by the product of the value and the factor of its move") {
  problem p = cantilever();
  p.steps = {moving(4, 0.01), moving(4, 0.004)};
  p.steps[1].moves[0].factor = 2.5;
  on_every_way(p, [](const moved_path& path) {
    CHECK(path.u(2)[8] == Approx(path.u(1)[8]).epsilon(1e-10));
    CHECK(path.seen.increments.size() == 3);
  });
}

TEST_CASE("If a node is fixed in w, a face that moves at this node loads only the support of the node") {
  problem p = cantilever();
  p.supports.push_back({4, 0, true});
  p.steps = {moving(4, 0.01)};
  on_every_way(p, [&](const moved_path& path) {
    for (const double u : path.u(1)) CHECK(u == Approx(0.0).margin(1e-15));
    CHECK(force_at(p, 1, 0, path) == Approx(5e4 * 0.006).epsilon(1e-12));
    CHECK(reactions(p, p.steps[0], path.u(1), path.seen.steps[0].isep)[2] ==
          Approx(-5e4 * 0.006).epsilon(1e-12));
  });
}

TEST_CASE("A face that moves up lifts a beam that rests only on faces, and the beam moves as a rigid body") {
  problem p;
  p.geometry.kind = even_beam(4.0, 2, 1e4);
  p.pairs = {{0, face_below, 0.0, 1e4, true}, {2, face_below, 0.0, 1e4, true}};
  load lifted = moving(2, 0.03);
  lifted.points = {{1, 0, -10.0}};
  p.steps = {{lifted.points, {}}, lifted};
  on_every_way(p, [](const moved_path& path) {
    CHECK(path.u(2)[0] == Approx(-5e-4).epsilon(1e-9));
    CHECK(path.u(2)[4] == Approx(0.03 - 5e-4).epsilon(1e-9));
    CHECK(path.u(2)[2] - path.u(1)[2] == Approx(0.015).epsilon(1e-9));
  });
}

TEST_CASE(
    "for a pair whose face moves, FORTRAN and C++ get an additional entry of DD and DTEST, and give equal "
    "answers") {
  problem p = cantilever();
  p.steps = {moving(4, 0.01), moving(4, -0.01)};
  struct : observer {
    void called(const answered_call& c) override {
      CHECK(c.c.cc[0] == -0.004);
      rows.push_back(c.c.dd[8]);
    }
    std::vector<double> rows;
  } calls;
  const linear_structure s = structure_of(p);
  const auto leader = make_kernel("fortran");
  const std::vector<std::string> followers = {"cpp"};
  lockstep_on_path watched(leader->facts(), followers);
  CHECK(follow(p, s, "refactor", *leader, {&watched, &calls}).status == path_status::solved);
  CHECK(watched.calls() == 4);
  CHECK(watched.compared().values > 0);
  CHECK(watched.compared().mismatches == 0);
  REQUIRE(calls.rows.size() == 4);
  CHECK(calls.rows[1] == Approx(-0.004).epsilon(1e-12));               // w - m = 0 - 0.004
  CHECK(calls.rows[2] == Approx(-0.01 + 0.0055813953).epsilon(1e-7));  // 0.006 / (1 + 3750 / k) - m
}

TEST_CASE("A state computed for a face that is wrong by 1e-6 is not certified") {
  problem p = cantilever();
  p.steps = {moving(4, 0.01)};
  const linear_structure s = structure_of(p);
  const moved_path path = follow_moved(p, "refactor", "corrected");
  p.steps[0].moves[0].value = 0.010001;
  certifier judged(p, s);
  judged.step_ended({1, 1.0, path.u(1), path.seen.steps[0].isep, 1e-3});
  CHECK_FALSE(judged.all_certified());
}
