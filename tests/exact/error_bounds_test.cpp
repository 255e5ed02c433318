// Tests proved error bounds against exact answers, also for states with faults.
#include "contct/proof/error_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/number/random.hpp"
#include "contct/proof/certificate.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/results/random_problem.hpp"
#include "support/beams.hpp"
#include "support/exact_lines.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

/// A state at the end of a step with its numbers and bounds.
struct told_end : structure_state {
  error_bounds bounds = {};
};

/// A path whose errors are bounded at the ends of steps. If `refined`, the state that the path reached at the
/// end of each step is refined.
struct proved_path {
  explicit proved_path(problem p, bool refined = true, const std::string& kernel = "corrected")
      : what(std::move(p)), structure(structure_of(what)), prover(what, structure) {
    const auto leader = make_kernel(kernel);
    const auto engine = make_engine("refactor", structure);
    const load_history loads(what, structure);
    path way(structure, loads, *engine, *leader, {});
    for (int step = 1; step <= std::ssize(what.steps); ++step) {
      if (way.follow(step).status != path_status::solved || !way.now()) break;
      structure_state s = *way.now();
      if (refined) prover.refine(s);
      (void)way.go_on_from(s);
      s = with_numbers(what, s);
      ends.push_back({s, prover.bound(s)});
    }
    if (!ends.empty()) end = ends.back();
  }
  explicit proved_path(const std::string& text, bool refined = true, const std::string& kernel = "corrected")
      : proved_path(parse_problem(text, "b.toml"), refined, kernel) {}

  [[nodiscard]] exact_path truly() const { return follow_corrected_path(exact_problem_of(what)); }
  /// Returns the bounds for the numbers of `end`, which a test may change.
  error_bounds again() { return prover.bound(end); }

  problem what;
  linear_structure structure;
  error_prover prover;
  std::vector<told_end> ends;
  told_end end;  // of the last step
};

double off(double told, const rational& true_value) {
  return std::abs(contct::rounded(binary_value(told) - true_value));
}

/// Returns the moments of a plate under u, computed in 32 digits.
rational_vector plate_values(const problem& p, int step, const rational_vector& u) {
  long_vector rounded;
  for (const rational& x : u) rounded.push_back(contct::long_rounded(x));
  rational_vector all;
  for (const element_value& v : long_system_of(p).element_values(step, rounded))
    all.push_back(binary_value(v.value.hi) + binary_value(v.value.lo));
  return all;
}

/// Returns the shears and then the moments at both ends of each beam element.
rational_vector beam_values(const problem& p, const beam& b, int step, const rational_vector& u) {
  rational_vector all;
  for (int e = 0; e < b.elements(); ++e) {
    const auto [w, moment, shear] = exact_line(b, p.steps[step - 1], e, u);
    for (const auto& line : {shear, moment})
      for (const int t : {0, 1}) all.push_back(polynomial_at(line, rational(t)));
  }
  return all;
}

/// Returns the largest error of each kind in a reported end.
by_quantity errors_of(const problem& p, const exact_step_end& truly, const told_end& told) {
  by_quantity worst;
  const int per_node = dofs_per_node(p.geometry);
  for (std::size_t dof = 0; dof < told.displacement.size(); ++dof)
    worst.take(static_cast<int>(dof) % per_node == 0 ? quantity::w : quantity::slope,
               off(told.displacement[dof], truly.displacement[dof]));
  for (std::size_t i = 0; i < p.pairs.size(); ++i)
    worst.take(quantity::force, off(told.numbers.pair_forces[i], truly.force[i]));
  for (std::size_t i = 0; i < p.supports.size(); ++i)
    worst.take(p.supports[i].dof == 0 ? quantity::reaction : quantity::moment,
               off(told.numbers.reactions[i], truly.reactions[i]));
  const beam* const b = std::get_if<beam>(&p.geometry.kind);
  const rational_vector values = b != nullptr ? beam_values(p, *b, told.step, truly.displacement)
                                              : plate_values(p, told.step, truly.displacement);
  for (std::size_t i = 0; i < values.size(); ++i)
    worst.take(b != nullptr && i % 4 < 2 ? quantity::shear : quantity::moment,
               off(told.numbers.element_values[i], values[i]));
  return worst;
}

