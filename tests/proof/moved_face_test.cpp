// Tests faces that steps move, settling supports, and pairs between two dofs of a matrix against closed
// forms, with every engine and rule.
#include <cmath>
#include <sstream>

#include "catch.hpp"
#include "contct/linear/sparse_factor.hpp"
#include "contct/proof/reference_solution.hpp"
#include "contct/results/path_observers.hpp"
#include "support/judged_run.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

load moving(int node, double distance) {
  load l;
  l.moves = {{node, 0, distance}};
  return l;
}

/// A cantilever with 3 EI / l^3 = 3750 at its tip.
problem cantilever(std::vector<load> steps) {
  beam_problem p{
      even_beam(2.0, 4, 1e4), {{0, 0, true}, {0, 1, true}}, {{4, face_below, -0.004, 5e4, false}}, {}};
  p.steps = std::move(steps);
  return p.as_problem();
}

/// Returns a beam over two spans of length 3 `unit`, of four elements each, with three pinned nodes.
problem two_spans(std::vector<load> steps, double unit = 1.0) {
  return beam_problem{
      even_beam(6 * unit, 8, 1e4), {{0, 0, true}, {4, 0, true}, {8, 0, true}}, {}, std::move(steps)}
      .as_problem();
}

load settle(int node, double value) {
  return {{}, {}, {{node, 0, value}}};
}

/// Checks numbers of certified paths with every engine, with K as a band and by columns, and with each
/// kernel: the share s of an increment, u of a dof, the force f of a pair or the reaction r of a support,
/// from 0, after a step: "s0 u1.8 f1.0". `allowed` is relative to the expected number, or absolute for 0.
void check_paths(const char* fact, problem p, const std::string& keys, const std::vector<double>& expected,
                 const std::vector<std::string>& kernels = {"fortran", "corrected"}, double allowed = 1e-10) {
  auto* const matrix = std::get_if<assembled>(&p.geometry.kind);
  for (const bool as_band : {true, false}) {
    if (!as_band && (matrix == nullptr || !sparse_factor::available())) continue;
    if (matrix != nullptr) matrix->as_band = as_band;
    with_every_engine(
        p,
        [&](const judged_run& path) {
          std::istringstream words(keys);
          std::size_t compared = 0;
          for (std::string key; words >> key; ++compared) {
            const std::size_t first = key[1] - '0';
            const std::size_t second = key.size() > 2 ? std::stoul(key.substr(3)) : 0;
            const double found = key[0] == 's'   ? path.share(first)
                                 : key[0] == 'u' ? path.u(first).at(second)
                                 : key[0] == 'f' ? path.force(first, second)
                                                 : path.held(first).at(second);
            INFO(fact << ", " << key << ": " << found);
            const double right = expected.at(compared);
            CHECK(found == Approx(right).epsilon(allowed).margin(right == 0 ? allowed : 0));
          }
          CHECK(compared == expected.size());
        },
        kernels);
  }
}

/// Returns springs in series: 200 to the ground, 100, the pair with 600, and 50.
problem chain(double face, double load = -9) {
  return on_matrix(
      {4, {{0, 0, 300}, {1, 0, -100}, {1, 1, 100}, {2, 1, 0}, {2, 2, 50}, {3, 2, -50}, {3, 3, 50}}},
      {{2, face_below, face, 600.0, face == 0.0, 1}}, {force_at(3, load)});
}

