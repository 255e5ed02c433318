#include "contct/solve/factored_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contct/matrix/block_solve.hpp"
#include "contct/matrix/without_zeros.hpp"

namespace contct::solve {

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
  to_dofs(s, x, u);
}

factored_stiffness::factored_stiffness(const linear_structure& s, factored_by how)
    : structure_(s),
      entries_(how == factored_by::storage ? std::nullopt : entries_of_band(s)),
      factor_(entries_ ? *entries_ : s.stiffness) {
  for (std::size_t i = 0; i < s.pairs.size(); ++i) rows_of_pairs_.push_back(s.row_of(s.dof_of_pair(i)));
}

const stiffness_matrix& factored_stiffness::for_products() {
  if (entries_) return *entries_;
  if (!std::exchange(looked_for_zeros_, true)) sparse_ = matrix::without_zeros(structure_.stiffness);
  return sparse_ ? *sparse_ : structure_.stiffness;
}

void factored_stiffness::solve_units_at_pairs(std::span<const int> dofs, std::vector<double>& x) {
  std::vector<int> rows;
  for (const int dof : dofs) rows.push_back(structure_.fixed[dof] != 0 ? -1 : structure_.row_of(dof));
  factor_.solve_units_at(rows, rows_of_pairs_, x);
}

void factored_stiffness::solve_unit(int dof, std::span<double> x) {
  if (structure_.fixed[dof] != 0) return;
  x[dof] = 1.0;
  if (entries_ || !structure_.stiffness.is_band()) return solve(x);
  std::vector<double> b = in_rows(structure_, x);
  solve_from(factor_.band(), structure_.row_of(dof), b);
  to_dofs(structure_, b, x);
}

}  // namespace contct::solve