/// Checks that every error is within its bound, and returns the number of compared errors.
int check_bounds(const by_quantity& errors, const by_quantity& bounds) {
  int compared = 0;
  for (std::size_t q = 0; q < errors.all.size(); ++q) {
    if (!errors.all[q] || !bounds.all[q]) continue;
    CAPTURE(quantity_names[q].key);
    CHECK(*errors.all[q] <= *bounds.all[q]);
    ++compared;
  }
  return compared;
}

/// Returns true if these bounds certify a state of a beam of length 2.
bool certified(const error_bounds& b) {
  return b.not_proved.empty() && worst_bound(b.error, allowed_errors().of(b, 2.0)).empty();
}

/// Returns the bounds of a state of step 1 of a problem.
error_bounds bounds_of(const std::string& text, const std::vector<double>& u, const std::vector<int>& isep,
                       const end_numbers& numbers) {
  const problem p = parse_problem(text, "b.toml");
  const linear_structure s = structure_of(p);
  return error_prover(p, s).bound({1, 0, 1.0, u, isep, numbers});
}

const std::string beam_over_stop =
    "[beam]\nx = [0, 0.7, 1.3, 2]\nEI = 1e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
    "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.0037\nstiffness = 1e5\n"
    "[[step]]\npoint = [ { node = 4, w = -60 } ]\n";

void check_random_problems(int problems) {
  int steps = 0;
  int compared = 0;
  int proved = 0;
  for (std::uint64_t number = 0; std::cmp_less(number, problems); ++number) {
    const random_problem p = make_random_problem(17, number, {.most_elements = 5});
    const exact_path truly = follow_corrected_path(exact_problem_of(p));
    for (const bool refined : {true, false}) {
      const proved_path path(static_cast<const problem&>(p), refined);
      for (std::size_t i = 0; i < std::min(path.ends.size(), truly.steps.size()); ++i) {
        if (truly.steps[i].fraction != 1) continue;
        CAPTURE(number, i, refined, path.ends[i].bounds.not_proved);
        ++steps;
        if (!path.ends[i].bounds.not_proved.empty()) continue;
        proved += refined ? 1 : 0;
        compared += check_bounds(errors_of(p, truly.steps[i], path.ends[i]), path.ends[i].bounds.error);
      }
    }
  }
  CHECK(steps > problems * 5 / 2);
  CHECK(compared > problems * 10);
  CHECK(2 * proved > steps * 95 / 100);
}

/// Checks the bounds of each step of a run, and returns the number of compared errors.
int check_judged(const judged_run& r) {
  const exact_path truly = follow_corrected_path(exact_problem_of(r.what));
  int compared = 0;
  for (std::size_t i = 0; i < r.steps.size(); ++i) {
    const told_end told{with_numbers(r.what, r.steps[i])};
    if (r.of_step(i + 1).proved)
      compared += check_bounds(errors_of(r.what, truly.steps.at(i), told), r.of_step(i + 1).error);
  }
  return compared;
}