/// Follows the path of FORTRAN in lockstep with C++, and returns one row of DD in each call. Checks that the
/// ID of pair 1 is 5, and that CC is its face.
std::vector<double> rows_of_calls(const problem& p, double face, std::size_t row) {
  struct : observer {
    void called(const answered_call& c) override {
      CHECK(c.c.id[0] == 5);
      faces.push_back(c.c.cc[0]);
      rows.emplace_back(c.c.dd.begin(), c.c.dd.end());
    }
    std::vector<double> faces;
    std::vector<std::vector<double>> rows;
  } calls;
  const linear_structure s = structure_of(p);
  const auto leader = make_kernel("fortran");
  const std::vector<std::string> followers = {"cpp"};
  lockstep_on_path watched(leader->facts(), followers);
  CHECK(follow(p, s, "refactor", *leader, {&watched, &calls}).end.status == path_status::solved);
  CHECK(watched.compared().values > 0);
  CHECK(watched.compared().mismatches == 0);
  CHECK(calls.faces == std::vector<double>(calls.faces.size(), face));
  std::vector<double> at_row;
  for (const auto& dd : calls.rows) at_row.push_back(dd.at(row));
  return at_row;
}

}  // namespace

TEST_CASE("paths with faces that move have the shares, displacements and forces of closed forms") {
  const double force = 0.006 / (1 / 5e4 + 1 / 3750.0);  // of the stop
  check_paths(
      "A stop raised by m under a cantilever presses with (m - gap) / (1 / k + l^3 / 3 EI), and returns",
      cantilever({moving(4, 0.01), {}}), "s0 f1.0 u1.8 u1.4 r1.0 u2.8 f2.0",
      {0.4, force, force / 3750, force / 3750 * 5 / 16, -force, 0, 0});
  load scaled = moving(4, 0.004);
  scaled.moves[0].factor = 2.5;
  check_paths("A face moves by the product of the value and the factor of its move",
              cantilever({moving(4, 0.01), scaled}), "u1.8 u2.8 s2", {force / 3750, force / 3750, 1});
  problem fixed = cantilever({moving(4, 0.01)});
  fixed.supports.push_back({4, 0, true});
  check_paths("If a node is fixed in w, a face that moves at this node loads only the support of the node",
              fixed, "u1.2 u1.4 u1.8 f1.0 r1.2", {0, 0, 0, 5e4 * 0.006, -5e4 * 0.006});
  const double alone = 5 * 8.0 * std::pow(6.0, 4) / (384 * 1e4);  // 5 q L^4 / 384 EI
  load down = moving(2, -2 * alone);
  down.distributed = {{{-8.0}, {}}};
  const beam_problem sinks{even_beam(6.0, 4, 1e4),
                           {{0, 0, true}, {4, 0, true}},
                           {{2, face_below, 0.0, 5e4, true}},
                           {{{}, down.distributed}, down}};
  check_paths("A support that moves down separates at the deflection that the beam has without this support",
              sinks.as_problem(), "f1.0 s1 u2.4 f2.0",
              {alone / (1 / 5e4 + 216 / (48 * 1e4)), 0.5, -alone, 0});
  load lifted = moving(2, 0.03);
  lifted.points = {{1, 0, -10.0}};
  const beam_problem lies{even_beam(4.0, 2, 1e4),
                          {},
                          {{0, face_below, 0.0, 1e4, true}, {2, face_below, 0.0, 1e4, true}},
                          {{lifted.points, {}}, lifted}};
  const double bends = 10.0 * 64 / (48 * 1e4);  // F L^3 / 48 EI
  check_paths(
      "A face that moves up lifts a beam that rests only on faces, and the beam moves as a rigid body",
      lies.as_problem(), "u2.0 u2.4 u1.2 u2.2", {-5e-4, 0.03 - 5e-4, -5e-4 - bends, 0.0145 - bends});
  check_paths("A spring K and a pair k that overlap by m have the force m / (1 / K + 1 / k)",
              on_matrix({1, {{0, 0, 300.0}}}, {{0, face_below, 0.0, 700.0, true}}, {moving(0, 0.02)}),
              "f1.0 u1.0", {0.02 / (1 / 300.0 + 1 / 700.0), 0.014});
}

TEST_CASE("A state computed for a face that is wrong by 1e-6 is not certified") {
  const judged_run path(cantilever({moving(4, 0.01)}), "corrected");
  CHECK(path.certifies(path.u(1), path.isep(1)));
  CHECK_FALSE(judged_run(cantilever({moving(4, 0.010001)}), "corrected").certifies(path.u(1), path.isep(1)));
}

