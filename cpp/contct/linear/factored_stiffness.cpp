#include "contct/linear/factored_stiffness.hpp"

#include <cmath>
#include <limits>

namespace contct {

std::vector<double> residual(const stiffness_matrix& k, std::span<const spring_at> springs,
                             std::span<const double> b, std::span<const double> x) {
  std::vector<long double> r(b.begin(), b.end());
  k.subtract_product(x, r);
  for (const spring_at& s : springs) {
    const long double other = s.other < 0 ? 0.0L : x[s.other];
    const long double force = static_cast<long double>(s.stiffness) * (x[s.row] - other);
    r[s.row] -= force;
    if (s.other >= 0) r[s.other] += force;
  }
  return {r.begin(), r.end()};
}

void solve_refined(const linear_system& s, std::span<const spring_at> springs, const in_place_solver& solve,
                   std::span<const double> load, std::span<double> u) {
  constexpr int most_passes = 6;
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const std::vector<double> b = in_rows(s, load);
  std::vector<double> x = b;
  solve(x);
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most_passes; ++pass) {
    std::vector<double> correction = residual(s.stiffness, springs, b, x);
    solve(correction);
    double largest = 0.0;
    double size = 0.0;
    for (std::size_t row = 0; row < x.size(); ++row) {
      const double scale =
          std::sqrt(s.stiffness.diagonal(row));  // makes entries of different units comparable
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

std::vector<std::vector<double>> factored_stiffness::columns_at_pairs(std::span<const int> pairs) {
  const std::size_t n = structure_.dofs();
  std::vector<double> x(n * pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const spring_at at = structure_.spring_of(pairs[i]);
    if (structure_.fixed[structure_.pairs[pairs[i]].dof] == 0) x[i * n + at.row] = 1.0;
    if (at.other >= 0) x[i * n + at.other] -= 1.0;
  }
  factor_.solve(x);
  std::vector<std::vector<double>> columns(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t pair = 0; pair < structure_.pairs.size(); ++pair)
      columns[i].push_back(structure_.spring_of(pair).stretch(std::span(x).subspan(i * n, n)));
  return columns;
}

}  // namespace contct
