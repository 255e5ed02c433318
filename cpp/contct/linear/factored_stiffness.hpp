// The factor of the stiffness with springs of pairs; residuals, refined solutions, and vectors converted
// between dofs, rows and pairs.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contct/linear/cholesky.hpp"
#include "contct/linear/engine.hpp"

namespace contct {

/// The springs of the pairs that are `closed` [pairs], except pairs at fixed dofs.
[[nodiscard]] inline std::vector<spring_at> springs_of(const linear_system& s, std::span<const char> closed) {
  std::vector<spring_at> list;
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (closed[i] != 0 && s.fixed[s.pairs[i].dof] == 0) list.push_back(s.spring_of(i));
  return list;
}

/// The right-hand side [rows] of K u = f for a load [dofs]: see linear_system::in_row.
[[nodiscard]] inline std::vector<double> in_rows(const linear_system& s, std::span<const double> load) {
  std::vector<double> b(load.size());
  for (std::size_t dof = 0; dof < load.size(); ++dof) b[s.row_of(dof)] = s.in_row(dof, load[dof]);
  return b;
}

/// Copies a solution [rows] to `u` [dofs].
inline void to_dofs(const linear_system& s, std::span<const double> x, std::span<double> u) {
  for (std::size_t dof = 0; dof < u.size(); ++dof) u[dof] = x[s.row_of(dof)];
}

/// Writes the relative displacements of the pairs under the displacements `u` [dofs] to `at_pairs` [pairs].
inline void gather_at_pairs(const linear_system& s, std::span<const double> u, std::span<double> at_pairs) {
  for (std::size_t i = 0; i < at_pairs.size(); ++i) at_pairs[i] = s.pairs[i].seen_in(u);
}

/// `load` [dofs] plus the forces of the pairs, except forces at fixed dofs, which supports carry.
[[nodiscard]] inline std::vector<double> with_pair_forces(const linear_system& s,
                                                          std::span<const double> load,
                                                          std::span<const double> pair_forces) {
  std::vector<double> all(load.begin(), load.end());
  for (std::size_t i = 0; i < pair_forces.size(); ++i)
    if (s.fixed[s.pairs[i].dof] == 0) s.pairs[i].add_to(all, pair_forces[i]);
  return all;
}

/// b - (K + springs) x [rows], computed in long double.
[[nodiscard]] std::vector<double> residual(const stiffness_matrix& k, std::span<const spring_at> springs,
                                           std::span<const double> b, std::span<const double> x);

/// Solves (K + springs) u = load [dofs], and refines u by its residual as long as corrections halve. `solve`:
/// solves with a factor of K + springs, by rows.
void solve_refined(const linear_system& s, std::span<const spring_at> springs, const in_place_solver& solve,
                   std::span<const double> load, std::span<double> u);

/// True if CHOLMOD, which orders the rows, factors the band of `s` faster than LAPACK.
[[nodiscard]] inline bool is_faster_by_cholmod(const linear_system& s) {
  constexpr int wide = 128;
  return sparse_factor::available() && !s.has_pairs_of_two() && s.stiffness.subdiagonals.value_or(0) >= wide;
}

/// The fastest factor for K of `s`.
[[nodiscard]] inline std::unique_ptr<matrix_factor> quickest_factor(const linear_system& s) {
  return is_faster_by_cholmod(s) ? sparse_factor::make(s.stiffness) : usual_factor(s.stiffness);
}

/// K with the springs of some pairs, and its Cholesky factor. Dofs and pairs are numbered from 0. Memory: a
/// factor.
class factored_stiffness {
 public:
  /// `s` must outlive this object.
  explicit factored_stiffness(const linear_system& s) : factored_stiffness(s, usual_factor(s.stiffness)) {}
  factored_stiffness(const linear_system& s, std::unique_ptr<matrix_factor> by)
      : structure_(s), factor_(s.stiffness, std::move(by)) {}

  /// Factors K with the springs of the pairs that are `closed` [pairs] (dpbtrf). Throws no_factor.
  void factor(std::span<const char> closed) {
    springs_ = springs_of(structure_, closed);
    if (factor_.factor(springs_)) return;
    throw no_factor(
        "the structure is held, but its stiffness matrix is too ill-conditioned to be factored in double "
        "precision");
  }

  /// Solves K u = f with the factor (dpbtrs). `x` [dofs] is f, then u; for fixed dofs see in_rows.
  void solve(std::span<double> x) {
    std::vector<double> b = in_rows(structure_, x);
    factor_.solve(b);
    to_dofs(structure_, b, x);
  }

  /// [requested pairs][pairs] the columns of K^-1 for the requested pairs, at all pairs. Solves K x = e for
  /// all requested pairs together, where e is 1 at the dof of the pair and -1 at the dof of its face. Zeros
  /// if the dof of the pair is fixed.
  [[nodiscard]] std::vector<std::vector<double>> columns_at_pairs(std::span<const int> pairs);

  /// Solves K u = load, and refines u by its residual in long double, which gains up to 3 digits.
  void solve_refined(std::span<const double> load, std::span<double> u) {
    contct::solve_refined(
        structure_, springs_, [this](std::span<double> b) { factor_.solve(b); }, load, u);
  }

  /// Reciprocal condition of K with the springs of the pairs that are `closed`, its diagonal scaled to 1.
  /// Overwrites the factor.
  [[nodiscard]] double reciprocal_condition(std::span<const char> closed) {
    return factor_.reciprocal_condition(springs_of(structure_, closed));
  }

  /// The number of multiplications and additions in a factorisation.
  [[nodiscard]] double flops() const { return factor_.flops(); }

 private:
  const linear_system& structure_;
  std::vector<spring_at> springs_;  // springs in the factor
  stiffness_factor factor_;
};

}  // namespace contct
