#include "contct/solve/refined_solve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace contct::solve {

std::vector<spring_at> springs_of(const linear_structure& s, std::span<const char> closed) {
  std::vector<spring_at> list;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const int dof = s.dof_of_pair(i);
    if (closed[i] != 0 && s.fixed[dof] == 0) list.push_back({s.row_of(dof), s.pairs[i].stiffness});
  }
  return list;
}

std::vector<double> in_rows(const linear_structure& s, std::span<const double> load) {
  std::vector<double> b(load.size());
  for (std::size_t dof = 0; dof < load.size(); ++dof)
    if (s.fixed[dof] == 0) b[s.row_of(dof)] = load[dof];
  return b;
}

void gather_at_pairs(const linear_structure& s, std::span<const double> u, std::span<double> at_pairs) {
  for (std::size_t i = 0; i < at_pairs.size(); ++i) at_pairs[i] = u[s.dof_of_pair(i)];
}

std::vector<double> with_pair_forces(const linear_structure& s, std::span<const double> load,
                                     std::span<const double> pair_forces) {
  std::vector<double> all(load.begin(), load.end());
  for (std::size_t i = 0; i < pair_forces.size(); ++i) all[s.dof_of_pair(i)] += pair_forces[i];
  return all;
}

std::vector<double> residual(const stiffness_matrix& k, std::span<const spring_at> springs,
                             std::span<const double> b, std::span<const double> x) {
  std::vector<long double> r(b.begin(), b.end());
  k.subtract_product(x, r);
  for (const auto& [row, stiffness] : springs) r[row] -= static_cast<long double>(stiffness) * x[row];
  return {r.begin(), r.end()};
}

void solve_refined(const linear_structure& s, const stiffness_matrix& k, std::span<const spring_at> springs,
                   const in_place_solver& solve, std::span<const double> load, std::span<double> u) {
  constexpr int most_passes = 6;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const std::vector<double> b = in_rows(s, load);
  std::vector<double> x = b;
  solve(x);
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<double> correction = residual(k, springs, b, x);
    solve(correction);
    double largest = 0.0;
    double size = 0.0;
    for (std::size_t row = 0; row < x.size(); ++row) {
      const double scale = std::sqrt(k.diagonal(row));  // makes entries of different units comparable
      largest = std::max(largest, scale * std::abs(correction[row]));
      size = std::max(size, scale * std::abs(x[row]));
    }
    if (!(largest < before / 2)) break;
    for (std::size_t row = 0; row < x.size(); ++row) x[row] += correction[row];
    if (largest <= eps / 2 * size) break;
    before = largest;
  }
  for (std::size_t dof = 0; dof < u.size(); ++dof) u[dof] = x[s.row_of(dof)];
}

}  // namespace contct::solve
