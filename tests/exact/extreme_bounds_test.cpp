// Tests proved bounds on extremes inside elements against exact polynomials.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/model/extremes.hpp"
#include "contct/number/random.hpp"
#include "contct/read/problem_file.hpp"
#include "support/exact_lines.hpp"
#include "support/judged_run.hpp"

using namespace contct;

namespace {

rational_vector derivative_of(const rational_vector& p) {
  rational_vector d;
  for (std::size_t i = 1; i < p.size(); ++i) d.push_back(p[i] * static_cast<int>(i));
  return d;
}

struct range {
  rational least, most;
};

/// Adds the values of p at t = 0, at t = 1 and at local extremes to `known`. A local extreme is found by 30
/// bisections between two of 33 points at which the derivative has different signs.
void take_extremes(const rational_vector& p, range& known) {
  const rational_vector slope = derivative_of(p);
  const auto take = [&](const rational& t) {
    const rational value = value_at(p, t);
    known.least = std::min(known.least, value);
    known.most = std::max(known.most, value);
  };
  take(0);
  take(1);
  for (int i = 0; i < 32; ++i) {
    rational a(i, 32);
    rational b(i + 1, 32);
    const bool rises = value_at(slope, a) > 0;
    if ((value_at(slope, b) > 0) == rises) continue;
    for (int half = 0; half < 30; ++half) {
      const rational middle = (a + b) / 2;
      (value_at(slope, middle) > 0) == rises ? a = middle : b = middle;
    }
    take(a);
  }
}

struct outcome {
  certificate proof;
  std::vector<contct::value_range> printed;
  std::array<range, 3> truly;
  std::vector<std::pair<double, rational>> slopes;  // printed, and exact
};

outcome outcome_of(const problem& p) {
  const judged_run r(p, "corrected", false);
  outcome o{r.of_step(1),
            ranges_of(p.geometry, p.steps[0], r.displacements.at(0), {}, r.numbers.at(0).element_values),
            {},
            {}};
  const rational_vector u = follow_corrected_path(exact_problem_of(p)).steps.back().displacement;
  const beam& b = std::get<beam>(p.geometry.kind);
  const beam_lines printed(b, p.steps[0], r.displacements.at(0), r.numbers.at(0).element_values);
  for (int e = 0; e < b.elements(); ++e) {
    const auto line = exact_line(b, p.steps[0], e, u);
    const rational h = decimal_of(b.x[static_cast<std::size_t>(e) + 1]) - decimal_of(b.x[e]);
    std::vector<double> places = extreme_places(printed.at(e));
    places.insert(places.end(), {0.0, 0.3, 1.0});
    for (const double t : places)
      o.slopes.emplace_back(polynomial_at(printed.at(e).slope, t),
                            value_at(derivative_of(line[0]), binary_value(t)) / h);
    for (std::size_t i = 0; i < 3; ++i) {
      if (e == 0) o.truly[i] = {line[i][0], line[i][0]};
      take_extremes(line[i], o.truly[i]);
    }
  }
  return o;
}

/// Checks that each extreme and slope is within its bound, and returns the number of extremes.
int check_extremes(const outcome& o) {
  int compared = 0;
  const quantity kinds[] = {quantity::w, quantity::moment, quantity::shear};
  for (const auto& [told, truly] : o.slopes)
    CHECK(abs(binary_value(told) - truly) <= binary_value(o.proof.error[quantity::slope].value()));
  for (std::size_t i = 0; i < 3; ++i) {
    const rational bound = binary_value(o.proof.error[kinds[i]].value());
    CAPTURE(quantity_names[static_cast<std::size_t>(kinds[i])], contct::rounded(bound));
    for (const auto& [told, truly] : {std::pair(o.printed[i].least.value, o.truly[i].least),
                                      std::pair(o.printed[i].most.value, o.truly[i].most)}) {
      CAPTURE(told, contct::rounded(truly));
      CHECK(abs(binary_value(told) - truly) <= bound);
      ++compared;
    }
  }
  return compared;
}

/// Returns a beam far from x = 0 on three supports and a stop, under a load whose polynomial about the left
/// end is multiplied out in x. If `hinged`, the beam is clamped and has a hinge over the stop.
problem far_beam(random_numbers& random, bool hinged = false) {
  const double left = std::pow(10.0, 3 + random.whole(0, 3)) * (1 + random.whole(0, 2));
  const int degree = random.whole(1, 6);
  std::vector<rational> sum(1);
  for (int i = degree; i >= 0; --i) {  // Horner's rule in x - left
    sum.emplace_back(0);
    for (std::size_t k = sum.size(); k-- > 1;) sum[k] = sum[k - 1] - sum[k] * decimal_of(left);
    sum[0] = random.whole(-9, 9) - sum[0] * decimal_of(left);
  }
  sum.pop_back();
  std::ostringstream text;
  text.precision(17);
  text << "[beam]\nx = [" << left << ", " << left + 1 << ", " << left + 2.5 << "]\nEI = 1e4\n"
       << "[[support]]\nnodes = [1, 3]\nfix = [\"w\"]\n"
       << (hinged ? "[[support]]\nnode = 1\nfix = [\"theta\"]\n[[hinge]]\nnode = 2\n" : "")
       << "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1e-5\nstiffness = 1e5\n"
       << "[[step]]\nuniform = [ { polynomial = [";
  for (const rational& a : sum) text << contct::rounded(a) << (&a == &sum.back() ? "" : ", ");
  text << "] } ]\n";
  return parse_problem(text.str(), "far.toml");
}

}  // namespace