/// Returns a beam or plate with a short element, whose supports and faces move by far more than its bending.
std::string settled_far(random_numbers& random, int kind) {
  const double next = 1 + std::pow(10.0, -random.whole(3, 8)) * random.whole(1, 9);
  const double far = random.whole(-999, 999) / 10.0;
  const std::string face = "\nsurface = \"below\"\nface = -99\nstiffness = 1e4\n";
  const std::string sinks = fmt::format("settlement = [ {}{{ node = 3, w = {} }} ]\n",
                                        kind > 2 ? "" : fmt::format("{{ node = 2, w = {} }}, ", far),
                                        far + random.whole(-9, 9) * (next - 1));
  if (kind == 0)
    return fmt::format(
        "[plate]\nx = [0, 1, {}]\ny = [0, 1]\nD = 1e3\nnu = 0.3\n[[support]]\nnodes = [1, 2, 3, 5]\n"
        "fix = \"w\"\n[[contact]]\nnode = 6{}[[step]]\nuniform = -1\n{}",
        next, face, sinks);
  constexpr const char* fixed[] = {"[2, 3]\nfix = \"w\"", "[2, 3]\nfix = [\"w\", \"theta\"]",
                                   "[3]\nfix = [\"w\", \"theta\"]"};
  return fmt::format(
      "[beam]\nx = [0, 1, {}, 3]\nEI = 1e4\n[[support]]\nnodes = {}\n[[contact]]\nnodes = [1, 4]{}[[case]]\n"
      "name = \"a\"\npoint = [ {{ node = 1, w = -99 }} ]\n{}[[case]]\nname = \"b\"\n{}"
      "move = [ {{ node = 4, w = {} }} ]\n[[combination]]\nname = \"c\"\nterms = {{ a = 1.1, b = -1.2 }}\n",
      next, fixed[kind - 1], face, sinks, kind == 3 ? sinks : "", far);
}

/// A beam on a pair in its middle, with pairs at its ends that are out of reach.
std::string balanced(const std::string& loads) {
  return "[beam]\nx = [0, 0.7, 1.4]\nEI = 1e4\n"
         "[[contact]]\nnode = 2\nsurface = \"below\"\nface = 0\nstiffness = 1e6\n"
         "[[contact]]\nnodes = [1, 3]\nsurface = \"below\"\nface = -0.1\nstiffness = 1e6\n"
         "[[step]]\npoint = [" +
         loads + "]\n";
}

}  // namespace

TEST_CASE(
    "in random problems, error bounds contain the exact errors, and 95 % of refined states are proved") {
  check_random_problems(4);
}

#ifdef CONTCT_HAS_GMP  // Boost's integers take minutes for one long problem
TEST_CASE(
    "in forty random problems, error bounds contain the exact errors, and 95 % of refined states are proved",
    "[long]") {
  check_random_problems(40);
}
#endif

TEST_CASE("if any one number of a state is wrong, the error bound of this number contains the error") {
  proved_path e(beam_over_stop);
  REQUIRE(certified(e.again()));
  const exact_step_end truly = e.truly().steps.back();
  CHECK(check_bounds(errors_of(e.what, truly, e.end), e.again().error) == 6);
  using row = std::tuple<const char*, double, bool, double& (*)(told_end&)>;
  const row faults[] = {
      {"force", 1 + 1e-9, true, [](told_end& t) -> double& { return t.numbers.pair_forces[0]; }},
      {"force", 1 + 1e-5, false, [](told_end& t) -> double& { return t.numbers.pair_forces[0]; }},
      {"force", 0, false, [](told_end& t) -> double& { return t.numbers.pair_forces[0]; }},
      {"reaction", -1, false, [](told_end& t) -> double& { return t.numbers.reactions[0]; }},
      {"moment", 1 + 1e-3, false, [](told_end& t) -> double& { return t.numbers.element_values[2]; }},
      {"displacement", 1 + 1e-9, true, [](told_end& t) -> double& { return t.displacement[6]; }},
      {"displacement", 1 + 1e-4, false, [](told_end& t) -> double& { return t.displacement[6]; }},
  };
  const told_end right = e.end;
  for (const auto& [what, factor, still_certified, number] : faults) {
    INFO(what << " times " << factor);
    e.end = right;
    number(e.end) *= factor;
    const error_bounds b = e.again();
    check_bounds(errors_of(e.what, truly, e.end), b.error);
    CHECK(certified(b) == still_certified);
  }
  // A state that was computed with a stiffness that is wrong by 1e-9:
  e.end =
      proved_path(std::string(beam_over_stop).replace(beam_over_stop.find("1e4"), 3, "1.000000001e4")).end;
  error_prover prover(e.what, e.structure);
  const error_bounds b = prover.bound(e.end);
  check_bounds(errors_of(e.what, truly, e.end), b.error);
  CHECK(*b.error[quantity::w] >= 1e-10 * *b.size[quantity::w]);
}

