// Tests that every number of a certified state is right, and that paths that fail in doubles end like exact
// paths.
#include <fmt/format.h>

#include <cmath>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/number/random.hpp"
#include "contct/proof/exact_means.hpp"
#include "contct/read/problem_file.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

judged_run judged(const std::string& text, const std::string& kernel) {
  return {parse_problem(text, "p.toml"), kernel};
}

double error_of(double told, const rational& truly) {
  return std::abs(rounded(binary_value(told) - truly));
}

/// Returns the largest force or reaction in a state or, if all are 0, in the last earlier step with a force.
double largest_force(const exact_path& truly, std::size_t step) {
  double largest = 0.0;
  for (; step > 0 && largest == 0.0; --step)
    for (const rational_vector* all : {&truly.steps[step - 1].force, &truly.steps[step - 1].reactions})
      for (const rational& f : *all) largest = std::max(largest, std::abs(rounded(f)));
  return largest;
}

/// Returns the first false claim of a certified state in words, or an empty text.
std::string false_claim(const judged_run& r, const exact_path& truly, std::size_t step) {
  const certificate& c = r.of_step(step);
  const exact_step_end& right = truly.steps.at(step - 1);
  const end_numbers told = r.numbers(step);
  const double largest = largest_force(truly, step);
  for (std::size_t i = 0; i < told.reactions.size(); ++i)
    if (r.what.supports[i].dof == 0 && error_of(told.reactions[i], right.reactions[i]) > 1e-6 * largest)
      return "a reaction is off";
  for (std::size_t i = 0; i < r.what.pairs.size(); ++i) {
    const bool is_closed = r.isep(step)[i] == in_contact;
    if (is_closed && right.gap[i] > 0) return "a pair in contact is open";
    if (!is_closed && right.force[i] > 0) return "a separated pair presses";
    if (error_of(told.pair_forces[i], right.force[i]) > 1e-6 * largest) return "a contact force is off";
    const double gap = gap_of(r.what.pairs[i], r.u(step)[r.structure.pairs[i].dof], is_closed);
    if (c.error[quantity::gap] && error_of(gap, right.gap[i]) > *c.error[quantity::gap])
      return "a gap is beyond its bound";
  }
  return "";
}

/// Returns a beam with typical dimensions: supports settle by some millimetres, a pair is some millimetres
/// from one support, and loads are in newtons.
std::string settling_beam(std::uint64_t number) {
  random_numbers random(2026 + number);
  const auto between = [&](double low, double high, double unit) {
    return std::round((low + (high - low) * random.unit()) / unit) * unit;
  };
  const double length = between(2, 8, 1);
  const double near = between(0.001, 0.02, 0.001);
  const bool clamped = random.chance(0.5);
  std::string text =
      fmt::format("[beam]\nlength = {:f}\nelement_size = 1.0\nEI = {:f}\n[[support]]\nx = 0.0\nfix = {}\n",
                  length, between(1e5, 1e8, 1e4), clamped ? "[\"w\", \"theta\"]" : "\"w\"");
  if (!clamped) text += fmt::format("[[support]]\nx = {:f}\nfix = \"w\"\n", length);
  for (const double x : {near, between(0.3, length - 0.3, 0.1)}) {
    text += fmt::format("[[contact]]\nx = {:f}\nsurface = \"below\"\nface = {:f}\n", x,
                        -between(0.001, 0.1, 0.001));
    text += fmt::format("stiffness = {:f}\n", between(1e5, 1e8, 1e4));
  }
  for (int step = 0; step < 2; ++step) {
    text += "[[step]]\n";
    if (random.chance(0.8)) text += fmt::format("uniform = {:f}\n", -between(10, 5000, 10));
    text += fmt::format("settlement = [ {{ x = 0.0, w = {:f} }} ]\n", -between(0, 0.03, 0.001));
  }
  return text;
}

/// Returns a problem with K = [[1, coupling], [coupling, 1]] and pairs below and above at dof 1.
problem two_dofs(double coupling, double stiffness, double load) {
  return on_matrix({2, {{0, 0, 1.0}, {1, 0, coupling}, {1, 1, 1.0}}, {}},
                   {{0, face_below, 0.0, stiffness, true}, {0, face_above, 100.0, stiffness, false}},
                   {force_at(0, load)});
}

