// Tests proved bounds on extremes inside elements against exact polynomials, and against finer meshes.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/number/random.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/structure/extremes.hpp"
#include "support/exact_lines.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

struct range {
  rational least, most;
};

constexpr quantity kinds[] = {quantity::w, quantity::moment, quantity::shear};

/// Adds the values of p at t = 0, at t = 1 and at local extremes to `known`. A local extreme is found by 30
/// bisections between two of 33 points at which the derivative has different signs.
void take_extremes(const rational_vector& p, range& known) {
  const rational_vector slope = derivative(p);
  const auto rises_at = [&](const rational& t) { return polynomial_at(slope, t) > 0; };
  std::vector<rational> places = {0, 1};
  for (int i = 0; i < 32; ++i) {
    rational a(i, 32);
    rational b(i + 1, 32);
    const bool rises = rises_at(a);
    if (rises_at(b) == rises) continue;
    for (int half = 0; half < 30; ++half) {
      const rational middle = (a + b) / 2;
      rises_at(middle) == rises ? a = middle : b = middle;
    }
    places.push_back(a);
  }
  for (const rational& t : places) {
    known.least = std::min(known.least, polynomial_at(p, t));
    known.most = std::max(known.most, polynomial_at(p, t));
  }
}

/// The only step of a beam, as it is printed.
struct printed_step {
  explicit printed_step(problem p, bool with_exact_path = false)
      : run(std::move(p), "corrected", with_exact_path) {}

  judged_run run;
  const problem& what = run.what;
  const certificate& proof = run.of_step(1);
  const beam& b = std::get<beam>(what.geometry.kind);
  std::vector<value_range> ranges =
      ranges_of(what.geometry, what.steps[0], run.u(1), {}, run.numbers(1).element_values);
  beam_lines lines = beam_lines(b, what.steps[0], run.u(1), run.numbers(1).element_values);
  rational_vector truly = follow_corrected_path(exact_problem_of(what)).steps.back().displacement;

  void check_slope(double told, const rational& exact) const {
    CHECK(abs(binary_value(told) - exact) <= binary_value(proof.error[quantity::slope].value()));
  }
  /// Checks that the least and the largest w, moment and shear are within their bounds.
  void check_ranges(const std::array<range, 3>& exact) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const rational bound = binary_value(proof.error[kinds[i]].value());
      CAPTURE(i, rounded(bound), ranges[i].least.value, ranges[i].most.value);
      CHECK(abs(binary_value(ranges[i].least.value) - exact[i].least) <= bound);
      CHECK(abs(binary_value(ranges[i].most.value) - exact[i].most) <= bound);
    }
  }
};

/// Checks extremes, and slopes at some places of each element, against exact polynomials, if they are proved.
/// Returns 1 if they are.
int check_extremes(const printed_step& s) {
  if (!s.proof.proved) return 0;
  std::array<range, 3> exact;
  for (int e = 0; e < s.b.elements(); ++e) {
    const auto line = exact_line(s.b, s.what.steps[0], e, s.truly);
    const rational h = decimal_of(s.b.x[static_cast<std::size_t>(e) + 1]) - decimal_of(s.b.x[e]);
    std::vector<double> places = extreme_places(s.lines.at(e));
    places.insert(places.end(), {0.0, 0.3, 1.0});
    for (const double t : places)
      s.check_slope(polynomial_at(s.lines.at(e).slope, t),
                    polynomial_at(derivative(line[0]), binary_value(t)) / h);
    for (std::size_t i = 0; i < 3; ++i) {
      if (e == 0) exact[i] = {line[i][0], line[i][0]};
      take_extremes(line[i], exact[i]);
    }
  }
  s.check_ranges(exact);
  return 1;
}