TEST_CASE("refine replaces displacements that are only rounding by 0, so that the state is certified") {
  const proved_path e(
      "[beam]\nx = [0, 1, 2]\nEI = 1e4\n[[support]]\nnodes = [1, 3]\nfix = \"w\"\n[[contact]]\nnode = 2\n"
      "surface = \"below\"\nface = -1\nstiffness = 1e5\n[[step]]\npoint = [ { node = 3, w = -7 } ]\n");
  structure_state s{1, 0, 1.0, {0.0, 3e-178, -2e-178, 1e-178, 0.0, -4e-178}, {separated}};
  error_prover prover(e.what, e.structure);
  REQUIRE(prover.refine(s));
  CHECK(s.displacement == std::vector<double>(6, 0.0));
  CHECK(s.numbers.reactions[1] == 7.0);
  const error_bounds b = prover.bound(s);
  CHECK(b.error[quantity::w] == 0.0);
  CHECK(certified(b));
}

TEST_CASE(
    "without load, displacements have error bounds if supports hold the structure, and otherwise only forces "
    "have") {
  const std::string freed =
      "[beam]\nlength = 4\nelements = 4\nEI = 1e4\n[[support]]\nnodes = [1, 5]\nfix = \"w\"\n"
      "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -1e-4\nstiffness = 1e5\n[[step]]\nuniform = -10\n"
      "[[step]]\nuniform = 0\n";
  const proved_path listing(freed, false, "fortran");
  REQUIRE(listing.ends.size() == 2);
  CHECK(listing.ends[1].bounds.unloaded);
  CHECK(listing.ends[1].bounds.unique);
  CHECK(*listing.ends[1].bounds.error[quantity::w] == Approx(std::abs(listing.ends[1].displacement[4])));

  const error_bounds b = bounds_of(
      "[beam]\nlength = 1\nelements = 1\nEI = 1e4\n[[bed]]\nmodulus = 10\nface = 0\n[[step]]\nuniform = 0\n",
      {1.0, 0.0, 1.0, 0.0}, {in_contact, in_contact}, {{0.0, 0.0}, {}, {0.0, 0.0, 0.0, 0.0}});
  CHECK_FALSE(b.unique);
  CHECK_FALSE(b.error[quantity::w]);
  CHECK(*b.error[quantity::force] == 0.0);
}

TEST_CASE(
    "the error bound of an unloaded state is at least the largest number at any pair, support or element") {
  const auto errors_with = [](std::size_t where, double value) {
    end_numbers told{std::vector<double>(2), std::vector<double>(2), std::vector<double>(16)};
    (where < 2   ? told.pair_forces[where]
     : where < 4 ? told.reactions[where - 2]
                 : told.element_values[where - 4]) = value;
    return bounds_of(
               "[beam]\nlength = 4\nelements = 4\nEI = 1e4\n[[support]]\nnodes = [1, 5]\nfix = \"w\"\n"
               "[[contact]]\nnodes = [2, 3]\nsurface = \"below\"\nface = -1e-4\nstiffness = 1e5\n"
               "[[step]]\nuniform = 0\n",
               std::vector<double>(10), {separated, separated}, told)
        .error;
  };
  for (std::size_t where = 0; where < 20; ++where) {
    const by_quantity error = errors_with(where, -0.25);
    // Each element has shears at both ends, and then moments at both ends.
    const quantity q = where < 2             ? quantity::force
                       : where < 4           ? quantity::reaction
                       : (where - 4) % 4 < 2 ? quantity::shear
                                             : quantity::moment;
    CAPTURE(where);
    CHECK(*error[q] >= 0.25);
    // Inside an element, a moment or shear may differ more from 0 than at its nodes.
    CHECK(*error[q] <= (where < 4 ? 0.25 : 0.75) * (1 + 1e-8));
    for (const quantity other : {quantity::force, quantity::reaction, quantity::shear, quantity::moment})
      if (other != q && (where < 4 || other == quantity::force || other == quantity::reaction))
        CHECK(*error[other] == 0.0);
  }
}

