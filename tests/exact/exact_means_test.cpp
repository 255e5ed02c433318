// Tests that paths that fail in doubles end like exact paths, and that residuals are exact.
#include "contct/exact/exact_means.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"
#include "support/judged_run.hpp"

using namespace contct;
using contct::double_double;

namespace {

problem referee_problem(const std::string& name) {
  return read_problem(CONTCT_REFEREE_PROBLEMS "/" + name + ".toml");
}

}  // namespace

TEST_CASE(
    "if the path in doubles fails at a drop onto stiff pairs, the exact path gives certified final forces") {
  const judged_run r(referee_problem("dropped-onto-stiff-pairs"), "corrected");
  CHECK(r.end.status == path_status::solved);
  CHECK(r.exactly == std::vector<char>{0, 1});
  CHECK(r.reference == std::vector<char>{0, 0});
  CHECK(r.judged.all_certified());
  CHECK(r.statuses.back() == std::vector<int>{in_contact, separated, separated, separated, in_contact});

  const judged_run without(referee_problem("dropped-onto-stiff-pairs"), "corrected", false);
  CHECK(without.exactly == std::vector<char>{0, 0});
  CHECK(without.reference == std::vector<char>{0, 1});
}

TEST_CASE("if a mesh has no factor in doubles, the first step ends in the final state of the exact path") {
  const judged_run r(referee_problem("graded-mesh"), "corrected");
  CHECK(r.end.status == path_status::solved);
  CHECK(r.exactly.front() == 1);
  CHECK(r.judged.all_certified());

  const exact_path path = follow_corrected_path(exact_problem_of(r.what));
  const found_end end = exact_means_of(r.what)->end_of(2);
  REQUIRE(end.state);
  CHECK(end.exists == true);
  CHECK(end.state->from_exact_path);
  for (std::size_t i = 0; i < path.steps[1].closed.size(); ++i)
    CHECK((end.state->isep[i] == in_contact) == (path.steps[1].closed[i] != 0));
  for (std::size_t dof = 0; dof < end.state->displacement.size(); ++dof)
    CHECK(end.state->displacement[dof] == contct::rounded(path.steps[1].displacement[dof]));
}

TEST_CASE(
    "a beam that is a mechanism only by rounding gets an exact final state, and a true mechanism gets none") {
  problem p = referee_problem("held-by-a-hair");
  CHECK(judged_run(p, "corrected").end.status == path_status::solved);
  p.steps[0].points[1].value = -4e-17;  // the load turns the beam the other way
  p.steps[0].points[0].value = 0.032;
  const found_end end = exact_means_of(p)->end_of(1);
  CHECK_FALSE(end.state);
  CHECK(end.exists == false);
}

TEST_CASE(
    "no exact state is given for a step after the end of the exact path, or for a problem with too many "
    "dofs") {
  const problem p = referee_problem("graded-mesh");
  CHECK_FALSE(exact_means_of(p)->end_of(3).exists);

  problem large = p;
  beam long_beam;
  for (int i = 0; i <= most_dofs_beside_doubles / 2; ++i) long_beam.x.push_back(i);
  long_beam.EI.assign(long_beam.x.size() - 1, 1.0);
  large.geometry.kind = long_beam;
  CHECK_FALSE(exact_means_of(large)->end_of(1).exists);
}

TEST_CASE(
    "the exact residual of an exact state is the reaction at a fixed dof, and only rounding at all other "
    "dofs") {
  const problem p = referee_problem("graded-mesh");
  const exact_path path = follow_corrected_path(exact_problem_of(p));
  const auto exactly = exact_means_of(p);
  int checked = 0;
  for (int step = 1; step <= 2; ++step) {
    std::vector<double_double> u;
    for (const rational& x : path.steps[static_cast<std::size_t>(step) - 1].displacement)
      u.push_back(contct::long_rounded(x));
    const auto needed = exactly->residual_of(step, u);
    REQUIRE(needed);
    REQUIRE(needed->size() == u.size());
    const rational_vector& reactions = path.steps[static_cast<std::size_t>(step) - 1].reactions;
    CHECK((*needed)[0].hi == Approx(contct::rounded(reactions[0])).epsilon(1e-12));
    for (std::size_t dof = 2; dof < u.size(); ++dof, ++checked)
      CHECK(std::abs((*needed)[dof].hi) < 1e-12);  // 12 EI / h^3 = 1e17 times a rounding of 2^-106
  }
  CHECK(checked == 20);
}

TEST_CASE("the residual of a state in 32 digits is exact just above and just below a face") {
  const problem p = referee_problem("stiff-pair-at-its-face");
  const auto exactly = exact_means_of(p);
  const rational face = decimal_of(-7.6e-12);
  const rational h = decimal_of(8e-11);
  const rational bends = 12 * decimal_of(7e-4) / (h * h * h);
  const double_double near = contct::long_rounded(face);
  for (const double off : {-0x1p-138, 0x1p-138}) {  // some tenths of a unit in the last of 32 digits
    std::vector<double_double> u(6, 0.0);
    u[4] = {near.hi, near.lo + off};
    const rational at = binary_value(u[4].hi) + binary_value(u[4].lo);
    const rational pressed = at < face ? rational(decimal_of(7.8e44) * (at - face)) : rational(0);
    const double expected = contct::rounded(rational(bends * at + pressed));
    CHECK((*exactly->residual_of(1, u))[4].hi == expected);
    CHECK((at < face) == (off < 0));
  }
}

TEST_CASE(
    "a residual beyond the range of doubles is infinite, and a state with an infinite or NaN u has no "
    "residual") {
  const problem p = referee_problem("stiff-pair-at-its-face");
  const auto exactly = exact_means_of(p);
  std::vector<double_double> u(6, 0.0);
  u[4] = 1e300;
  const auto needed = exactly->residual_of(1, u);
  REQUIRE(needed);
  CHECK(std::isinf((*needed)[4].hi));
  CHECK((*needed)[4].lo == 0.0);
  for (const double odd : {HUGE_VAL, std::nan("")}) {
    u[4] = odd;
    CHECK_FALSE(exactly->residual_of(1, u));
  }
}
