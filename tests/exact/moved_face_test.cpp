// Tests moved faces, and pairs between two dofs, in exact arithmetic.
#include <cmath>
#include <string>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

// A cantilever with 3 EI / l^3 = 3750 at its tip, and a stop with k = 50000.
const std::string raised_stop =
    "[beam]\nx = [0, 1, 2]\nEI = 1e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[contact]]\nnode = "
    "3\n"
    "surface = \"below\"\nface = -0.004\nstiffness = 5e4\n[[step]]\nmove = [ { node = 3, w = 0.01 } ]\n"
    "[[step]]\nuniform = -300.0\nmove = [ { node = 3, w = 0.003 } ]\n[[step]]\nuniform = 0\n";

}  // namespace

TEST_CASE(
    "The exact force of a stop raised by m is the fraction (m - gap) / (1 / k + l^3 / 3 EI), by either "
    "rule") {
  const exact_problem p = exact_problem_of(parse_problem(raised_stop, "p.toml"));
  for (const exact_path& path : {follow_1989_path(p), follow_corrected_path(p)}) {
    REQUIRE(path.steps.size() == 3);
    const exact_step_end& pressed = path.steps[0];
    CHECK(pressed.force[0] == rational(900, 43));  // 0.006 / (1 / 50000 + 1 / 3750)
    CHECK(pressed.displacement[4] == rational(900, 43 * 3750));
    CHECK(pressed.reactions[0] == rational(-900, 43));
    // w = c + m - F / k = F / 3750 - q l^4 / 8 EI = F / 3750 - 0.06
    const rational force = rational(59, 1000) / (rational(1, 50000) + rational(1, 3750));
    CHECK(path.steps[1].force[0] == force);
    CHECK(path.steps[1].displacement[4] == rational(-1, 1000) - force / 50000);
    CHECK(path.steps[2].displacement[4] == 0);
    CHECK(path.steps[2].gap[0] == rational(1, 250));
  }
}

TEST_CASE("The value and the factor of a face's move are multiplied as exact decimals") {
  problem p = parse_problem(raised_stop, "p.toml");
  p.steps[0].moves[0].value = 0.1;
  p.steps[0].moves[0].factor = 0.1;  // in doubles 0.1 * 0.1 differs from 0.01
  CHECK(exact_problem_of(p).steps[0].moved[4] == rational(1, 100));
}

TEST_CASE("The errors of states with moved faces are within the proved bounds") {
  for (const std::string kernel : {"fortran", "corrected"}) {
    const judged_run r{parse_problem(raised_stop, "p.toml"), kernel};
    const exact_path truly = follow_corrected_path(exact_problem_of(r.what));
    for (std::size_t step = 0; step < 3; ++step) {
      const certificate& c = r.of_step(step + 1);
      CHECK(c.certified);
      for (std::size_t dof = 0; dof < 6; dof += 2) {
        const rational error = binary_value(r.displacements[step][dof]) - truly.steps[step].displacement[dof];
        CHECK(std::abs(contct::rounded(error)) <= c.error[quantity::w].value());
      }
      const rational off = binary_value(r.numbers[step].pair_forces[0]) - truly.steps[step].force[0];
      CHECK(std::abs(contct::rounded(off)) <= c.error[quantity::force].value());
    }
  }
}

TEST_CASE(
    "Two cantilevers that meet press on each other with the exact fraction of the closed form, by either "
    "rule") {
  assembled a;
  a.stiffness = {4,
                 {{0, 0, 15000},
                  {1, 0, -15000},
                  {1, 1, 20000},
                  {2, 0, 0},
                  {2, 2, 240000},
                  {3, 2, -120000},
                  {3, 3, 80000}}};
  problem what;
  what.geometry.kind = a;
  what.pairs = {{0, face_below, -0.002, 1e5, false, 2}};
  what.steps = {{{{0, 0, -15}}, {}}};
  const exact_problem p = exact_problem_of(what);
  for (const exact_path& path : {follow_1989_path(p), follow_corrected_path(p)}) {
    REQUIRE(path.steps.size() == 1);
    CHECK(path.steps[0].increments[0].fraction == rational(1, 2));
    CHECK(path.steps[0].force[0] == rational(75, 11));  // 0.002 / (1 / 3750 + 1 / 60000 + 1 / 100000)
    CHECK(path.steps[0].displacement[2] == rational(-75, 11 * 60000));
  }
}