TEST_CASE(
    "if it is not certain that a structure is held, the state is not proved, and the reason is reported") {
  const proved_path watch(  // pair 1 holds the beam without a force
      "[beam]\nx = [0, 1, 2]\nEI = 1e4\n[[contact]]\nnodes = [1, 2]\nsurface = \"below\"\nface = 0\n"
      "stiffness = 1e6\n[[step]]\npoint = [ { node = 2, w = -1 } ]\n",
      false);
  CHECK(watch.end.bounds.not_proved ==
        "it is not certain that the structure is held: a pair that must hold it may not press");
}

TEST_CASE("reactions are certified at supports that are fixed, have springs and settle") {
  const std::string clamped =
      "[beam]\nlength = 2\nelements = 2\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
      "[[support]]\nnode = 1\nspring = { w = 5 }\n"
      "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -0.1\nstiffness = 10\n";
  const proved_path e(clamped +
                      "[[support]]\nnode = 3\nfix = \"w\"\n[[step]]\npoint = [{ node = 2, w = -1 }]\n"
                      "settlement = [{ node = 1, w = -0.3 }]\n");
  CHECK(e.end.numbers.reactions[0] == Approx(-1359.0 / 830).epsilon(1e-15));  // from contct exact
  CHECK(e.end.numbers.reactions[2] == Approx(1.5).epsilon(1e-15));
  CHECK(certified(e.end.bounds));
  const proved_path idle(clamped + "[[step]]\npoint = [{ node = 3, w = -1 }]\n");
  CHECK(idle.end.numbers.reactions[2] == 0.0);
  CHECK(certified(idle.end.bounds));
}

TEST_CASE("If supports and faces move, also by far, every number is within its error bound") {
  for (const std::string kernel : {"fortran", "corrected"}) {
    const judged_run raised(
        parse_problem("[beam]\nx = [0, 1, 2]\nEI = 1e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
                      "[[contact]]\nnode = 3\nsurface = \"below\"\nface = -0.004\nstiffness = 5e4\n"
                      "[[step]]\nmove = [ { node = 3, w = 0.01 } ]\n[[step]]\nuniform = -300.0\n"
                      "move = [ { node = 3, w = 0.003 } ]\n[[step]]\nuniform = 0\n",
                      "p.toml"),
        kernel);
    CHECK(raised.all_certified());
    CHECK(check_judged(raised) == 18);
  }
  random_numbers random(7);
  int compared = 0;
  for (int number = 0; number < 32; ++number) {
    const std::string text =
        number > 0
            ? settled_far(random, number % 4)
            : "[beam]\nx = [0, 1, 1.00000007]\nEI = 1e4\n[[support]]\nnode = 3\nfix = [\"w\", \"theta\"]\n"
              "[[step]]\npoint = [ { node = 1, w = -1e2 } ]\nsettlement = [ { node = 3, w = 81.9 } ]\n";
    CAPTURE(number, text);
    compared += check_judged({parse_problem(text, "far.toml"), "corrected"});
  }
  CHECK(compared > 32 * 5);
}

TEST_CASE("if a beam balances on one face, forces have proved bounds, but displacements have none") {
  const proved_path e(balanced("{ node = 1, w = -0.1 }, { node = 3, w = -0.1 }, { node = 2, w = -3 }"));
  CHECK(certified(e.end.bounds));
  CHECK_FALSE(e.end.bounds.unique);
  CHECK_FALSE(e.end.bounds.error[quantity::w]);
  CHECK(e.end.numbers.pair_forces[0] == Approx(3.2).epsilon(1e-15));
  CHECK(*e.end.bounds.error[quantity::force] < 1e-14);
  CHECK(*e.end.bounds.error[quantity::moment] < 1e-14);
  const proved_path uneven(  // by one part in 1e13
      balanced("{ node = 1, w = -0.1 }, { node = 3, w = -0.1000000000001 }, { node = 2, w = -3 }"));
  CHECK(uneven.end.bounds.unique);
  CHECK(uneven.end.numbers.pair_forces[1] == 0.0);
  CHECK(uneven.end.numbers.pair_forces[2] == Approx(1e-13).epsilon(1e-6));
  CHECK(certified(uneven.end.bounds));
}