problem referee_problem(const std::string& name) {
  return read_problem(CONTCT_REFEREE_PROBLEMS "/" + name + ".toml");
}

}  // namespace

TEST_CASE("In 150 beams on settling supports, no certified state has a wrong number or status") {
  for (const std::string kernel : {"fortran", "corrected"}) {
    int certified = 0;
    for (std::uint64_t number = 0; number < 150; ++number) {
      const judged_run r = judged(settling_beam(number), kernel);
      const exact_path truly = follow_corrected_path(exact_problem_of(r.what));
      for (std::size_t step = 1; step <= r.steps.size(); ++step) {
        const std::optional<certificate>& c = r.steps[step - 1].judged;
        if (!c || !c->certified) continue;
        ++certified;
        INFO(kernel << ", beam " << number << ", step " << step);
        CHECK(false_claim(r, truly, step).empty());
      }
    }
    CAPTURE(kernel, certified);
    CHECK(certified > (kernel == "corrected" ? 270 : 30));
  }
}

TEST_CASE(
    "A state whose reaction of 200 N is wrong by 0.2 N is not certified, even if the clamp is very stiff") {
  const std::string text =
      "[beam]\nlength = 2.0\nelement_size = 1.0\nEI = 1.0e7\n[[support]]\nx = 0.0\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nx = 0.001\nsurface = \"below\"\nface = -0.1\nstiffness = 1.0e6\n"
      "[[step]]\nuniform = -100.0\nsettlement = [ { x = 0.0, w = -0.02 } ]\n";
  const judged_run faithful = judged(text, "fortran");
  CHECK(std::abs(faithful.numbers(1).reactions[0] - 200.0) > 1e-3);
  CHECK_FALSE(faithful.of_step(1).certified);
  CHECK(digits_of(faithful.of_step(1)) < 6);
  const judged_run corrected = judged(text, "corrected");
  CHECK(corrected.numbers(1).reactions[0] == Approx(200.0).epsilon(1e-15));
  CHECK(corrected.of_step(1).certified);
}

TEST_CASE("A state is not certified after the 1989 rule toggled a pair 0.9 mm before the face of the pair") {
  // The 1989 rule toggles both pairs during unloading, although node 1 is fixed 0.9 mm from its face.
  const judged_run r = judged(
      "[beam]\nx = [0.0, 1.0, 2.0, 3.0]\nEI = 11.2\n[[support]]\nnodes = [1, 4]\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nnode = 1\nsurface = \"above\"\nface = 0.0009\nstiffness = 1e-6\n"
      "[[contact]]\nnode = 3\nsurface = \"above\"\nface = 0.0\nstiffness = 1e10\n"
      "[[step]]\npoint = [ { node = 2, w = -0.1 } ]\n[[step]]\nuniform = 0.0\n",
      "fortran");
  REQUIRE(r.end.status == path_status::solved);
  REQUIRE(r.isep(2)[0] == in_contact);
  CHECK_FALSE(r.of_step(2).certified);
  CHECK(*r.of_step(2).error[quantity::gap] >= 0.0009);
}

TEST_CASE("The corrected rule gives the correct status to a pair with almost no stiffness") {
  problem p = on_matrix({2, {{0, 0, 29e-14}, {1, 0, -9e-2}, {1, 1, 10e10}}, {}},
                        {{1, face_below, -2e-8, 2.42e10, false},
                         {1, face_below, -2.5e-7, 7.21e12, false},
                         {0, face_above, 8.07e4, 1.76e-11, false},
                         {0, face_below, -3.19e5, 1.02e-15, false},
                         {1, face_below, -5.1e-7, 1.4e13, false},
                         {1, face_below, -2e-7, 1.19e13, false}},
                        {{{{0, 0, 3.78e-7}, {1, 0, -5.47e5}}, {}}});
  const judged_run r(p, "corrected");
  // Pair 3 is 18600 beyond its face, and carries only 3.3e-7 of a load of 5.5e5.
  CHECK(r.isep(1) == std::vector<int>{in_contact, separated, in_contact, separated, separated, in_contact});
  CHECK(r.of_step(1).certified);
}

