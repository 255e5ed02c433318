// The equations of a structure: K u = f, and the springs of the contact pairs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "contct/linear/stiffness_matrix.hpp"

namespace contct {

/// A candidate contact pair.
template <class Number>
struct pair_in {
  int dof = 0;
  int surface = 0;  ///< n: face_above (+1) or face_below (-1)
  Number face{}, stiffness{};
  bool closed = false;  ///< in contact at the start
  int other = -1;       ///< the dof with the face; -1: the face is fixed

  /// The relative displacement of the pair, from the displacements `u` [dofs].
  template <class Vector>
  [[nodiscard]] Number seen_in(const Vector& u) const {
    return other < 0 ? u[dof] : Number(u[dof] - u[other]);
  }
  template <class Vector, class Value>
  void add_to(Vector& f, const Value& force) const {
    f[dof] += force;
    if (other >= 0) f[other] -= force;
  }
};

/// K u = f with springs. Dof d of node i is dof i * dofs_per_node + d, from 0.
struct linear_system {
  int dofs_per_node = 0;
  stiffness_matrix stiffness;  ///< includes elastic supports; rows of fixed dofs are decoupled: see in_row
  std::vector<char> fixed;     ///< [dofs] 1 if a support fixes the dof
  std::vector<char> settles;   ///< [dofs] 1 if steps may prescribe the dof's displacement; empty: all 0
  std::vector<matrix_entry> to_settling;  ///< K's entries in rows of free dofs and columns of settling dofs
  std::vector<pair_in<double>> pairs;     ///< in the order of pair numbers

  std::vector<int> rows;  ///< [dofs] the row of each dof in `stiffness`; empty: row and dof are equal

  [[nodiscard]] int dofs() const { return stiffness.order(); }
  /// The row of `dof` in the stiffness matrix, where plates are numbered along their shorter side.
  [[nodiscard]] int row_of(std::size_t dof) const { return rows.empty() ? static_cast<int>(dof) : rows[dof]; }
  /// The right-hand side of K u = f in the row of `dof`. Free dof: its load. Settling dof: the pivot times
  /// the displacement that `load` prescribes. Other fixed dof: 0. The pivot of a settling dof is a power of
  /// four near its former stiffness: the rows keep similar sizes, and u is exact.
  [[nodiscard]] double in_row(std::size_t dof, double load) const {
    if (fixed[dof] == 0) return load;
    return !settles.empty() && settles[dof] != 0 ? stiffness.diagonal(row_of(dof)) * load : 0.0;
  }
  /// The spring of pair `i`, from 0, by rows.
  [[nodiscard]] spring_at spring_of(std::size_t i) const {
    const pair_in<double>& p = pairs[i];
    return {row_of(p.dof), p.stiffness, p.other < 0 ? -1 : row_of(p.other)};
  }
  /// True if a pair acts between two dofs.
  [[nodiscard]] bool has_pairs_of_two() const {
    return std::any_of(pairs.begin(), pairs.end(), [](const pair_in<double>& p) { return p.other >= 0; });
  }
};

}  // namespace contct
