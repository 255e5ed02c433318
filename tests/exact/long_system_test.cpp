// Tests that a problem's equations in 32 digits equal its equations in rational numbers.
#include "contct/proof/long_system.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/exact/path.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct;

namespace {

double off(const double_double& x, const rational& true_value) {
  return std::abs(rounded(binary_value(x.hi) + binary_value(x.lo) - true_value));
}

/// Compares all numbers of the two systems with their allowed differences, and returns the number of
/// comparisons.
int compare(const problem& p) {
  long_system t = long_system_of(p);
  const exact_problem e = exact_problem_of(p);
  int compared = 0;
  REQUIRE(t.dofs() == e.dofs());
  for (std::size_t row = 0; row < t.dofs(); ++row) {
    for (const auto& [column, entry] : t.stiffness[row]) {
      CHECK(off(entry, e.stiffness[row].at(column)) <= long_rounding * t.root[row] * t.root[column]);
      ++compared;
    }
    CHECK(t.root[row] * t.root[row] >= rounded(e.stiffness[row].at(static_cast<int>(row))));
  }
  for (std::size_t i = 0; i < t.pairs.size(); ++i, compared += 2) {
    CHECK(off(t.pairs[i].face, e.pairs[i].face) <= long_rounding * std::abs(t.pairs[i].face.hi));
    CHECK(off(t.pairs[i].stiffness, e.pairs[i].stiffness) <= long_rounding * t.pairs[i].stiffness.hi);
  }
  for (std::size_t step = 0; step < e.steps.size(); ++step) {
    const long_loads& l = t.at_end_of(static_cast<int>(step) + 1);
    for (std::size_t dof = 0; dof < t.dofs(); ++dof, compared += 2) {
      CHECK(off(l.force[dof], e.steps[step].force[dof]) <= long_rounding * l.size[dof]);
      CHECK(off(l.settlement[dof], e.steps[step].settlement[dof]) <=
            long_rounding * std::abs(l.settlement[dof].hi));
    }
  }
  return compared;
}

}  // namespace

TEST_CASE(
    "the equations of a beam or plate in 32 digits equal those in rational numbers, for uneven elements") {
  CHECK(compare(parse_problem(
            "[beam]\nx = [0.1, 0.3, 0.7, 1.0, 1.9]\nEI = [3.3, 0.1, 7e3, 1e-4]\n[[support]]\nnode = 1\n"
            "fix = \"w\"\n[[support]]\nnode = 3\nspring = { w = 0.7, theta = 1e-3 }\n[[contact]]\nnode = 4\n"
            "surface = \"above\"\nface = 0.1\nstiffness = 1.1e9\n[[bed]]\nmodulus = 0.3\nface = -0.2\n"
            "[[step]]\nuniform = -0.7\n"
            "point = [ { node = 2, w = -0.1, theta = 0.2 }, { node = 2, w = 0.3 } ]\n[[step]]\n"
            "uniform = [ { polynomial = [0.1, -0.3, 0.7], elements = [2, 3] }, { value = 0.3 } ]\n"
            "settlement = [ { node = 1, w = -0.01 } ]\n",
            "b.toml")) > 100);
  CHECK(
      compare(parse_problem(
          "[plate]\nx = [0.0, 0.3, 1.0]\ny = [0.0, 0.7, 0.9, 2.3]\nD = 0.7\nnu = 0.3\n[[support]]\nnode = 1\n"
          "fix = \"w\"\n[[bed]]\nmodulus = 0.9\nface = 0.0\n[[step]]\nuniform = -0.1\n",
          "p.toml")) > 500);
}

TEST_CASE("moments of an element are exact in 32 digits even at x = 1e8") {
  const problem p =
      parse_problem("[beam]\nx = [100000000, 100000000.1]\nEI = 3.0\n[[step]]\nuniform = 0.0\n", "b.toml");
  const long_system t = long_system_of(p);
  // w = 1e6 + 1e3 s + s^2 for s from 0 to 1/10.
  const long_vector u = {1e6, 1e3, double_double(1e6) + 100 + number_of<double_double>(0.01),
                         double_double(1e3) + number_of<double_double>(0.2)};
  const std::vector<element_value> v = t.element_values(1, u);
  REQUIRE(v.size() == 4);
  CHECK(off(v[0].value, 0) <= 64 * long_rounding * v[0].size);
  CHECK(off(v[2].value, 6) <= 64 * long_rounding * v[2].size);
  CHECK(off(v[3].value, 6) <= 64 * long_rounding * v[3].size);
  CHECK(v[2].size < 1e12);
}

TEST_CASE(
    "shear and moment of an element are at most a known factor times the square root of the strain energy") {
  // An element with equal neighbours, next to a longer or a shorter element.
  for (const char* mesh : {"[0.0, 0.4, 0.8, 2.8]\nEI = [5.0, 5.0, 7.0]", "[0.0, 0.4, 2.4, 4.4]\nEI = 5.0",
                           "[0.0, 2.0, 4.0, 4.4]\nEI = [5.0, 7.0, 7.0]"}) {
    const problem p =
        parse_problem("[beam]\nx = " + std::string(mesh) + "\n[[step]]\nuniform = 0.0\n", "b.toml");
    const long_system t = long_system_of(p);
    const beam& b = std::get<beam>(p.geometry.kind);
    const auto energy_of = [&](const long_vector& u) {  // u' K u
      double_double sum;
      for (std::size_t row = 0; row < t.dofs(); ++row)
        for (const auto& [column, entry] : t.stiffness[row]) sum += u[row] * entry * u[column];
      return sum.hi;
    };
    for (std::size_t e = 0; e < 3; ++e) {
      // Both ends rotate equally, so that the element has only shear, and the neighbours do not bend.
      long_vector sheared(8, 1.0);
      for (std::size_t node = 0; node < 4; ++node) sheared[2 * node] = b.x[node] - b.x[node <= e ? e : e + 1];
      const std::vector<element_value> v = t.element_values(1, sheared);
      const double root = std::sqrt(energy_of(sheared));
      CAPTURE(e, root);
      for (const std::size_t shear : {4 * e, 4 * e + 1}) {  // the bound is reached
        CHECK(std::abs(v[shear].value.hi) == Approx(v[shear].energy * root).epsilon(1e-12));
        CHECK(std::abs(v[shear + 2].value.hi) <= v[shear + 2].energy * root);
      }
      CHECK(std::abs(v[4 * e].value.hi) == Approx(12 * b.EI[e] / std::pow(b.length_of(e), 2)));
    }
  }
}