TEST_CASE("A state on an indefinite matrix is not certified, but one on a matrix that a pair holds is") {
  const judged_run indefinite(two_dofs(1 + 1e-11, 1e-9, -1e-11), "corrected");
  REQUIRE(indefinite.steps.size() == 1);
  CHECK_FALSE(indefinite.of_step(1).certified);
  CHECK(indefinite.of_step(1).problem.find("semidefinite") != std::string::npos);
  problem p = two_dofs(-1.0, 1e3, -5.0);
  std::get<assembled>(p.geometry.kind).free_motions = 1;
  const judged_run r(p, "corrected");
  CHECK(r.numbers(1).pair_forces[0] == Approx(5.0).epsilon(1e-15));
  CHECK(r.of_step(1).certified);
}

TEST_CASE("If loads cancel at a node or on elements, all displacements are 0 and the state is certified") {
  const std::string beam =
      "[beam]\nlength = 2.0\nelements = 2\nEI = 1.0e4\n[[support]]\nx = [0.0, 2.0]\nfix = \"w\"\n"
      "[[contact]]\nx = 1.0\nsurface = \"below\"\nface = -0.01\nstiffness = 5.0e4\n[[step]]\n";
  for (const std::string loads :
       {"point = [ { x = 1.0, w = -60.1 }, { x = 1.0, w = 60.1 } ]",
        "point = [ { x = 1.0, w = 0.1 }, { x = 1.0, w = 0.2 }, { x = 1.0, w = -0.3 } ]",
        "uniform = [ { value = 10.1 }, { value = -10.1, elements = [1] }, { value = -10.1, elements = [2] } "
        "]"}) {
    for (const std::string kernel : {"fortran", "corrected"}) {
      INFO(kernel << ": " << loads);
      const judged_run r = judged(beam + loads + "\n", kernel);
      CHECK(r.u(1) == std::vector<double>(6, 0.0));
      CHECK(r.of_step(1).certified);
      CHECK(digits_of(r.of_step(1)) == 15);
    }
  }
}

TEST_CASE(
    "A state with numbers below the normal range of doubles is not certified, and the certificate gives this "
    "reason") {
  for (const std::string numbers :
       {"x = [0.0, 1.0e-40, 2.0e-40]\nEI = 1.5e-322", "x = [0.0, 1e-100, 2e-100]\nEI = 1e-90"}) {
    const judged_run r = judged(
        "[beam]\n" + numbers +
            "\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[contact]]\nnode = 3\nsurface = \"below\"\n"
            "face = -1.0e-42\nstiffness = 1.0e-203\n[[step]]\npoint = [ { node = 3, w = -4.0e-244 } ]\n",
        "corrected");
    CHECK_FALSE(r.of_step(1).certified);
    CHECK(r.of_step(1).problem.find("smallest normal double") != std::string::npos);
    CHECK(digits_of(r.of_step(1)) == 0);
  }
}

TEST_CASE("a plate that is nearly rigid on its bed is certified, or the reason suggests fewer elements") {
  for (const std::string elements : {"[16, 12]", "[32, 24]"}) {
    const judged_run r = judged("[plate]\nsize = [8, 6]\nelements = " + elements +
                                    "\nD = 1e9\nnu = 0.2\n[[bed]]\nmodulus = 1\nface = 0\n[[step]]\n"
                                    "uniform = -10\npoint = [ { at = [4, 3], w = -100 } ]\n",
                                "corrected");
    const bool is_fine = elements == "[32, 24]";
    CHECK((r.of_step(1).certified ||
           (is_fine && r.of_step(1).problem.find("use fewer elements") != std::string::npos)));
  }
}

TEST_CASE(
    "if the path in doubles fails at a drop onto stiff pairs, the exact path gives certified final forces") {
  const judged_run r(referee_problem("dropped-onto-stiff-pairs"), "corrected");
  CHECK(r.end.status == path_status::solved);
  CHECK((r.steps[0].from == origin::path && r.steps[1].from == origin::exact_path));
  CHECK(r.all_certified());
  CHECK(r.isep(2) == std::vector<int>{in_contact, separated, separated, separated, in_contact});

  const judged_run without(referee_problem("dropped-onto-stiff-pairs"), "corrected", false);
  CHECK((without.steps[0].from == origin::path && without.steps[1].from == origin::reference));
}

