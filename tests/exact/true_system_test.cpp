// The equations of a problem in 32 digits, against the same in rational numbers.
#include "contct/certify/true_system.hpp"

#include <cmath>

#include "catch.hpp"
#include "contct/exact/exact_problem.hpp"
#include "contct/read/problem_file.hpp"

using namespace contct::app;
using namespace contct::certify;
namespace exact = contct::exact;

namespace {

exact::rational exactly(const double_double& x) {
  return exact::binary_value(x.hi) + exact::binary_value(x.lo);
}

double off(const double_double& x, const exact::rational& true_value) {
  return std::abs(exact::rounded(exactly(x) - true_value));
}

/// All that the two have, as far as they may differ.
int compare(const problem& p) {
  const true_system t = true_system_of(p);
  const exact::exact_problem e = exact::exact_problem_of(p);
  int compared = 0;
  REQUIRE(t.dofs() == e.dofs());
  for (std::size_t row = 0; row < t.dofs(); ++row) {
    for (std::size_t at = t.k.starts[row]; at < t.k.starts[row + 1]; ++at, ++compared) {
      const int column = t.k.columns[at];
      const auto found = e.stiffness[row].find(column);
      const exact::rational value = found == e.stiffness[row].end() ? exact::rational(0) : found->second;
      CHECK(off(t.k.values[at], value) <= true_rounding * t.root[row] * t.root[column]);
    }
    CHECK(t.root[row] * t.root[row] >= exact::rounded(e.stiffness[row].at(static_cast<int>(row))));
  }
  for (std::size_t i = 0; i < t.pairs.size(); ++i, compared += 2) {
    CHECK(off(t.pairs[i].face, e.pairs[i].face) <= true_rounding * std::abs(t.pairs[i].face.hi));
    CHECK(off(t.pairs[i].stiffness, e.pairs[i].stiffness) <= true_rounding * t.pairs[i].stiffness.hi);
  }
  for (std::size_t step = 0; step < e.steps.size(); ++step) {
    const true_loads l = t.loads(static_cast<int>(step) + 1);
    for (std::size_t dof = 0; dof < t.dofs(); ++dof, compared += 2) {
      CHECK(off(l.force[dof], e.steps[step].load[dof]) <= true_rounding * l.size[dof]);
      CHECK(off(l.settlement[dof], e.steps[step].settlement[dof]) <=
            true_rounding * std::abs(l.settlement[dof].hi));
    }
  }
  return compared;
}

}  // namespace

TEST_CASE(
    "a beam's equations are those in rational numbers: decimals, uneven meshes, loads, beds, settlements") {
  const problem p = parse_problem(
      "[beam]\nx = [0.1, 0.3, 0.7, 1.0, 1.9]\nEI = [3.3, 0.1, 7e3, 1e-4]\n[[support]]\nnode = 1\nfix = "
      "[\"w\"]\n"
      "[[support]]\nnode = 3\nspring = { w = 0.7, theta = 1e-3 }\n[[contact]]\nnode = 4\nsurface = "
      "\"above\"\n"
      "face = 0.1\nstiffness = 1.1e9\n[[bed]]\nmodulus = 0.3\nface = -0.2\n[[step]]\nuniform = -0.7\n"
      "point = [ { node = 2, w = -0.1, theta = 0.2 }, { node = 2, w = 0.3 } ]\n"
      "[[step]]\nuniform = [ { polynomial = [0.1, -0.3, 0.7], elements = [2, 3] } ]\n"
      "settlement = [ { node = 1, w = -0.01 } ]\n",
      "b.toml");
  CHECK(compare(p) > 100);
}

TEST_CASE("a plate's equations are those in rational numbers, elements of every shape") {
  const problem p = parse_problem(
      "[plate]\nx = [0.0, 0.3, 1.0]\ny = [0.0, 0.7, 0.9, 2.3]\nD = 0.7\nnu = 0.3\n[[support]]\nnode = 1\n"
      "fix = [\"w\"]\n[[bed]]\nmodulus = 0.9\nface = 0.0\n[[step]]\nuniform = -0.1\n",
      "p.toml");
  CHECK(compare(p) > 500);
}

TEST_CASE("equal parts of a length are exact parts: thirds, not what doubles make of them") {
  const problem p =
      parse_problem("[beam]\nlength = 1.0\nelements = 3\nEI = 1.0\n[[step]]\nuniform = -1.0\n", "b.toml");
  const true_system t = true_system_of(p);
  CHECK(off(t.k.values[0], exact::rational(12 * 27)) <= 0x1p-90 * 324);
  CHECK(off(t.loads(1).force[0], exact::rational(-1, 6)) <= 0x1p-90);
}

TEST_CASE(
    "moments and shears of an element are those of the cubic that its nodes have, also far away and tilted") {
  const problem p =
      parse_problem("[beam]\nx = [100000000, 100000000.1]\nEI = 3.0\n[[step]]\nuniform = 0.0\n", "b.toml");
  const true_system t = true_system_of(p);
  // w = 1e6 + 1e3 s + s^2 over s = 0 to 1/10
  const long_vector u = {1e6, 1e3, double_double(1e6) + 100 + contct::numeric::long_decimal(0.01),
                         double_double(1e3) + contct::numeric::long_decimal(0.2)};
  const std::vector<element_value> v = t.element_values(1, u);
  REQUIRE(v.size() == 4);
  CHECK(off(v[0].value, 0) <= 64 * true_rounding * v[0].size);
  CHECK(off(v[2].value, 6) <= 64 * true_rounding * v[2].size);
  CHECK(off(v[3].value, 6) <= 64 * true_rounding * v[3].size);
  CHECK(v[2].size < 1e12);
}