TEST_CASE("for a moved face and a pair of two dofs, FORTRAN and C++ get an additional row, and agree") {
  const auto moved = rows_of_calls(cantilever({moving(4, 0.01), moving(4, -0.01)}), -0.004, 8);
  REQUIRE(moved.size() == 4);
  CHECK(moved[1] == Approx(-0.004).epsilon(1e-12));               // w - m = 0 - 0.004
  CHECK(moved[2] == Approx(-0.01 + 0.0055813953).epsilon(1e-7));  // 0.006 / (1 + 3750 / k) - m
  const auto met = rows_of_calls(two_cantilevers(), -0.002, 4);   // the row after the four dofs
  REQUIRE(met.size() == 6);
  CHECK(met[1] == Approx(-0.002).epsilon(1e-12));
  CHECK(met[2] == Approx(-0.002 - 75.0 / 11 / 1e5).epsilon(1e-10));  // c - C / k
}

TEST_CASE("If the middle support of two spans l settles by d, it pulls with the force 6 EI d / l^3") {
  for (const double unit : {1e-9, 1.0, 1e9}) {
    const double l = 3 * unit;
    const double d = -0.01 * unit;
    const double middle = 6 * 1e4 * d / (l * l * l);
    const judged_run path(two_spans({settle(4, d)}, unit), "fortran");
    CHECK(path.all_certified());
    CHECK(path.u(1)[8] == d);  // to the bit
    const std::vector<double> r = path.held(1);
    CHECK(r[1] == Approx(middle).epsilon(1e-11));
    CHECK(r[0] == Approx(-middle / 2).epsilon(1e-11));
    CHECK(r[2] == Approx(-middle / 2).epsilon(1e-11));
    CHECK(path.u(1)[4] == Approx(d * 11 / 16).epsilon(1e-11));  // (3 l^2 x - x^3) / 2 l^3 at x = l / 2
  }
}

TEST_CASE("Equal settlements do not bend a beam, and forces that are only rounding are not certified") {
  const problem p = two_spans({{{}, {}, {{0, 0, -0.5}, {4, 0, -0.5}, {8, 0, -0.5}}}});
  const judged_run path(p, "corrected");
  CHECK(path.all_certified());
  for (std::size_t node = 0; node < 9; ++node) CHECK(path.u(1)[2 * node] == Approx(-0.5).epsilon(1e-12));
  for (const double r : path.held(1)) CHECK(std::abs(r) < 1e-9);
  const judged_run rough(p, "fortran");  // not refined
  CHECK_FALSE(rough.of_step(1).certified);
  CHECK(rough.of_step(1).proved);
}

TEST_CASE("paths with supports that settle have the shares, displacements and reactions of closed forms") {
  problem turns = two_spans({{{}, {}, {{0, 1, 0.002}}}});
  turns.supports = {{0, 0, true}, {0, 1, true}, {8, 0, true}, {8, 1, true}};
  check_paths("A clamp that rotates by t has the moment 4 EI t / l if the other end of the beam is clamped",
              turns, "r1.1 r1.3", {4 * 1e4 * 0.002 / 6, 2 * 1e4 * 0.002 / 6}, {"corrected"});
  // The middle moves half as far as the support. After contact, the spring k and the beam, with 48 EI / L^3
  // at midspan, act in parallel.
  problem lands = two_spans({settle(8, -0.04), settle(8, -0.02), {}});
  lands.supports = {{0, 0, true}, {8, 0, true}};
  lands.pairs = {{4, face_below, -0.005, 2e3, false}};
  const double beam_k = 48 * 1e4 / 216.0;
  const double w = (-0.02 * beam_k - 0.005 * 2e3) / (beam_k + 2e3);
  const double w_2 = (-0.01 * beam_k - 0.005 * 2e3) / (beam_k + 2e3);
  check_paths(
      "If a support settles onto a face, contact is at the proportional share, and a later step ends contact",
      lands, "s0 u1.8 r1.0 u2.8 f2.0 u3.8 f3.0",
      {0.25, w, 2e3 * (w + 0.005) / 2, w_2, -2e3 * (w_2 + 0.005), 0, 0}, {"fortran"}, 1e-9);
  problem loaded = two_spans({settle(4, -0.01)});
  loaded.pairs = {{4, face_below, -0.004, 3e4, false}, {4, face_above, 0.0, 1e5, true}};
  const double needs = 6 * 1e4 * -0.01 / 27;  // 6 EI d / l^3
  check_paths("The reaction of a support that settles does not contain the force of a pair at the same node",
              loaded, "r1.1 f1.0 f1.1 r1.0 r1.2", {needs - 180, 180, 0, -needs / 2, -needs / 2},
              {"corrected"});
}