TEST_CASE("if a mesh has no factor in doubles, the first step ends in the final state of the exact path") {
  const judged_run r(referee_problem("graded-mesh"), "corrected");
  CHECK(r.end.status == path_status::solved);
  CHECK(r.steps[0].from == origin::exact_path);
  CHECK(r.all_certified());

  const exact_path path = follow_corrected_path(exact_problem_of(r.what));
  const solved_step end = exact_means_of(r.what)->end_of(2);
  REQUIRE(end.status == path_status::solved);
  CHECK(end.from == origin::exact_path);
  CHECK(end.isep == path.steps[1].isep);
  for (std::size_t dof = 0; dof < path.steps[1].displacement.size(); ++dof)
    CHECK(end.displacement.at(dof) == rounded(path.steps[1].displacement[dof]));
}

TEST_CASE(
    "a beam that is a mechanism only by rounding gets an exact final state, and a true mechanism gets none") {
  problem p = referee_problem("held-by-a-hair");
  CHECK(judged_run(p, "corrected").end.status == path_status::solved);
  p.steps[0].points[1].value = -4e-17;  // the load turns the beam the other way
  p.steps[0].points[0].value = 0.032;
  CHECK(exact_means_of(p)->end_of(1).status == path_status::mechanism);
}

TEST_CASE(
    "no exact state is given for a step after the end of the exact path, or for a problem with too many "
    "dofs") {
  const problem p = referee_problem("graded-mesh");
  CHECK_FALSE(exact_means_of(p)->end_of(3).is_decided());

  problem large = p;
  beam long_beam;
  for (int i = 0; i <= most_dofs_beside_doubles / 2; ++i) long_beam.x.push_back(i);
  long_beam.EI.assign(long_beam.x.size() - 1, 1.0);
  large.geometry.kind = long_beam;
  CHECK_FALSE(exact_means_of(large)->end_of(1).is_decided());
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
      u.push_back(long_rounded(x));
    const auto needed = exactly->residual_of(step, u);
    REQUIRE(needed);
    REQUIRE(needed->size() == u.size());
    const rational_vector& reactions = path.steps[static_cast<std::size_t>(step) - 1].reactions;
    CHECK((*needed)[0].hi == Approx(rounded(reactions[0])).epsilon(1e-12));
    for (std::size_t dof = 2; dof < u.size(); ++dof, ++checked)
      CHECK(std::abs((*needed)[dof].hi) < 1e-12);  // 12 EI / h^3 = 1e17 times a rounding of 2^-106
  }
  CHECK(checked == 20);
}

TEST_CASE("the residual of a state in 32 digits is exact just above and just below a face, or infinite") {
  const problem p = referee_problem("stiff-pair-at-its-face");
  const auto exactly = exact_means_of(p);
  const rational face = decimal_of(-7.6e-12);
  const rational h = decimal_of(8e-11);
  const rational bends = 12 * decimal_of(7e-4) / (h * h * h);
  const double_double near = long_rounded(face);
  std::vector<double_double> u(6, 0.0);
  for (const double off : {-0x1p-138, 0x1p-138}) {  // some tenths of a unit in the last of 32 digits
    u[4] = {near.hi, near.lo + off};
    const rational at = binary_value(u[4].hi) + binary_value(u[4].lo);
    const rational pressed = at < face ? rational(decimal_of(7.8e44) * (at - face)) : rational(0);
    CHECK((*exactly->residual_of(1, u))[4].hi == rounded(rational(bends * at + pressed)));
    CHECK((at < face) == (off < 0));
  }
  u[4] = 1e300;  // the residual is beyond the range of doubles
  const auto needed = exactly->residual_of(1, u);
  REQUIRE(needed);
  CHECK(std::isinf((*needed)[4].hi));
  CHECK((*needed)[4].lo == 0.0);
  for (const double odd : {HUGE_VAL, std::nan("")}) {
    u[4] = odd;
    CHECK_FALSE(exactly->residual_of(1, u));
  }
}
