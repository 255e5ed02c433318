// Tests factors with upper bounds on their errors, and proved lower bounds on the least eigenvalue of a
// matrix.
#include "contct/proof/factors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "catch.hpp"
#include "contct/number/rational.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/scaled_stiffness.hpp"
#include "support/beams.hpp"
#include "support/matrices.hpp"

using namespace contct;

namespace {

/// Returns two springs of stiffness 1 in series, and a softer spring to the ground that doubles cannot hold.
long_band springs_in_line(double soft) {
  long_band a(3, 1);
  a.at(0, 0) = 1.0;
  a.at(1, 0) = -1.0;
  a.at(1, 1) = 2.0;
  a.at(2, 1) = -1.0;
  a.at(2, 2) = double_double(1.0) + soft;
  return a;
}

/// Returns the largest row sum of |A - L L'|, computed in long double.
double largest_row(const sparse_columns& a, const sparse_columns& l) {
  const int n = a.order();
  using dense = std::vector<std::vector<long double>>;
  const auto lower = [n](const sparse_columns& of) {
    dense all(n, std::vector<long double>(n));
    for (int column = 0; column < n; ++column)
      for (int at = of.starts[column]; at < of.starts[column + 1]; ++at)
        all[of.rows[at]][column] = of.values[at];
    return all;
  };
  const dense of_a = lower(a);
  const dense of_l = lower(l);
  long double largest = 0;
  for (int i = 0; i < n; ++i) {
    long double sum = 0;
    for (int j = 0; j < n; ++j)
      sum += std::abs(of_a[std::max(i, j)][std::min(i, j)] -
                      std::inner_product(of_l[i].begin(), of_l[i].end(), of_l[j].begin(), 0.0L));
    largest = std::max(largest, sum);
  }
  return static_cast<double>(largest);
}

/// Returns a lower triangle L for which L L' is far from K.
sparse_columns lower_of(const band_matrix& k) {
  sparse_columns l = columns_of(k);
  for (double& x : l.values) x = std::sin(37 * x);
  return l;
}

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

std::vector<int> in_order(std::size_t n) {
  std::vector<int> rows(n);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

/// Returns the proved lower bound on the least eigenvalue with these pairs in contact; 0 if there is none.
double bound_of(scaled_stiffness& k, const std::vector<int>& closed = {}) {
  return k.factor(closed) ? k.least_eigenvalue() : 0.0;
}

/// Returns the least eigenvalue of a chain of n springs.
double least_of(int n) {
  return 4 * std::pow(std::sin(std::numbers::pi / 2 / (n + 1)), 2);
}

}  // namespace

TEST_CASE(
    "a positive definite matrix 2^-90 from singular has a factor in 32 digits, and an indefinite one has "
    "none") {
  long_band l = springs_in_line(0x1p-90);
  REQUIRE(factor(l));
  std::vector<double_double> x = {1.0, 0.0, 0.0};
  solve_with(l, x);
  CHECK(x[2].hi == Approx(0x1p90).epsilon(1e-4));
  CHECK((x[0] - x[1]).hi == Approx(1.0).epsilon(1e-3));

  CHECK(doubtful_motion_in(l)[2] == double_double(0.0));

  const long_band indefinite = springs_in_line(-0x1p-90);
  long_band failed = indefinite;
  REQUIRE_FALSE(factor(failed));
  x = doubtful_motion_in(failed);  // a displacement with negative work of the springs
  double_double work;
  for (int i = 0; i < 3; ++i)
    for (int j = std::max(0, i - 1); j <= i; ++j)
      work += (i == j ? 1 : 2) * indefinite.at(i, j) * x[i] * x[j];
  CHECK(work.hi == Approx(-0x1p-90).epsilon(1e-4));
}

TEST_CASE(
    "the error bound of a correct factor in 32 digits is below 2^-88, and a wrong entry increases the "
    "bound") {
  const long_band a = springs_in_line(0x1p-60);
  long_band l = a;
  REQUIRE(factor(l));
  const double error = largest_row_of_error(a, l, 0.0);
  CHECK(error > 0.0);
  CHECK(error < 0x1p-88);
  CHECK(largest_row_of_error(a, l, 0x1p-80) >= 3 * 0x1p-80);

  l.at(2, 1) += 0x1p-70;  // a wrong entry
  CHECK(largest_row_of_error(a, l, 0.0) > 0x1p-71);
  l.at(2, 1) = std::nan("");
  CHECK(std::isinf(largest_row_of_error(a, l, 0.0)));
}

TEST_CASE(
    "factor and solution of a band matrix are correct for any bandwidth, also in the first and last rows") {
  const int n = 40;
  for (const int b : {0, 1, 5, 39}) {
    long_band a(n, b);
    for (int i = 0; i < n; ++i)
      for (int j = a.first(i); j <= i; ++j) a.at(i, j) = i == j ? 1.0 : 0.5 / (b + 1) / (1 + i - j);
    long_band l = a;
    REQUIRE(factor(l));
    CAPTURE(b);
    CHECK(largest_row_of_error(a, l, 0.0) < (2 * b + 2) * (b + 8) * 0x1p-97);
    std::vector<double_double> x(n);
    for (int i = 0; i < n; ++i) x[i] = i + 1;
    solve_with(l, x);
    for (int i = 0; i < n; ++i) {
      double_double back;
      for (int j = std::max(0, i - b); j <= std::min(n - 1, i + b); ++j)
        back += a.at(std::max(i, j), std::min(i, j)) * x[j];
      CHECK(std::abs((back - (i + 1)).hi) < 0x1p-90);
    }
  }
  CHECK(can_be_factored_long(100'000, 3));
  CHECK_FALSE(can_be_factored_long(10'000, 100));
}

TEST_CASE(
    "the bound on the largest row sum of the error of a factor exceeds the true row sum only by rounding") {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const sparse_columns a = columns_of(random_band(40, 7, seed));
    const sparse_columns l = lower_of(random_band(40, 11, seed + 10));  // L has entries at zeros of A
    const double bound = largest_row_of_error(a, l);
    CHECK(bound >= largest_row(a, l));
    CHECK(bound <= largest_row(a, l) * (1 + 1e-9));
  }
}

TEST_CASE(
    "the error bound is only rounding for an exact factor, and larger for a factor with a relative error of "
    "1e-9") {
  // L has ones on and below its diagonal, so A_ij = 1 + min(i, j) exactly.
  constexpr int n = 6;
  sparse_columns l;
  sparse_columns a;
  for (int column = 0; column < n; ++column) {
    for (int row = column; row < n; ++row) {
      l.rows.push_back(row);
      l.values.push_back(1.0);
      a.rows.push_back(row);
      a.values.push_back(1.0 + column);
    }
    l.starts.push_back(static_cast<int>(l.rows.size()));
    a.starts.push_back(static_cast<int>(a.rows.size()));
  }
  const double rounding = largest_row_of_error(a, l);
  CHECK(rounding > 0.0);
  CHECK(rounding < 1e-13);
  l.values[1] += 1e-9;  // row 1 of column 0 affects all later rows
  CHECK(largest_row_of_error(a, l) >= largest_row(a, l));
  CHECK(largest_row_of_error(a, l) > 6e-9);
  l.values[3] = std::nan("");
  CHECK(std::isinf(largest_row_of_error(a, l)));
}

TEST_CASE(
    "the proved lower bound on the least eigenvalue of a chain of springs is at least 1 % of the "
    "eigenvalue") {
  for (const int n : {1, 2, 10, 1000, 30000}) {
    const long_system t = chain(n);
    scaled_stiffness k(t, in_order(n), 1);
    const double mu = bound_of(k);
    const double least = k.scale(0) * k.scale(0) * least_of(n);
    CAPTURE(n, mu, least);
    CHECK(mu <= least);
    CHECK(mu >= least / 100);
    if (!sparse_factor::available() || n > 1000) continue;
    scaled_stiffness columns(t, in_order(n), std::nullopt);
    CHECK(bound_of(columns) == Approx(mu).epsilon(1e-3));
    CHECK_FALSE(columns.proof());
    std::vector<double> b(n, 1.0);
    columns.solve(b);
    for (const double_double& back : columns.times(long_vector(b.begin(), b.end())))
      CHECK(back.hi == Approx(1.0).epsilon(1e-8));
  }
}

TEST_CASE(
    "a matrix without a factor in doubles is proved definite in 32 digits, with L as a sum of two doubles") {
  long_system t = chain(20);
  t.stiffness[0][0] = double_double(1.0) + 0x1p-60;  // both ends are free, except for a soft spring
  t.stiffness[19][19] = 1.0;
  t.root.front() = t.root.back() = 1 + 1e-15;
  scaled_stiffness k(t, in_order(20), 1, false, true);
  const double mu = bound_of(k);
  CHECK(k.has_32_digits());
  CHECK(mu > 0x1p-60 / 20 / 8 / 100);
  CHECK(mu < 0x1p-60 / 20);
  REQUIRE(k.proof());
  CHECK(std::holds_alternative<long_band>(k.proof()->factor));

  t.stiffness[0][0] = double_double(1.0) - 0x1p-60;
  CHECK(bound_of(k) == 0.0);
}

TEST_CASE("a proved bound on the least eigenvalue is at most the shift minus the exact error of the factor") {
  int proved = 0;
  for (int i = 0; i < 130; ++i) {
    const int n = 2 + i % 5;
    const long_system t =
        chain(n, -least_of(n) + std::ldexp(1.0 + i / 130.0, -48 + i % 4));  // nearly singular
    scaled_stiffness k(t, in_order(n), 1, false, true);
    const double mu = bound_of(k);
    if (mu == 0.0 || !k.proof() || std::holds_alternative<long_band>(k.proof()->factor)) continue;
    CAPTURE(n, i, mu);
    CHECK(binary_value(mu) <= binary_value(k.proof()->shift) - error_of(t, *k.proof()));
    ++proved;
  }
  CHECK(proved >= 33);
}

TEST_CASE(
    "a matrix with a negative eigenvalue of -1e-14 gets no eigenvalue bound, as a band or in sparse "
    "storage") {
  for (const double less : {-1e-3, -1e-9, -1e-14}) {
    const long_system t = chain(20, -least_of(20) + less);
    for (const std::optional<int> subdiagonals : {std::optional<int>(1), std::optional<int>()}) {
      if (!subdiagonals && !sparse_factor::available()) continue;
      scaled_stiffness k(t, in_order(20), subdiagonals);
      CAPTURE(less, subdiagonals.has_value());
      CHECK(bound_of(k) == 0.0);
    }
  }
}

TEST_CASE(
    "a plate without supports has a positive eigenvalue bound if the springs of pairs in contact hold the "
    "plate") {
  const std::vector<double> lines = even_beam(1.0, 8, 1.0).x;
  problem p;
  p.geometry = {plate{lines, lines, 2.0, 0.3}};
  for (int node = 0; node < nodes(p.geometry); ++node)
    p.pairs.push_back({node, face_below, 0.0, 0.03, false});
  p.steps = {{}};
  const linear_structure s = structure_of(p);
  const long_system t = long_system_of(p);
  std::vector<int> rows;
  for (int dof = 0; dof < s.dofs(); ++dof) rows.push_back(s.row_of(dof));
  scaled_stiffness k(t, rows, s.stiffness.band().subdiagonals());
  CHECK(bound_of(k) == 0.0);
  CHECK(bound_of(k, in_order(p.pairs.size())) > 1e-8);
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
    CHECK(bound_of(k) > 0.0);
    CHECK_FALSE(k.has_32_digits());
  }
}