TEST_CASE("The displacements of loads and settlements add up, on a plate and on a matrix") {
  problem p;
  p.geometry = {plate{{0, 1, 2, 3}, {0, 1, 2}, 100.0, 0.3}};
  for (const int node : {0, 3, 8, 11}) p.supports.push_back({node, 0, true});
  const load both{{{5, 0, -4.0}}, {{{-2.0}, {}}}, {{11, 0, -0.1}}};
  p.steps = {both, {both.points, both.distributed, {}}, {{}, {}, both.settlements}};
  const judged_run path(p, "fortran");
  CHECK(path.all_certified());
  for (std::size_t dof = 0; dof < path.u(1).size(); ++dof)
    CHECK(path.u(1)[dof] == Approx(path.u(2)[dof] + path.u(3)[dof]).epsilon(1e-9).margin(1e-13));
  CHECK(path.u(3)[15] == Approx(-0.1 / 6).epsilon(1e-10));  // w = -0.1 x y / 6 between the four corners
  CHECK(path.u(3)[33] == -0.1);

  const linear_structure s = build(p.geometry, {}, {});
  problem q = on_matrix(entries_of(s), {}, {{{}, {}, {{33, 0, -0.1}}}});
  std::get<assembled>(q.geometry.kind).rows = s.rows;
  for (const int node : {0, 3, 8, 11}) q.supports.push_back({3 * node, 0, true});
  std::string keys;
  std::vector<double> expected;
  for (std::size_t dof = 0; dof < path.u(3).size(); ++dof) {
    if (std::abs(path.u(3)[dof]) < 1e-6) continue;
    keys += "u1." + std::to_string(dof) + " ";
    expected.push_back(path.u(3)[dof]);
  }
  check_paths("on a matrix", q, keys, expected, {"fortran"});
}

TEST_CASE(
    "The reference solution equals the state of the path after a settlement, and a wrong settlement is not "
    "certified") {
  problem p = two_spans({{{{6, 0, 300.0}}, {}, {{4, 0, -0.01}, {0, 0, 0.003}}}});
  p.pairs = {{2, face_below, -0.001, 1e5, false}, {6, face_above, 0.002, 1e5, false}};
  const judged_run path(p, "corrected");
  CHECK(path.all_certified());
  const judged_run ends(p, "", false);
  CHECK(ends.end.status == path_status::solved);
  std::vector<double> u = path.u(1);
  for (std::size_t dof = 0; dof < u.size(); ++dof)
    CHECK(ends.u(1)[dof] == Approx(u[dof]).epsilon(1e-10).margin(1e-15));
  u[8] *= 1 + 1e-5;
  CHECK_FALSE(path.certifies(u, path.isep(1)));
}

TEST_CASE("right_hand_side refuses a dof for which the structure was built without settlements") {
  const problem p = two_spans({settle(4, -0.01)});
  const linear_structure rigid = build(p.geometry, p.supports, p.pairs);
  CHECK_THROWS_AS(right_hand_side(rigid, nodal_loads(p.geometry, p.steps[0])), std::logic_error);
}

