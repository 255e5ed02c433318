// The stiffness with a set of closed springs, factored anew: what engines have in common.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contct/matrix/stiffness_factor.hpp"
#include "contct/structure/structure.hpp"

namespace contct {

/// K with the springs of some pairs, and its Cholesky factor. Dofs and pairs are numbered from 0.
/// Memory: the factor, besides the structure's own.
class factored_stiffness {
 public:
  /// `dissected`: by CHOLMOD, in its order, also where K is stored as a band.
  explicit factored_stiffness(const linear_structure& s, bool dissected = false);

  /// Factor K with the springs of the pairs that are `closed` [pairs] (dpbtrf). Throws no_factor.
  void factor(std::span<const char> closed);

  /// Solve K x = x in place for every dof by the factor (dpbtrs); fixed dofs stay where they are.
  void solve(std::span<double> x);

  /// Solve K x = e for the unit vector of one dof: x [dofs], which comes zeroed. Half a pass over the factor
  /// less than `solve` where K is a band.
  void solve_unit(int dof, std::span<double> x);

  /// The same for up to `many` dofs in one pass over the factor: x[row * many + i] for the i-th, in the
  /// order of the structure's rows.
  void solve_units(std::span<const int> dofs, std::vector<double>& x);

  /// Solve K u = right-hand side, then correct u with the residual in long double, until that no longer
  /// helps: u has the digits that the stored matrix has, or 3 more than LAPACK alone where its condition
  /// takes more.
  void solve_refined(std::span<const double> right_hand_side, std::span<double> u);

  /// Reciprocal condition of K with these springs, its diagonal scaled to 1. The factor is gone afterwards.
  [[nodiscard]] double reciprocal_condition(std::span<const char> closed);

  /// The factor itself, in the order of the structure's rows.
  [[nodiscard]] const band_matrix& factor_band() const { return factor_.band(); }

  /// Products and sums that a factorisation takes.
  [[nodiscard]] double flops() const { return factor_.flops(); }

 private:
  [[nodiscard]] std::vector<spring_at> springs(std::span<const char> closed) const;
  void residual(std::span<const double> right_hand_side, std::span<const double> u,
                std::span<double> left) const;

  const linear_structure& structure_;
  std::optional<stiffness_matrix> entries_;  // of a band that CHOLMOD factors
  std::vector<char> closed_;                 // the springs in the factor [pairs]
  stiffness_factor factor_;
  std::vector<double> ordered_;  // a right-hand side in the order of the rows, where that is another
};

/// A load [dofs] with the pairs' forces [pairs] added where they act.
[[nodiscard]] std::vector<double> with_pair_forces(const linear_structure& s, std::span<const double> load,
                                                   std::span<const double> pair_forces);

}  // namespace contct
