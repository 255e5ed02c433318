// The stiffness with springs of pairs in contact, factored anew; the residual, solutions corrected by it, and
// vectors by dofs, by rows and by pairs.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "contct/matrix/cholesky.hpp"
#include "contct/solve/engine.hpp"

namespace contct {

/// The springs of the pairs that are `closed` [pairs], by rows; none if the dof is fixed.
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

/// A load by dofs as the right-hand side of K (see linear_structure::in_row), by rows.
[[nodiscard]] inline std::vector<double> in_rows(const linear_structure& s, std::span<const double> load) {
  std::vector<double> b(load.size());
  for (std::size_t dof = 0; dof < load.size(); ++dof) b[s.row_of(dof)] = s.in_row(dof, load[dof]);
  return b;
}

/// A solution by rows in the order of the dofs.
inline void to_dofs(const linear_structure& s, std::span<const double> x, std::span<double> u) {
  for (std::size_t dof = 0; dof < u.size(); ++dof) u[dof] = x[s.row_of(dof)];
}

/// Write the relative displacements of the pairs from displacements [dofs] to `at_pairs` [pairs].
inline void gather_at_pairs(const linear_structure& s, std::span<const double> u,
                            std::span<double> at_pairs) {
  for (std::size_t i = 0; i < at_pairs.size(); ++i) at_pairs[i] = s.seen_by_pair(i, u);
}

/// Add a force of pair `i` where it acts, and the opposite where its face is, to `load` [dofs].
inline void add_at_pair(const linear_structure& s, std::size_t i, double force, std::span<double> load) {
  load[s.dof_of_pair(i)] += force;
  if (const int other = s.other_of_pair(i); other >= 0) load[other] -= force;
}

/// A load [dofs] with the pairs' forces [pairs] added where they act; a support takes those at a fixed dof.
[[nodiscard]] inline std::vector<double> with_pair_forces(const linear_structure& s,
                                                          std::span<const double> load,
                                                          std::span<const double> pair_forces) {
  std::vector<double> all(load.begin(), load.end());
  for (std::size_t i = 0; i < pair_forces.size(); ++i)
    if (const int dof = s.dof_of_pair(i); s.fixed[dof] == 0) add_at_pair(s, i, pair_forces[i], all);
  return all;
}

/// b - (K + springs) x, all by rows. Every product and sum in long double.
[[nodiscard]] std::vector<double> residual(const stiffness_matrix& k, std::span<const spring_at> springs,
                                           std::span<const double> b, std::span<const double> x);

/// Solve (K + springs) u = load, all by dofs, and correct u by solving with its residual until that no longer
/// helps. `k`: K of `s`, however it is stored. `solve`: with a factor of K + springs, by rows.
void solve_refined(const linear_structure& s, const stiffness_matrix& k, std::span<const spring_at> springs,
                   const in_place_solver& solve, std::span<const double> load, std::span<double> u);

/// Throws no_factor: the matrix has none although the structure is held.
[[noreturn]] inline void refuse_ill_conditioned() {
  throw no_factor(
      "the structure is held, but its stiffness matrix is too ill-conditioned to be factored "
      "in double precision");
}

/// The library that factors K: LAPACK if it is stored as a band, otherwise CHOLMOD; CHOLMOD in either case,
/// in its own order; or the ranks of the MPI job that this process has joined.
enum class factored_by { storage, cholmod, ranks };

/// Springs between two rows of a band have places in the band alone.
[[nodiscard]] inline bool has_pairs_of_two(const linear_structure& s) {
  return std::any_of(s.pairs.begin(), s.pairs.end(), [](const contact_pair& p) { return p.other >= 0; });
}

/// The fastest library for K of `s`: CHOLMOD for a wide band, if it is built in.
[[nodiscard]] inline factored_by quickest_factor(const linear_structure& s) {
  constexpr int wide = 128;  // subdiagonals from which CHOLMOD's order is quicker than the band
  return sparse_factor::available() && !has_pairs_of_two(s) && s.stiffness.is_band() &&
                 s.stiffness.band().subdiagonals() >= wide
             ? factored_by::cholmod
             : factored_by::storage;
}

/// K by columns, without its zeros, if it is stored as a band that LAPACK does not factor, or that is mostly
/// zeros; otherwise nothing.
[[nodiscard]] std::optional<stiffness_matrix> entries_for(const linear_structure& s, factored_by how);

/// K with the springs of some pairs, and its Cholesky factor. Dofs and pairs are numbered from 0.
/// Memory: the factor, besides the structure's own.
class factored_stiffness {
 public:
  /// Throws std::logic_error if this program or process lacks that way to factor.
  explicit factored_stiffness(const linear_structure& s, factored_by how = factored_by::storage);

  /// Factor K with the springs of the pairs that are `closed` [pairs] (dpbtrf). Throws no_factor.
  void factor(std::span<const char> closed) {
    springs_ = springs_of(structure_, closed);
    if (!factor_.factor(springs_)) refuse_ill_conditioned();
  }

  /// Solve K x = x in place for every dof by the factor (dpbtrs); at fixed ones as by in_rows.
  void solve(std::span<double> x) {
    std::vector<double> b = in_rows(structure_, x);
    factor_.solve(b);
    to_dofs(structure_, b, x);
  }

  /// Columns of the inverse at the pairs: K x = e for the dofs of some pairs, minus e for the dofs of their
  /// faces, solved together [requested pairs][pairs]. Zeros if the dof is fixed.
  [[nodiscard]] std::vector<std::vector<double>> columns_at_pairs(std::span<const int> pairs);

  /// Solve K u = load, corrected with the residual in long double until that no longer helps: u has the
  /// digits that the stored matrix has, or 3 more than LAPACK alone where its condition takes more.
  void solve_refined(std::span<const double> load, std::span<double> u) {
    contct::solve_refined(
        structure_, products_, springs_, [this](std::span<double> b) { factor_.solve(b); }, load, u);
  }

  /// Reciprocal condition of K with these springs, its diagonal scaled to 1. Overwrites the factor.
  [[nodiscard]] double reciprocal_condition(std::span<const char> closed) {
    return factor_.reciprocal_condition(springs_of(structure_, closed));
  }

  /// Products and sums that a factorisation takes.
  [[nodiscard]] double flops() const { return factor_.flops(); }

 private:
  const linear_structure& structure_;
  std::optional<stiffness_matrix> entries_;  // see entries_for
  const stiffness_matrix& products_;         // K as its products take least
  std::vector<spring_at> rows_of_pairs_;     // [pairs]
  std::vector<spring_at> springs_;           // those in the factor
  stiffness_factor factor_;
};

}  // namespace contct
