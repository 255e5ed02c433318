// The stiffness with a set of closed springs, factored anew: what engines have in common.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contct/matrix/stiffness_factor.hpp"
#include "contct/solve/refined_solve.hpp"
#include "contct/structure/structure.hpp"

namespace contct::solve {

/// Throws no_factor: the matrix has none although the structure is held.
[[noreturn]] void refuse_ill_conditioned();

/// The entries of K without zeros where it is stored as a band; nothing otherwise.
[[nodiscard]] std::optional<stiffness_matrix> entries_of_band(const linear_structure& s);

/// K with the springs of some pairs, and its Cholesky factor. Dofs and pairs are numbered from 0.
/// Memory: the factor, besides the structure's own.
class factored_stiffness {
 public:
  /// `dissected`: by CHOLMOD, in its order, also where K is stored as a band.
  explicit factored_stiffness(const linear_structure& s, bool dissected = false);

  /// Factor K with the springs of the pairs that are `closed` [pairs] (dpbtrf). Throws no_factor.
  void factor(std::span<const char> closed);

  /// Solve K x = x in place for every dof by the factor (dpbtrs); 0 at fixed dofs.
  void solve(std::span<double> x);

  /// Solve K x = e for the unit vector of one dof: x [dofs], which must be 0 before. Where K is a band this
  /// reads less of the factor than `solve`: see solve_from.
  void solve_unit(int dof, std::span<double> x);

  /// The same for up to `block_width` dofs in one pass over the factor: x[row * block_width + i] for the
  /// i-th, in the order of the structure's rows.
  void solve_units(std::span<const int> dofs, std::vector<double>& x);

  /// Solve K u = load, corrected with the residual in long double until that no longer helps: u has the
  /// digits that the stored matrix has, or 3 more than LAPACK alone where its condition takes more.
  void solve_refined(std::span<const double> load, std::span<double> u);

  /// Reciprocal condition of K with these springs, its diagonal scaled to 1. Overwrites the factor.
  [[nodiscard]] double reciprocal_condition(std::span<const char> closed);

  /// The factor itself, in the order of the structure's rows.
  [[nodiscard]] const band_matrix& factor_band() const { return factor_.band(); }

  /// Products and sums that a factorisation takes.
  [[nodiscard]] double flops() const { return factor_.flops(); }

 private:
  template <class Solve>
  void in_order_of_rows(std::span<double> x, Solve solve);

  const linear_structure& structure_;
  std::optional<stiffness_matrix> entries_;  // of a band that CHOLMOD factors
  std::vector<spring_at> springs_;           // those in the factor
  stiffness_factor factor_;
  std::vector<double> ordered_;  // a right-hand side in the order of the rows, where that is another
};

}  // namespace contct::solve
