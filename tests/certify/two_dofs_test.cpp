// Tests pairs between two dofs of a matrix: beams that meet, and bodies held only by another body.
#include <cmath>

#include "catch.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/certify/reference_solution.hpp"
#include "contct/exact/exact_means.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/path/path_observers.hpp"
#include "contct/path/solve_problem.hpp"
#include "support/beams.hpp"

using namespace contct;

namespace {

problem on_matrix(sparse_matrix k, std::vector<contact_pair> pairs, std::vector<load> steps) {
  assembled a;
  a.stiffness = std::move(k);
  problem p;
  p.geometry.kind = std::move(a);
  p.pairs = std::move(pairs);
  p.steps = std::move(steps);
  return p;
}

struct met {
  path_end end;
  recorder seen;
  [[nodiscard]] const std::vector<double>& u(std::size_t step) const { return seen.steps.at(step - 1).u; }
};

met follow_met(const problem& p, const std::string& engine, const std::string& kernel) {
  const linear_structure s = structure_of(p);
  // Exact arithmetic proves that a free body's matrix is semidefinite.
  certifier judged(p, s, exact_means_of(p));
  met path;
  path.end = follow(p, s, engine, *make_kernel(kernel), {&judged, &path.seen}, {0, judged.ends()});
  for (const auto& c : judged.steps())
    if (path.end.status == path_status::solved) CHECK(c.value().certified);
  return path;
}

/// Calls `check` for K as a band and by columns, for every engine, and for each rule of `rules`.
template <class Check>
void in_every_storage(problem p, const std::vector<std::string>& rules, const Check& check) {
  for (const bool as_band : {true, false}) {
    if (!as_band && !sparse_factor::available()) continue;
    std::get<assembled>(p.geometry.kind).as_band = as_band;
    for (const std::string engine : {"refactor", "updated"}) {
      for (const std::string& kernel : rules) {
        CAPTURE(as_band, engine, kernel);
        check(follow_met(p, engine, kernel));
      }
    }
  }
}

load force(int dof, double value) {
  return {{{dof, 0, value}}, {}};
}

/// Returns two cantilevers with 3 EI / l^3 of 3750 and 60000 and tips at a distance of 0.002. The dofs are
/// the deflection and the slope of each tip.
problem two_cantilevers() {
  return on_matrix({4,
                    {{0, 0, 15000},
                     {1, 0, -15000},
                     {1, 1, 20000},
                     {2, 0, 0},
                     {2, 2, 240000},
                     {3, 2, -120000},
                     {3, 3, 80000}}},
                   {{0, face_below, -0.002, 1e5, false, 2}}, {force(0, -15), {}, force(0, -15)});
}

/// Returns springs in series: 200 to the ground, 100, the pair with 600, and 50.
problem chain(double face) {
  return on_matrix(
      {4, {{0, 0, 300}, {1, 0, -100}, {1, 1, 100}, {2, 1, 0}, {2, 2, 50}, {3, 2, -50}, {3, 3, 50}}},
      {{2, face_below, face, 600.0, face == 0.0, 1}}, {force(3, -9)});
}

}  // namespace

TEST_CASE("Two cantilevers that meet press on each other with (F / k1 - gap) / (1 / k1 + 1 / k2 + 1 / k)") {
  in_every_storage(two_cantilevers(), {"fortran", "corrected"}, [](const met& path) {
    REQUIRE(path.end.status == path_status::solved);
    CHECK(path.seen.increments[0].fraction == Approx(0.5).epsilon(1e-12));
    const double pressed = 75.0 / 11;
    CHECK(path.u(1)[0] == Approx(-(15 - pressed) / 3750).epsilon(1e-11));
    CHECK(path.u(1)[2] == Approx(-pressed / 60000).epsilon(1e-11));
    CHECK(path.u(1)[3] == Approx(1.5 * path.u(1)[2]).epsilon(1e-11));  // the tip's slope is 3 w / 2 l
    for (const double u : path.u(2)) CHECK(std::abs(u) < 1e-15);
    CHECK(path.u(3)[2] == Approx(path.u(1)[2]).epsilon(1e-11));
  });
}

TEST_CASE(
    "The 1989 kernels get the difference of a pair's two dofs in an additional row, and give equal answers") {
  const problem p = two_cantilevers();
  struct : observer {
    void called(const answered_call& c) override {
      CHECK(c.c.id[0] == 5);  // the row after the four dofs
      CHECK(c.c.dd.size() == 5);
      rows.push_back(c.c.dd[4]);
    }
    std::vector<double> rows;
  } calls;
  const linear_structure s = structure_of(p);
  const auto leader = make_kernel("fortran");
  const std::vector<std::string> followers = {"cpp"};
  lockstep_on_path watched(leader->facts(), followers);
  CHECK(follow(p, s, "refactor", *leader, {&watched, &calls}).status == path_status::solved);
  CHECK(watched.calls() == 6);
  CHECK(watched.compared().mismatches == 0);
  REQUIRE(calls.rows.size() == 6);
  CHECK(calls.rows[1] == Approx(-0.002).epsilon(1e-12));
  CHECK(calls.rows[2] == Approx(-0.002 - 75.0 / 11 / 1e5).epsilon(1e-10));  // c - C / k
}

