// The factor of the stiffness with springs of pairs; residuals, refined solutions, and vectors converted
// between dofs, rows and pairs.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "contct/matrix/cholesky.hpp"
#include "contct/solve/engine.hpp"

namespace contct {

/// The springs, by rows, of the pairs that are `closed` [pairs], except pairs at fixed dofs.
[[nodiscard]] inline std::vector<spring_at> springs_of(const linear_structure& s,
                                                       std::span<const char> closed) {
  std::vector<spring_at> list;
  for (std::size_t i = 0; i < closed.size(); ++i) {
    const int dof = s.dof_of_pair(i);
    const int other = s.other_of_pair(i);
    if (closed[i] != 0 && s.fixed[dof] == 0)
      list.push_back({s.row_of(dof), s.pairs[i].stiffness, other < 0 ? -1 : s.row_of(other)});
  }
  return list;
}

/// The right-hand side [rows] of K u = f for a load [dofs]: see linear_structure::in_row.
[[nodiscard]] inline std::vector<double> in_rows(const linear_structure& s, std::span<const double> load) {
  std::vector<double> b(load.size());
  for (std::size_t dof = 0; dof < load.size(); ++dof) b[s.row_of(dof)] = s.in_row(dof, load[dof]);
  return b;
}

/// Copies a solution [rows] to `u` [dofs].
inline void to_dofs(const linear_structure& s, std::span<const double> x, std::span<double> u) {
  for (std::size_t dof = 0; dof < u.size(); ++dof) u[dof] = x[s.row_of(dof)];
}

/// Writes the relative displacements of the pairs under the displacements `u` [dofs] to `at_pairs` [pairs].
inline void gather_at_pairs(const linear_structure& s, std::span<const double> u,
                            std::span<double> at_pairs) {
  for (std::size_t i = 0; i < at_pairs.size(); ++i) at_pairs[i] = s.seen_by_pair(i, u);
}

/// Adds the force of pair `i` to `load` [dofs] at the dof of the pair, and the opposite force at the dof of
/// its face.
inline void add_at_pair(const linear_structure& s, std::size_t i, double force, std::span<double> load) {
  load[s.dof_of_pair(i)] += force;
  if (const int other = s.other_of_pair(i); other >= 0) load[other] -= force;
}

/// `load` [dofs] plus the forces of the pairs, except forces at fixed dofs, which supports carry.
[[nodiscard]] inline std::vector<double> with_pair_forces(const linear_structure& s,
                                                          std::span<const double> load,
                                                          std::span<const double> pair_forces) {
  std::vector<double> all(load.begin(), load.end());
  for (std::size_t i = 0; i < pair_forces.size(); ++i)
    if (const int dof = s.dof_of_pair(i); s.fixed[dof] == 0) add_at_pair(s, i, pair_forces[i], all);
  return all;
}

/// b - (K + springs) x [rows], computed in long double.
[[nodiscard]] std::vector<double> residual(const stiffness_matrix& k, std::span<const spring_at> springs,
                                           std::span<const double> b, std::span<const double> x);

/// Solves (K + springs) u = load [dofs], and refines u by its residual as long as corrections halve. `k`: K
/// of `s`, in any storage. `solve`: solves with a factor of K + springs, by rows.
void solve_refined(const linear_structure& s, const stiffness_matrix& k, std::span<const spring_at> springs,
                   const in_place_solver& solve, std::span<const double> load, std::span<double> u);

[[noreturn]] inline void refuse_ill_conditioned() {
  throw no_factor(
      "the structure is held, but its stiffness matrix is too ill-conditioned to be factored "
      "in double precision");
}

/// Who factors K. `storage`: LAPACK factors a band, CHOLMOD factors columns. `cholmod`: CHOLMOD factors bands
/// too, and orders the rows. `ranks`: the MPI job that this process has joined.
enum class factored_by { storage, cholmod, ranks };

/// True if a pair acts between two dofs. If K is a band, its copy by columns has no entries for the springs
/// of these pairs.
[[nodiscard]] inline bool has_pairs_of_two(const linear_structure& s) {
  return std::any_of(s.pairs.begin(), s.pairs.end(), [](const contact_pair& p) { return p.other >= 0; });
}

/// The fastest library for K of `s`: CHOLMOD for a wide band, if it is built in.
[[nodiscard]] inline factored_by quickest_factor(const linear_structure& s) {
  constexpr int wide = 128;  // subdiagonals from which CHOLMOD is faster than LAPACK
  return sparse_factor::available() && !has_pairs_of_two(s) && s.stiffness.is_band() &&
                 s.stiffness.band().subdiagonals() >= wide
             ? factored_by::cholmod
             : factored_by::storage;
}

/// K by columns, without zeros, if it is a band that LAPACK does not factor or that is mostly zeros;
/// otherwise nothing.
[[nodiscard]] std::optional<stiffness_matrix> entries_for(const linear_structure& s, factored_by how);

/// K with the springs of some pairs, and its Cholesky factor. Dofs and pairs are numbered from 0. Memory: a
/// factor.
class factored_stiffness {
 public:
  /// Throws std::logic_error if this program, or this process, cannot factor by `how`.
  explicit factored_stiffness(const linear_structure& s, factored_by how = factored_by::storage);

  /// Factors K with the springs of the pairs that are `closed` [pairs] (dpbtrf). Throws no_factor.
  void factor(std::span<const char> closed) {
    springs_ = springs_of(structure_, closed);
    if (!factor_.factor(springs_)) refuse_ill_conditioned();
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
        structure_, products_, springs_, [this](std::span<double> b) { factor_.solve(b); }, load, u);
  }

  /// Reciprocal condition of K with the springs of the pairs that are `closed`, its diagonal scaled to 1.
  /// Overwrites the factor.
  [[nodiscard]] double reciprocal_condition(std::span<const char> closed) {
    return factor_.reciprocal_condition(springs_of(structure_, closed));
  }

  /// The number of multiplications and additions in a factorisation.
  [[nodiscard]] double flops() const { return factor_.flops(); }

 private:
  const linear_structure& structure_;
  std::optional<stiffness_matrix> entries_;  // see entries_for
  const stiffness_matrix& products_;         // K in the storage with the fastest products
  std::vector<spring_at> rows_of_pairs_;     // [pairs]
  std::vector<spring_at> springs_;           // springs in the factor
  stiffness_factor factor_;
};

}  // namespace contct