TEST_CASE(
    "if too few pairs exist to hold a structure that balances on one of them, forces have proved bounds") {
  const std::string middle = "\nsurface = \"below\"\nface = 0\nstiffness = 1e6\n[[step]]\n";
  const std::pair<std::string, double> rows[] = {
      {"[beam]\nx = [0, 6, 12]\nEI = 1e4\n[[contact]]\nnode = 2" + middle + "uniform = -15\n", 180},
      {"[beam]\nx = [0, 6, 12, 18]\nEI = 1e4\n[[hinge]]\nnode = 3\n[[support]]\nnode = 4\nfix = "
       "\"w\"\n[[contact]]\nnode = 2" +
           middle + "point = [ { node = 2, w = -15 } ]\n",
       15},
      {"[plate]\nx = [0, 1, 2]\ny = [0, 1, 2]\nD = 100\nnu = 0.3\n[[contact]]\nnode = 5" + middle +
           "uniform = -15\n",
       60}};
  for (const auto& [text, force] : rows) {
    CAPTURE(text);
    const judged_run r(parse_problem(text, "b.toml"), "corrected");
    CHECK(r.of_step(1).certified);
    CHECK_FALSE(r.of_step(1).unique);
    CHECK(r.numbers(1).pair_forces[0] == Approx(force).epsilon(1e-14));
    CHECK(check_judged(r) >= 2);
  }
}

TEST_CASE(
    "if a residual underflows at a stiffness of 1e-300, the error bound still contains the error of a wrong "
    "slope") {
  // The exact displacements are 0, because the load is at a support.
  const error_bounds b = bounds_of(
      "[beam]\nlength = 2.5\nelements = 1\nEI = 1e-300\n[[support]]\nnode = 1\nfix = \"w\"\n"
      "[[support]]\nnode = 2\nfix = [\"w\", \"theta\"]\n[[step]]\npoint = [ { node = 1, w = -1 } ]\n",
      {0.0, 1.5e-24, 0.0, 0.0}, {}, {{}, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0}});
  const std::optional<double> slope = b.error[quantity::slope];
  CHECK((!slope || *slope >= 1.5e-24));
}

TEST_CASE(
    "the error bound of a refined state takes no solve, but the bound of a state rounded to doubles takes "
    "one") {
  const proved_path e(beam_over_stop);
  error_prover prover(e.what, e.structure, nullptr, true);
  const auto has_no_z = [](const error_bounds& b) {
    REQUIRE(b.proof);
    return std::ranges::all_of(b.proof->z, [](const double_double& x) { return x == 0.0; });
  };
  CHECK_FALSE(has_no_z(prover.bound(e.end)));
  structure_state s = static_cast<const structure_state&>(e.end);
  REQUIRE(prover.refine(s));
  CHECK(has_no_z(prover.bound(s)));
}

TEST_CASE(
    "a pair whose face is 1e-300 or less from 0 has the force of a face at 0, but its state is not "
    "certified") {
  for (const char* face : {"-5e-324", "-1e-310", "-1.2345678901234567e-300", "0"}) {
    INFO(face);
    const proved_path e(
        "[beam]\nlength = 2\nelements = 2\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n"
        "[[contact]]\nnode = 2\nsurface = \"below\"\nface = " +
        std::string(face) +
        "\nstate = \"separated\"\nstiffness = 10\n[[step]]\npoint = [{ node = 3, w = -1 }]\n");
    CHECK(e.end.numbers.pair_forces[0] == Approx(25.0 / 13).epsilon(1e-14));
    CHECK(off(e.end.numbers.pair_forces[0], e.truly().steps[0].force[0]) < 1e-14);
    CHECK(certified(e.end.bounds) == (std::string(face) == "0"));
  }
}
