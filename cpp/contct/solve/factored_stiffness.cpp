#include "contct/solve/factored_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contct/solve/mpi_job.hpp"

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

namespace {

stiffness_factor factor_of(const stiffness_matrix& k, factored_by how) {
  if (how != factored_by::ranks) return stiffness_factor(k);
  mpi_job* const job = joined_job();
  if (job == nullptr) throw std::logic_error("this process has joined no MPI job to factor the stiffness");
  return {k, job->share(k.columns())};
}

}  // namespace

std::optional<stiffness_matrix> entries_for(const linear_structure& s, factored_by how) {
  if (how == factored_by::storage) return without_zeros(s.stiffness);
  if (!s.stiffness.is_band()) return {};
  return columns_of(s.stiffness.band());
}

factored_stiffness::factored_stiffness(const linear_structure& s, factored_by how)
    : structure_(s),
      entries_(entries_for(s, how)),
      products_(entries_ ? *entries_ : s.stiffness),
      factor_(factor_of(how == factored_by::storage ? s.stiffness : products_, how)) {
  for (std::size_t i = 0; i < s.pairs.size(); ++i) {
    const int other = s.other_of_pair(i);
    rows_of_pairs_.push_back({s.row_of(s.dof_of_pair(i)), 1.0, other < 0 ? -1 : s.row_of(other)});
  }
}

std::vector<std::vector<double>> factored_stiffness::columns_at_pairs(std::span<const int> pairs) {
  const std::size_t n = structure_.dofs();
  std::vector<double> x(n * pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const spring_at& at = rows_of_pairs_[pairs[i]];
    if (structure_.fixed[structure_.dof_of_pair(pairs[i])] == 0) x[i * n + at.row] = 1.0;
    if (at.other >= 0) x[i * n + at.other] -= 1.0;
  }
  factor_.solve(x);
  std::vector<std::vector<double>> columns(pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (const spring_at& at : rows_of_pairs_)
      columns[i].push_back(at.stretch(std::span(x).subspan(i * n, n)));
  return columns;
}

}  // namespace contct