TEST_CASE("paths with pairs between two dofs have the shares, displacements and forces of closed forms") {
  const double pressed = 75.0 / 11;
  check_paths(
      "Two cantilevers that meet press on each other with (F / k1 - gap) / (1 / k1 + 1 / k2 + 1 / k)",
      two_cantilevers(), "s0 u1.0 u1.2 u1.3 u2.0 u2.2 u3.2",  // the tip's slope is 3 w / 2 l
      {0.5, -(15 - pressed) / 3750, -pressed / 60000, -1.5 * pressed / 60000, 0, 0, -pressed / 60000});
  check_paths("A pair that alone holds a body acts as a spring in series with the springs of both bodies",
              chain(0.0), "u1.3", {-9.0 / 200 - 9.0 / 100 - 9.0 / 600 - 9.0 / 50});
  check_paths("A free body moves across the gap until it meets another body", chain(-0.01), "u1.3",
              {-0.01 - 0.33}, {"corrected"});
  const sparse_matrix two{2, {{0, 0, 300}, {1, 0, 0}, {1, 1, 200}}};
  const double w = -(30 + 11.5) / 950;  // 300 w + 600 (w / 4 + 0.0025) + 500 (w + 0.02) = -30
  check_paths("A dof may be in a pair with the ground and in a pair with a second dof",
              on_matrix(two, {{0, face_below, -0.01, 600.0, false, 1}, {0, face_below, -0.02, 500.0, false}},
                        {force_at(0, -30)}),
              "u1.0 u1.1 f1.1", {w, 0.75 * w + 0.0075, -500 * (w + 0.02)});
  load moved = force_at(0, -9);
  moved.moves = {{0, 0, 0.005}};
  const double presses = (0.03 - 0.005) / (1 / 300.0 + 1 / 200.0 + 1 / 600.0);
  check_paths("A face that moves between two dofs reduces the gap of the pair",
              on_matrix(two, {{0, face_below, -0.01, 600.0, false, 1}}, {moved}), "u1.1 u1.0 f1.0",
              {-presses / 200, -(9 - presses) / 300, presses});
}

TEST_CASE("a free body snaps onto another body, and if its load acts away from the body, its path fails") {
  CHECK(judged_run(chain(-0.01), "corrected").seen.increments.at(0).snaps);
  CHECK(judged_run(chain(0.0, 9), "corrected").end.status != path_status::solved);
}

TEST_CASE("A state of two cantilevers equals the reference solution, and must have the right tips") {
  const judged_run path(two_cantilevers(), "corrected");
  for (const std::size_t dof : {0, 2}) {
    std::vector<double> wrong = path.u(1);
    wrong[dof] *= 1 + 1e-4;
    CHECK_FALSE(path.certifies(wrong, path.isep(1)));
  }
  const solved_step answer = reference_solver(path.structure).solve(std::vector<double>{-15, 0, 0, 0});
  REQUIRE(answer.status == path_status::solved);
  CHECK(answer.displacement[2] == Approx(-75.0 / 11 / 60000).epsilon(1e-11));
}

TEST_CASE("A pair between two dofs of one free body removes no rigid-body motion of the body") {
  const linear_structure s = structure_of(on_matrix({2, {{0, 0, 1}, {1, 0, -1}, {1, 1, 1}}},
                                                    {{0, face_below, 0.0, 5.0, true, 1}}, {force_at(0, 0)}));
  REQUIRE(s.rigid_motions == 1);
  CHECK_FALSE(s.is_held(s.held_by([](std::size_t) { return true; })));
}

TEST_CASE("If both dofs of a stiff pair are wrong by 1e-4, the error bound of the state is at least 1e-4") {
  const judged_run path(on_matrix({2, {{0, 0, 1}, {1, 0, 0}, {1, 1, 1}}},
                                  {{0, face_below, 0.0, 1e6, true, 1}}, {force_at(0, -3)}),
                        "corrected");
  std::vector<double> u = path.u(1);
  for (double& x : u) x -= 1e-4;
  CHECK(path.certificate_of(u, path.isep(1)).error[quantity::w].value_or(1.0) >= 0.999e-4);
}
