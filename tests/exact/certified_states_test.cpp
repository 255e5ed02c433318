// Tests that every number, status and gap of a certified state is right, by comparison with the exact path.
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/number/random.hpp"
#include "contct/read/problem_file.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

judged_run judged(const std::string& text, const std::string& kernel) {
  return {parse_problem(text, "p.toml"), kernel};
}

double error_of(double told, const rational& truly) {
  return std::abs(contct::rounded(binary_value(told) - truly));
}

/// Returns the largest force or reaction in a state or, if all are 0, in the last earlier step with a force.
double largest_force(const exact_path& truly, std::size_t step) {
  double largest = 0.0;
  for (; step > 0 && largest == 0.0; --step)
    for (const rational_vector* all : {&truly.steps[step - 1].force, &truly.steps[step - 1].reactions})
      for (const rational& f : *all) largest = std::max(largest, std::abs(contct::rounded(f)));
  return largest;
}

/// Returns the first false claim of a certified state in words, or an empty text.
std::string false_claim(const judged_run& r, const exact_path& truly, std::size_t step) {
  const certificate& c = r.of_step(step);
  const exact_step_end& right = truly.steps.at(step - 1);
  const end_numbers& told = r.numbers.at(step - 1);
  const double largest = largest_force(truly, step);
  for (std::size_t i = 0; i < told.reactions.size(); ++i) {
    const double error = error_of(told.reactions[i], right.reactions[i]);
    if (r.what.supports[i].dof == 0 && error > 1e-6 * largest)
      return "a reaction is off by " + std::to_string(error);
  }
  for (std::size_t i = 0; i < r.what.pairs.size(); ++i) {
    const bool is_closed = r.statuses[step - 1][i] == in_contact;
    if (is_closed && right.gap[i] > 0) return "a pair in contact is open";
    if (!is_closed && right.force[i] > 0) return "a separated pair presses";
    if (error_of(told.pair_forces[i], right.force[i]) > 1e-6 * largest) return "a contact force is off";
    const std::size_t dof = r.structure.dof_of_pair(i);
    const double gap = gap_of(r.what.pairs[i], r.displacements[step - 1][dof], is_closed);
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
  std::string text = "[beam]\nlength = " + std::to_string(length) +
                     "\nelement_size = 1.0\nEI = " + std::to_string(between(1e5, 1e8, 1e4)) +
                     "\n[[support]]\nx = 0.0\nfix = " + (clamped ? "[\"w\", \"theta\"]" : "\"w\"") + "\n";
  if (!clamped) text += "[[support]]\nx = " + std::to_string(length) + "\nfix = \"w\"\n";
  for (const double x : {near, between(0.3, length - 0.3, 0.1)})
    text += "[[contact]]\nx = " + std::to_string(x) +
            "\nsurface = \"below\"\nface = " + std::to_string(-between(0.001, 0.1, 0.001)) +
            "\nstiffness = " + std::to_string(between(1e5, 1e8, 1e4)) + "\n";
  for (int step = 0; step < 2; ++step) {
    text += "[[step]]\n";
    if (random.chance(0.8)) text += "uniform = " + std::to_string(-between(10, 5000, 10)) + "\n";
    text += "settlement = [ { x = 0.0, w = " + std::to_string(-between(0, 0.03, 0.001)) + " } ]\n";
  }
  return text;
}

/// Returns a problem with K = [[1, coupling], [coupling, 1]] and pairs below and above at dof 1.
problem two_dofs(double coupling, double stiffness, double load) {
  problem p;
  assembled a;
  a.name = "k.mtx";
  a.stiffness = {2, {{0, 0, 1.0}, {1, 0, coupling}, {1, 1, 1.0}}, {}};
  a.rows = {0, 1};
  p.geometry = {a};
  p.pairs = {{0, face_below, 0.0, stiffness, true}, {0, face_above, 100.0, stiffness, false}};
  p.steps = {{{{0, 0, load}}, {}}};
  return p;
}

}  // namespace

TEST_CASE(
    "In 500 beams on settling supports, no certified state has a wrong number or status, under either rule") {
  for (const std::string kernel : {"fortran", "corrected"}) {
    int certified = 0;
    for (std::uint64_t number = 0; number < 500; ++number) {
      const judged_run r = judged(settling_beam(number), kernel);
      const exact_path truly = follow_corrected_path(exact_problem_of(r.what));
      for (std::size_t step = 1; step <= r.judged.steps().size(); ++step) {
        const std::optional<certificate>& c = r.judged.steps()[step - 1];
        if (!c || !c->certified) continue;
        ++certified;
        const std::string claim = false_claim(r, truly, step);
        INFO(kernel << ", beam " << number << ", step " << step << ": " << claim);
        CHECK(claim.empty());
      }
    }
    CAPTURE(kernel, certified);
    CHECK(certified > (kernel == "corrected" ? 900 : 100));
  }
}