TEST_CASE("A pair that alone holds a body acts as a spring in series with the springs of both bodies") {
  in_every_storage(chain(0.0), {"fortran", "corrected"}, [](const met& path) {
    REQUIRE(path.end.status == path_status::solved);
    CHECK(path.u(1)[3] == Approx(-9.0 / 200 - 9.0 / 100 - 9.0 / 600 - 9.0 / 50).epsilon(1e-11));
  });
}

TEST_CASE(
    "A free body moves across the gap until it meets another body, and in the opposite direction its path "
    "fails") {
  in_every_storage(chain(-0.01), {"corrected"}, [](const met& path) {
    REQUIRE(path.end.status == path_status::solved);
    CHECK(path.seen.increments.at(0).snaps);
    CHECK(path.u(1)[3] == Approx(-0.01 - 0.33).epsilon(1e-11));
  });
  problem away = chain(0.0);
  away.steps = {force(3, 9)};
  CHECK(follow_met(away, "refactor", "corrected").end.status != path_status::solved);
}

TEST_CASE("A pair between two dofs of one free body removes no rigid-body motion of the body") {
  const problem p =
      on_matrix({2, {{0, 0, 1}, {1, 0, -1}, {1, 1, 1}}}, {{0, face_below, 0.0, 5.0, true, 1}}, {force(0, 0)});
  const linear_structure s = structure_of(p);
  REQUIRE(s.rigid_motions == 1);
  CHECK_FALSE(s.is_held(s.held_by([](std::size_t) { return true; })));
}

TEST_CASE("A dof may be in a pair with the ground and in a pair with a second dof") {
  const problem p = on_matrix({2, {{0, 0, 300}, {1, 0, 0}, {1, 1, 200}}},
                              {{0, face_below, -0.01, 600.0, false, 1}, {0, face_below, -0.02, 500.0, false}},
                              {force(0, -30)});
  in_every_storage(p, {"fortran", "corrected"}, [](const met& path) {
    const double w = -(30 + 11.5) / 950;  // 300 w + 600 (w / 4 + 0.0025) + 500 (w + 0.02) = -30
    CHECK(path.u(1)[0] == Approx(w).epsilon(1e-11));
    CHECK(path.u(1)[1] == Approx(0.75 * w + 0.0075).epsilon(1e-11));
    CHECK(path.seen.steps[0].isep == std::vector<int>{in_contact, in_contact});
  });
}

TEST_CASE("A face that moves between two dofs reduces the gap of the pair") {
  problem p = on_matrix({2, {{0, 0, 300}, {1, 0, 0}, {1, 1, 200}}}, {{0, face_below, -0.01, 600.0, false, 1}},
                        {force(0, -9)});
  p.steps[0].moves = {{0, 0, 0.005}};
  in_every_storage(p, {"fortran", "corrected"}, [](const met& path) {
    const double pressed = (0.03 - 0.005) / (1 / 300.0 + 1 / 200.0 + 1 / 600.0);
    CHECK(path.u(1)[1] == Approx(-pressed / 200).epsilon(1e-11));
    CHECK(path.u(1)[0] == Approx(-(9 - pressed) / 300).epsilon(1e-11));
  });
}

TEST_CASE("A state is not certified if one of the two dofs of a pair has a relative error of 1e-4") {
  const problem p = two_cantilevers();
  const linear_structure s = structure_of(p);
  const met path = follow_met(p, "refactor", "corrected");
  for (const std::size_t dof : {0, 2}) {
    std::vector<double> u = path.u(1);
    u[dof] *= 1 + 1e-4;
    certifier judged(p, s);
    judged.step_ended({1, 1.0, u, path.seen.steps[0].isep, 1e-3});
    CHECK_FALSE(judged.all_certified());
  }
}

TEST_CASE("If both dofs of a stiff pair are wrong by 1e-4, the error bound of the state is at least 1e-4") {
  const problem p =
      on_matrix({2, {{0, 0, 1}, {1, 0, 0}, {1, 1, 1}}}, {{0, face_below, 0.0, 1e6, true, 1}}, {force(0, -3)});
  const linear_structure s = structure_of(p);
  std::vector<double> u = follow_met(p, "refactor", "corrected").u(1);
  for (double& x : u) x -= 1e-4;
  const std::vector<int> isep = {in_contact};
  certifier judged(p, s);
  judged.step_ended({1, 1.0, u, isep, 1e-3});
  REQUIRE(judged.steps().at(0).has_value());
  CHECK(judged.steps()[0]->error[quantity::w].value_or(1.0) >= 0.999e-4);
}

TEST_CASE("The reference solution of two cantilevers that press on each other equals the closed form") {
  const problem p = two_cantilevers();
  const linear_structure s = structure_of(p);
  const std::vector<double> load = {-15, 0, 0, 0};
  const reference_answer answer = reference_solver(s).solve(load, {});
  REQUIRE(answer.how == reference_answer::outcome::found);
  CHECK(answer.displacement[2] == Approx(-75.0 / 11 / 60000).epsilon(1e-11));
}
