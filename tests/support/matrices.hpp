// Stiffness matrices given by their entries: of a structure, and of a body of springs in space.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "contct/linear/cholesky.hpp"
#include "contct/number/random.hpp"
#include "contct/structure/statics.hpp"

namespace contct {

/// Returns the entries of a structure's matrix in the order of its dofs.
inline sparse_matrix entries_of(const linear_structure& s) {
  sparse_matrix a{s.dofs(), {}};
  const band_matrix k = s.stiffness.band();
  for (int column = 0; column < s.dofs(); ++column) {
    for (int row = column; row < s.dofs(); ++row) {
      const int i = std::max(s.row_of(row), s.row_of(column));
      const int j = std::min(s.row_of(row), s.row_of(column));
      if (i - j > k.subdiagonals()) continue;
      if (const double value = k.at(i, j); value != 0.0) a.entries.push_back({row, column, value});
    }
  }
  return a;
}

/// Returns A x for a symmetric A stored as a band.
inline std::vector<double> product(const band_matrix& a, const std::vector<double>& x) {
  std::vector<double> y(x.size());
  for (int column = 0; column < a.order(); ++column) {
    y[column] += a.at(column, column) * x[column];
    for (int row = column + 1; row <= std::min(column + a.subdiagonals(), a.order() - 1); ++row) {
      y[row] += a.at(row, column) * x[column];
      y[column] += a.at(row, column) * x[row];
    }
  }
  return y;
}

/// Returns the reactions of a structure without pairs.
inline std::vector<double> reactions(const model& m, const load& l, const std::vector<support>& supports,
                                     std::span<const double> u) {
  problem p;
  p.geometry = m;
  p.supports = supports;
  return statics_of(p, l, u, {}).reactions;
}

/// Returns the displacements of a beam or plate on its supports without pairs.
inline std::vector<double> displaced(const model& m, const std::vector<support>& supports, const load& l) {
  const linear_structure s = build(m, supports, {});
  stiffness_factor k(s.stiffness);
  std::vector<double> f = nodal_loads(m, l).force;
  std::vector<double> x(f.size());
  for (int dof = 0; dof < s.dofs(); ++dof) x[s.row_of(dof)] = s.fixed[dof] != 0 ? 0.0 : f[dof];
  REQUIRE(k.factor({}));
  k.solve(x);
  for (int dof = 0; dof < s.dofs(); ++dof) f[dof] = x[s.row_of(dof)];
  return f;
}

/// Returns the matrix of points in space, each with three dofs, with a spring between any two points.
inline sparse_matrix braced(const std::vector<std::array<double, 3>>& points, double stiffness) {
  const auto n = 3 * points.size();
  std::vector<double> k(n * n);
  for (std::size_t a = 0; a < points.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      std::array<double, 3> along{};
      double length = 0.0;
      for (std::size_t i = 0; i < 3; ++i) length += std::pow(points[a][i] - points[b][i], 2);
      for (std::size_t i = 0; i < 3; ++i) along[i] = (points[a][i] - points[b][i]) / std::sqrt(length);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          const double part = stiffness * along[i] * along[j];
          k[(3 * a + i) * n + 3 * a + j] += part;
          k[(3 * b + i) * n + 3 * b + j] += part;
          k[(3 * a + i) * n + 3 * b + j] -= part;
          k[(3 * b + i) * n + 3 * a + j] -= part;
        }
      }
    }
  }
  sparse_matrix m{static_cast<int>(n), {}};
  for (std::size_t column = 0; column < n; ++column)
    for (std::size_t row = column; row < n; ++row)
      if (k[row * n + column] != 0.0)
        m.entries.push_back({static_cast<int>(row), static_cast<int>(column), k[row * n + column]});
  return m;
}

/// Returns the eight corners of a box.
inline std::vector<std::array<double, 3>> box_at(double x) {
  std::vector<std::array<double, 3>> points;
  for (const double z : {0.0, 1.3})
    for (const double y : {0.0, 0.9})
      for (const double along : {0.0, 1.0}) points.push_back({x + along, y, z});
  return points;
}

/// Returns a random positive definite band with many zeros.
inline band_matrix random_band(int order, int subdiagonals, std::uint64_t seed) {
  random_numbers random(seed);
  band_matrix k(order, subdiagonals);
  for (int column = 0; column < order; ++column) {
    for (int row = column + 1; row <= std::min(order - 1, column + subdiagonals); ++row)
      if (random.unit() < 0.4) k.at(row, column) = random.unit() - 0.5;
    k.at(column, column) = 4.0 + random.unit();
  }
  return k;
}

inline std::vector<double> random_vector(int order, std::uint64_t seed) {
  random_numbers random(seed);
  std::vector<double> x;
  for (int i = 0; i < order; ++i) x.push_back(random.unit() - 0.5);
  return x;
}

}  // namespace contct