TEST_CASE("Extremes inside elements are within proved bounds for random polynomial loads far from x = 0") {
  random_numbers random(38);
  int compared = 0;
  int certified = 0;
  constexpr int problems = 300;
  for (int number = 0; number < problems; ++number) {
    const problem p = far_beam(random);
    CAPTURE(number);
    const outcome o = outcome_of(p);
    if (o.proof.proved) compared += check_extremes(o);
    if (o.proof.certified) ++certified;
  }
  CHECK(compared > 6 * problems * 9 / 10);
  CHECK(certified > problems * 9 / 10);
}

TEST_CASE("Extremes inside elements next to a hinge are within proved bounds") {
  random_numbers random(41);
  int compared = 0;
  for (int number = 0; number < 100; ++number) {
    CAPTURE(number);
    const outcome o = outcome_of(far_beam(random, true));
    if (o.proof.proved) compared += check_extremes(o);
  }
  CHECK(compared > 540);
}

TEST_CASE("Loads that cancel at nodes, but not inside an element, have extremes within proved bounds") {
  const std::string cases = "[[case]]\nname = \"a\"\nuniform = -1\n[[case]]\nname = \"b\"\nuniform = [ { ";
  const std::string sum = " } ]\n[[combination]]\nname = \"c\"\nterms = { a = 1, b = -1 }\n";
  const std::pair<std::string, std::array<range, 3>> rows[] = {
      // w, moment and shear
      {"[[step]]\npoint = [ { x = 0.1, w = 1 }, { x = 0.3, w = -4 }, { x = 0.5, w = 6 }, { x = 0.7, w = -4 "
       "}, "
       "{ x = 0.9, w = 1 } ]\n",
       {{{0, {2, 375}}, {{-2, 5}, {1, 5}}, {-3, 3}}}},
      {"[[step]]\ncurvature = [ { value = 1, to = 0.25 }, { value = -1, from = 0.25, to = 0.75 }, { value = "
       "1, "
       "from = 0.75 } ]\n",
       {{{0, {1, 16}}, {0, 0}, {0, 0}}}},
      // The sum is the Legendre polynomial of degree 4 with its sign changed: the fourth derivative of
      // -(x (1 - x))^4 / 24. It is orthogonal to cubics.
      {cases + "polynomial = [0, -20, 90, -140, 70]" + sum, {{{{-1, 6144}, 0}, {{-1, 294}, {1, 192}}, {}}}},
      {cases + "value = -1, to = 0.5 }, { value = -1, from = 0.5" + sum, {}}};
  int compared = 0;
  for (const auto& [loads, truly] : rows) {
    CAPTURE(loads);
    const problem p = parse_problem(
        "[beam]\nx = [0, 1]\nEI = 1\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n" + loads, "p.toml");
    const judged_run r(p, "corrected");
    outcome o{r.of_step(1),
              ranges_of(p.geometry, p.steps[0], r.displacements[0], {}, r.numbers[0].element_values),
              truly,
              {}};
    if (truly[0].least < 0)
      o.truly[2] = {binary_value(o.printed[2].least.value), binary_value(o.printed[2].most.value)};
    compared += check_extremes(o);
    CHECK(o.proof.certified);
  }
  CHECK(compared == 24);
}

TEST_CASE("The least moment under the load (x - 1000)^6 is -2 16^(1/7), with a proved error below 1e-8") {
  const outcome o = outcome_of(parse_problem(
      "[beam]\nx = [1000, 1001, 1002]\nEI = 1e4\n[[support]]\nnodes = [1, 3]\nfix = [\"w\"]\n"
      "[[contact]]\nnode = 2\nsurface = \"below\"\nface = -1.0\nstiffness = 1.0\n"
      "[[step]]\nuniform = [ { polynomial = [1e18, -6e15, 1.5e13, -2e10, 1.5e7, -6000, 1] } ]\n",
      "sixth.toml"));
  CHECK(check_extremes(o) == 6);
  CHECK(o.proof.certified);
  CHECK(o.printed[1].least.value == Approx(-2 * std::pow(16.0, 1.0 / 7)).epsilon(1e-12));
  CHECK(*o.proof.error[quantity::moment] < 1e-8);
}
