// The reference solution: the equilibrium as minimiser of a convex energy, without kernel or path.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contct/model/structure.hpp"

namespace contct {

struct reference_answer {
  enum class outcome {
    found,           ///< the minimiser of the energy
    no_equilibrium,  ///< certainly: a rigid-body motion that nothing stops does work under the load
    none_seen,       ///< no_equilibrium as far as doubles show, not proved
    not_found,       ///< too ill-conditioned, or too many iterations
  };
  outcome how = outcome::not_found;
  bool unique = false;               ///< supports and pairs with a contact force hold the structure
  std::vector<double> displacement;  ///< [dofs]
  std::vector<char> pressed;         ///< 1 if n (w - c) > 0 [pairs]
};

/// Minimises the energy of a structure on one-sided springs,
///
///     E(u) = u'K u / 2 - f'u + sum over pairs of k max(0, n (w - c))^2 / 2,
///
/// which is convex and has a continuous slope: the equilibrium does not depend on the path.
///
/// A primal-dual active set: the set of pressed pairs makes E a quadratic, whose minimiser is the next point.
/// The pairs pressed at that point are the next set. With full steps the sets can cycle, so each step ends at
/// the point along the step where E is least. E is piecewise quadratic along a step, so this point is exact.
///
/// Why the search ends: every step but the last is a Newton step with the positive definite matrix of one of
/// finitely many sets. So E falls, and the points converge to the minimiser u*. Near u* only sets occur whose
/// quadratic has u* as its own minimiser, because a pair that is pressed nearby but not at u* is exactly at
/// its face at u*, and its spring has neither force nor energy. From such a point one full step leads to u*.
/// The search ends when the set of pressed pairs is the same before and after a step.
///
/// If the pressed pairs do not hold the structure, the step is the rigid-body motion on which the load does
/// work. If the load does work on no rigid-body motion, springs without force hold the structure.
///
/// Every solve is refined with residuals in long double, which gives 3 to 4 more digits than a band solver.
class reference_solver {
 public:
  /// `s` must outlive this object.
  explicit reference_solver(const linear_structure& s);
  ~reference_solver();

  /// Finds the equilibrium under `load` [dofs], starting from the last answer and, if that fails, from the
  /// undeformed structure. `work` of this load, if known, decides which rigid-body motion the load drives.
  [[nodiscard]] reference_answer solve(std::span<const double> load, const rigid_work& work = {});

  /// The next solution starts from the undeformed structure.
  void start_undeformed();

  /// The reciprocal condition number of K with the springs of the last answer, its diagonal scaled to 1. 0 if
  /// the last factorisation failed.
  [[nodiscard]] double reciprocal_condition();

  [[nodiscard]] int factorisations() const;

 private:
  class search;
  std::unique_ptr<search> search_;
};

}  // namespace contct