/// Returns a beam far from x = 0 on three supports and a stop, under a load whose polynomial about the left
/// end is multiplied out in x. `hinge`: empty, or the stiffness of a hinge over the stop; then the beam is
/// clamped.
problem far_beam(random_numbers& random, std::optional<double> hinge) {
  const double left = std::pow(10.0, 3 + random.whole(0, 3)) * (1 + random.whole(0, 2));
  const int degree = random.whole(1, 6);
  std::vector<rational> sum(1);
  for (int i = degree; i >= 0; --i) {  // Horner's rule in x - left
    sum.emplace_back(0);
    for (std::size_t k = sum.size(); k-- > 1;) sum[k] = sum[k - 1] - sum[k] * decimal_of(left);
    sum[0] = random.whole(-9, 9) - sum[0] * decimal_of(left);
  }
  sum.pop_back();
  std::vector<double> polynomial;
  for (const rational& a : sum) polynomial.push_back(rounded(a));
  return parse_problem(
      fmt::format(
          "[beam]\nx = [{}, {}, {}]\nEI = 1e4\n[[support]]\nnodes = [1, 3]\nfix = [\"w\"]\n{}[[contact]]\n"
          "node = 2\nsurface = \"below\"\nface = -1e-5\nstiffness = 1e5\n[[step]]\nuniform = [ {{ "
          "polynomial = [{}] }} ]\n",
          left, left + 1, left + 2.5,
          hinge
              ? fmt::format("[[support]]\nnode = 1\nfix = [\"theta\"]\n[[hinge]]\nnode = 2\nstiffness = {}\n",
                            *hinge)
              : "",
          fmt::join(polynomial, ", ")),
      "far.toml");
}

}  // namespace

TEST_CASE("Extremes inside elements are within proved bounds for random polynomial loads far from x = 0") {
  for (const std::optional<double> hinge : {std::optional<double>(), {0.0}, {300.0}, {1e7}}) {
    random_numbers random(hinge ? 41 : 38);
    const int problems = hinge ? 40 : 100;
    int compared = 0;
    int certified = 0;
    for (int number = 0; number < problems; ++number) {
      CAPTURE(hinge.value_or(-1.0), number);
      const printed_step s(far_beam(random, hinge));
      compared += check_extremes(s);
      certified += s.proof.certified ? 1 : 0;
    }
    CHECK(compared >= problems * 9 / 10);
    if (!hinge) CHECK(certified > problems * 9 / 10);
  }
}

TEST_CASE("Loads that cancel at nodes, but not inside an element, have extremes within proved bounds") {
  const std::string cases = "[[case]]\nname = \"a\"\nuniform = -1\n[[case]]\nname = \"b\"\nuniform = [ { ";
  const std::string sum = " } ]\n[[combination]]\nname = \"c\"\nterms = { a = 1, b = -1 }\n";
  const std::pair<std::string, std::array<range, 3>> rows[] = {
      // w, moment and shear
      {"[[step]]\npoint = [ { x = 0.1, w = 1 }, { x = 0.3, w = -4 }, { x = 0.5, w = 6 }, { x = 0.7, w = -4 "
       "}, { "
       "x = 0.9, w = 1 } ]\n",
       {{{0, {2, 375}}, {{-2, 5}, {1, 5}}, {-3, 3}}}},
      {"[[step]]\ncurvature = [ { value = 1, to = 0.25 }, { value = -1, from = 0.25, to = 0.75 }, { value = "
       "1, "
       "from = 0.75 } ]\n",
       {{{0, {1, 16}}, {0, 0}, {0, 0}}}},
      // The sum is the Legendre polynomial of degree 4 with its sign changed: the fourth derivative of
      // -(x (1 - x))^4 / 24. It is orthogonal to cubics.
      {cases + "polynomial = [0, -20, 90, -140, 70]" + sum, {{{{-1, 6144}, 0}, {{-1, 294}, {1, 192}}, {}}}},
      {cases + "value = -1, to = 0.5 }, { value = -1, from = 0.5" + sum, {}}};
  for (const auto& [loads, truly] : rows) {
    CAPTURE(loads);
    const printed_step s(
        parse_problem("[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n" + loads,
                      "p"),
        true);
    std::array<range, 3> exact = truly;
    if (truly[0].least < 0)  // the extremes of the shear are not compared
      exact[2] = {binary_value(s.ranges[2].least.value), binary_value(s.ranges[2].most.value)};
    s.check_ranges(exact);
    CHECK(s.proof.certified);
  }
}