TEST_CASE(
    "A state whose reaction of 200 N is wrong by 0.2 N is not certified, even if the clamp is very stiff") {
  const std::string text =
      "[beam]\nlength = 2.0\nelement_size = 1.0\nEI = 1.0e7\n[[support]]\nx = 0.0\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nx = 0.001\nsurface = \"below\"\nface = -0.1\nstiffness = 1.0e6\n"
      "[[step]]\nuniform = -100.0\nsettlement = [ { x = 0.0, w = -0.02 } ]\n";
  const judged_run faithful = judged(text, "fortran");
  CHECK(std::abs(faithful.numbers.at(0).reactions[0] - 200.0) > 1e-3);
  CHECK_FALSE(faithful.of_step(1).certified);
  CHECK(digits_of(faithful.of_step(1)) < 6);
  const judged_run corrected = judged(text, "corrected");
  CHECK(corrected.numbers.at(0).reactions[0] == Approx(200.0).epsilon(1e-15));
  CHECK(corrected.of_step(1).certified);
}

TEST_CASE("A state is not certified after the 1989 rule toggled a pair 0.9 mm before the face of the pair") {
  // The 1989 rule toggles both pairs during unloading, although node 1 is fixed 0.9 mm from its face.
  const std::string text =
      "[beam]\nx = [0.0, 1.0, 2.0, 3.0]\nEI = 11.2\n[[support]]\nnodes = [1, 4]\nfix = [\"w\", \"theta\"]\n"
      "[[contact]]\nnode = 1\nsurface = \"above\"\nface = 0.0009\nstiffness = 1e-6\n"
      "[[contact]]\nnode = 3\nsurface = \"above\"\nface = 0.0\nstiffness = 1e10\n"
      "[[step]]\npoint = [ { node = 2, w = -0.1 } ]\n[[step]]\nuniform = 0.0\n";
  const judged_run r = judged(text, "fortran");
  REQUIRE(r.end.status == path_status::solved);
  REQUIRE(r.statuses.at(1)[0] == in_contact);
  CHECK_FALSE(r.of_step(2).certified);
  CHECK(*r.of_step(2).error[quantity::gap] >= 0.0009);
}

TEST_CASE("The corrected rule gives the correct status to a pair with almost no stiffness") {
  problem p;
  assembled a;
  a.name = "soft.mtx";
  a.stiffness = {2, {{0, 0, 29e-14}, {1, 0, -9e-2}, {1, 1, 10e10}}, {}};
  a.rows = {0, 1};
  p.geometry = {a};
  p.pairs = {{1, face_below, -2e-8, 2.42e10, false},   {1, face_below, -2.5e-7, 7.21e12, false},
             {0, face_above, 8.07e4, 1.76e-11, false}, {0, face_below, -3.19e5, 1.02e-15, false},
             {1, face_below, -5.1e-7, 1.4e13, false},  {1, face_below, -2e-7, 1.19e13, false}};
  p.steps = {{{{0, 0, 3.78e-7}, {1, 0, -5.47e5}}, {}}};
  const judged_run r(p, "corrected");
  // Pair 3 is 18600 beyond its face, and carries only 3.3e-7 of a load of 5.5e5.
  CHECK(r.statuses.at(0) ==
        std::vector<int>{in_contact, separated, in_contact, separated, separated, in_contact});
  CHECK(r.of_step(1).certified);
}

TEST_CASE("A problem on a matrix with a negative eigenvalue of -1e-11 has no certified state") {
  const judged_run r(two_dofs(1 + 1e-11, 1e-9, -1e-11), "corrected");
  REQUIRE(r.judged.steps().size() == 1);
  CHECK_FALSE(r.of_step(1).certified);
  CHECK(r.of_step(1).problem.find("semidefinite") != std::string::npos);
}

TEST_CASE(
    "A state on a singular matrix that is exactly semidefinite is certified if a pair holds the structure") {
  problem p = two_dofs(-1.0, 1e3, -5.0);
  std::get<assembled>(p.geometry.kind).free_motions = 1;
  const judged_run r(p, "corrected");
  CHECK(r.numbers.at(0).pair_forces[0] == Approx(5.0).epsilon(1e-15));
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
      for (const double u : r.displacements.at(0)) CHECK(u == 0.0);
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
  const auto state_of = [](const std::string& elements) {
    return judged("[plate]\nsize = [8, 6]\nelements = " + elements +
                      "\nD = 1e9\nnu = 0.2\n[[bed]]\nmodulus = 1\nface = 0\n[[step]]\nuniform = -10\n"
                      "point = [ { at = [4, 3], w = -100 } ]\n",
                  "corrected")
        .of_step(1);
  };
  CHECK(state_of("[16, 12]").certified);
  const certificate fine = state_of("[32, 24]");
  CHECK((fine.certified || fine.problem.find("use fewer elements") != std::string::npos));
}
