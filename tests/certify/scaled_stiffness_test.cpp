// Tests the factor of a stiffness matrix, and the proved lower bound on the matrix's least eigenvalue.
#include "contct/certify/scaled_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "catch.hpp"
#include "contct/number/rational.hpp"
#include "contct/path/solve_problem.hpp"

using namespace contct;
using contct::rational;

namespace {

/// Returns a chain of n springs of stiffness 1 that is held at both ends, with `more` added at each node. The
/// eigenvalues are more + 4 sin^2(j pi / 2 (n + 1)).
long_system chain(int n, double more = 0.0) {
  long_system t;
  t.stiffness.resize(n);
  for (int i = 0; i < n; ++i) {
    for (const int j : {i - 1, i, i + 1}) {
      if (j < 0 || j >= n) continue;
      t.stiffness[i][j] = i == j ? 2.0 + more : -1.0;
    }
    t.root.push_back(std::sqrt(2.0 + more) * (1 + 1e-15));
  }
  t.fixed.assign(n, 0);
  t.deflects.assign(n, 1);
  return t;
}

/// Returns the largest sum of magnitudes in a row of S A S - shift I - L L' for a chain A.
rational error_of(const long_system& a, const stiffness_proof& p) {
  using contct::binary_value;
  const auto& l = std::get<band_matrix>(p.factor);
  const int n = l.order();
  rational most = 0;
  for (int i = 0; i < n; ++i) {
    rational sum = 0;
    for (int j = 0; j < n; ++j) {
      rational entry = i == j ? -binary_value(p.shift) : rational(0);
      const auto there = a.stiffness[i].find(j);
      const double_double of_a = there == a.stiffness[i].end() ? double_double(0.0) : there->second;
      entry += (binary_value(of_a.hi) + binary_value(of_a.lo)) * binary_value(p.scale[i]) *
               binary_value(p.scale[j]);
      for (int m = std::max({0, i - 1, j - 1}); m <= std::min(i, j); ++m)
        entry -= binary_value(l.at(i, m)) * binary_value(l.at(j, m));
      sum += entry < 0 ? rational(-entry) : entry;
    }
    most = std::max(most, sum);
  }
  return most;
}

std::vector<int> in_order(int n) {
  std::vector<int> rows(n);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

}  // namespace

TEST_CASE(
    "the proved lower bound on the least eigenvalue of a chain of springs is at least 1 % of the "
    "eigenvalue") {
  for (const int n : {1, 2, 10, 1000, 30000}) {
    const long_system t = chain(n);
    scaled_stiffness k(t, in_order(n), 1);
    REQUIRE(k.factor({}));
    const double scaled = k.scale(0) * k.scale(0);
    const double least = scaled * 4 * std::pow(std::sin(std::acos(-1.0) / 2 / (n + 1)), 2);
    const double mu = k.least_eigenvalue();
    CAPTURE(n, mu, least);
    CHECK(mu <= least);
    CHECK(mu >= least / 100);
  }
}

TEST_CASE(
    "a matrix without a factor in doubles is proved definite in 32 digits, with L as a sum of two doubles") {
  long_system t = chain(20);
  t.stiffness[0][0] = double_double(1.0) + 0x1p-60;  // both ends are free, except for a soft spring
  t.stiffness[19][19] = 1.0;
  t.root.front() = t.root.back() = 1 + 1e-15;
  scaled_stiffness k(t, in_order(20), 1);
  k.keep_proof();
  REQUIRE(k.factor({}));
  const double mu = k.least_eigenvalue();
  CHECK(k.has_32_digits());
  CHECK(mu > 0x1p-60 / 20 / 8 / 100);
  CHECK(mu < 0x1p-60 / 20);
  REQUIRE(k.proof());
  CHECK(std::holds_alternative<long_band>(k.proof()->factor));

  t.stiffness[0][0] = double_double(1.0) - 0x1p-60;
  CHECK((!k.factor({}) || k.least_eigenvalue() == 0.0));
}

TEST_CASE("a proved bound on the least eigenvalue is at most the shift minus the exact error of the factor") {
  int proved = 0;
  for (int i = 0; i < 400; ++i) {
    const int n = 2 + i % 5;
    const double least = 4 * std::pow(std::sin(std::acos(-1.0) / 2 / (n + 1)), 2);
    const long_system t = chain(n, -least + std::ldexp(1.0 + i / 400.0, -48 + i % 4));  // nearly singular
    scaled_stiffness k(t, in_order(n), 1);
    k.keep_proof();
    if (!k.factor({})) continue;
    const double mu = k.least_eigenvalue();
    if (mu == 0.0 || !k.proof() || std::holds_alternative<long_band>(k.proof()->factor)) continue;
    CAPTURE(n, i, mu);
    CHECK(contct::binary_value(mu) <= contct::binary_value(k.proof()->shift) - error_of(t, *k.proof()));
    ++proved;
  }
  CHECK(proved >= 100);
}

TEST_CASE(
    "a matrix in sparse storage has the same proved eigenvalue bound as the band matrix, within 0.1 %") {
  if (!sparse_factor::available()) return;
  for (const int n : {1, 2, 10, 1000}) {
    const long_system t = chain(n);
    scaled_stiffness band(t, in_order(n), 1);
    scaled_stiffness columns(t, in_order(n), std::nullopt);
    REQUIRE(band.factor({}));
    REQUIRE(columns.factor({}));
    const double mu = columns.least_eigenvalue();
    CHECK(mu == Approx(band.least_eigenvalue()).epsilon(1e-3));
    CHECK_FALSE(columns.proof());
    std::vector<double> b(n, 1.0);
    columns.solve(b);
    for (const double_double& back : columns.times(long_vector(b.begin(), b.end())))
      CHECK(back.hi == Approx(1.0).epsilon(1e-8));
  }
}

TEST_CASE(
    "a matrix with a negative eigenvalue of -1e-14 gets no eigenvalue bound, as a band or in sparse "
    "storage") {
  const double least = 4 * std::pow(std::sin(std::acos(-1.0) / 42), 2);
  for (const double less : {-1e-3, -1e-9, -1e-14}) {
    const long_system t = chain(20, -least + less);
    for (const std::optional<int> subdiagonals : {std::optional<int>(1), std::optional<int>()}) {
      if (!subdiagonals && !sparse_factor::available()) continue;
      scaled_stiffness k(t, in_order(20), subdiagonals);
      CAPTURE(less, subdiagonals.has_value());
      CHECK((!k.factor({}) || k.least_eigenvalue() == 0.0));
    }
  }
}

TEST_CASE(
    "a plate without supports has a positive eigenvalue bound if the springs of pairs in contact hold the "
    "plate") {
  problem p;
  std::vector<double> lines(9);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = static_cast<double>(i) / 8;
  p.geometry = {plate{lines, lines, 2.0, 0.3}};
  for (int node = 0; node < nodes(p.geometry); ++node)
    p.pairs.push_back({node, face_below, 0.0, 0.03, false});
  p.steps = {{}};
  const linear_structure s = structure_of(p);
  const long_system t = long_system_of(p);
  std::vector<int> rows;
  for (int dof = 0; dof < s.dofs(); ++dof) rows.push_back(s.row_of(dof));
  scaled_stiffness k(t, rows, s.stiffness.band().subdiagonals());
  CHECK((!k.factor({}) || k.least_eigenvalue() == 0.0));
  std::vector<int> all(p.pairs.size());
  std::iota(all.begin(), all.end(), 0);
  REQUIRE(k.factor(all));
  CHECK(k.least_eigenvalue() > 1e-8);
  CHECK_FALSE(k.has_32_digits());  // the proof needs only doubles

  std::vector<double> b(t.dofs(), 1.0);
  k.solve(b);
  const long_vector x(b.begin(), b.end());
  for (const double_double& back : k.times(x)) CHECK(back.hi == Approx(1.0).margin(1e-6));
}

TEST_CASE("a chain of springs that is fixed at any one node is proved definite in doubles") {
  for (const int fixed : {0, 3, 9}) {
    long_system t = chain(10);
    t.fixed[fixed] = 1;
    scaled_stiffness k(t, in_order(10), 1);
    REQUIRE(k.factor({}));
    CHECK(k.least_eigenvalue() > 0.0);
    CHECK_FALSE(k.has_32_digits());
  }
}