TEST_CASE("The least moment under the load (x - 1000)^6 is -2 16^(1/7), with a proved error below 1e-8") {
  const printed_step s(parse_problem(
      "[beam]\nx = [1000, 1001, 1002]\nEI = 1e4\n[[support]]\nnodes = [1, 3]\nfix = [\"w\"]\n"
      "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1.0\nstiffness = 1.0\n"
      "[[step]]\nuniform = [ { polynomial = [1e18, -6e15, 1.5e13, -2e10, 1.5e7, -6000, 1] } ]\n",
      "sixth.toml"));
  CHECK(check_extremes(s) == 1);
  CHECK(s.proof.certified);
  CHECK(s.ranges[1].least.value == Approx(-2 * std::pow(16.0, 1.0 / 7)).epsilon(1e-12));
  CHECK(*s.proof.error[quantity::moment] < 1e-8);
}

TEST_CASE(
    "Extremes in two elements equal, within proved bounds, the extremes of a mesh with a node at each load") {
  random_numbers random(41);
  std::size_t slopes = 0;
  for (int number = 0; number < 35; ++number) {
    std::set<double> nodes = {0.0, 2.0, 4.0};
    const auto at = [&](int least, int most) {
      return *nodes.insert(random.whole(least, most) / 16.0).first;
    };
    const auto size = [&](int most = 9) { return random.whole(-most, most); };
    const double from = at(1, 20);
    nodes.insert(from + 1.25);
    const std::string step = fmt::format(
        "uniform = [ {{ value = {}, from = {}, to = {} }}, {{ polynomial = [{}, {}, 0.7], from = {} }} ]\n"
        "point = [ {{ x = {}, w = {} }}, {{ x = {}, theta = {} }} ]\ncurvature = [ {{ value = {}e-4, to = {} "
        "}} ]\n",
        size(), from, from + 1.25, size(), size(), at(1, 60), at(1, 63), size(), at(1, 63), size(3), size(),
        at(1, 63));
    const auto on_nodes = [&](const std::set<double>& x) {
      return printed_step(parse_problem(
          fmt::format("[beam]\nx = [{}]\nEI = 1e3\n[[support]]\nx = [0, 4]\nfix = \"w\"\n[[contact]]\nx = 2\n"
                      "surface = \"below\"\nface = -1e-3\nstiffness = 1e3\n[[step]]\n{}",
                      fmt::join(x, ", "), step),
          "p.toml"));
    };
    CAPTURE(number, step);
    const printed_step coarse = on_nodes({0.0, 2.0, 4.0});
    const printed_step fine = on_nodes(nodes);
    REQUIRE(coarse.proof.certified);
    REQUIRE(fine.proof.certified);
    for (std::size_t i = 0; i < 3; ++i) {
      const double bound = *coarse.proof.error[kinds[i]] + *fine.proof.error[kinds[i]];
      CHECK(std::abs(coarse.ranges[i].least.value - fine.ranges[i].least.value) <= bound);
      CHECK(std::abs(coarse.ranges[i].most.value - fine.ranges[i].most.value) <= bound);
      CHECK(bound < 1e-9);
    }
    for (int e = 0; e < coarse.b.elements(); ++e)
      for (const element_line& piece : coarse.lines.pieces(e)) {
        const std::size_t node = std::ranges::find(fine.b.x, piece.right) - fine.b.x.begin();
        coarse.check_slope(polynomial_at(piece.slope, 1.0), fine.truly.at(2 * node + 1));
        ++slopes;
      }
  }
  CHECK(slopes > 170);
}
