// The reference solution: the equilibrium under a load as the minimiser of a convex energy, without kernel or
// path.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contct/model/structure.hpp"

namespace contct {

/// The answer for one load.
struct reference_answer {
  enum class outcome {
    found,           ///< the minimiser of the energy
    no_equilibrium,  ///< certainly: a rigid-body motion that nothing stops does work under the load
    none_seen,       ///< the same by doubles, without a proof
    not_found,       ///< too ill-conditioned, or out of iterations
  };
  outcome how = outcome::not_found;
  bool unique = false;               ///< supports and pressed pairs hold the structure
  std::vector<double> displacement;  ///< [dofs]
  std::vector<char> pressed;         ///< [pairs] 1 where n (w - c) > 0
};

/// Minimises the energy of a structure on one-sided springs,
///
///     E(u) = u'K u / 2 - f'u + sum over pairs of k max(0, n (w - c))^2 / 2,
///
/// which is convex and has a continuous slope: the equilibrium does not depend on the path.
///
/// A primal-dual active set: the set of pressed pairs makes E a quadratic, whose minimiser is the
/// next point, and its pressed pairs are the next set. Taken plainly this can cycle. So each step is
/// cut where E is least on the way (a piecewise quadratic in one variable: exact).
///
/// Why it ends. E falls at every step that is not the last, because the step is a Newton direction
/// of E with a positive definite matrix from a finite choice (one for each set): the points converge
/// to the minimiser u*. Near u* only sets occur whose quadratic has u* as its own minimiser, since
/// a pair that is pressed nearby and not at u* stands exactly at its face there, where its spring
/// has neither force nor energy. From such a point one whole step lands on u*. The sets are then
/// the same before and after, and that is the test.
///
/// If the pressed pairs do not hold the structure, the step is the rigid-body motion that the load
/// drives; where it drives none, springs without force hold the structure.
///
/// Every solve is refined with residuals in long double, so the answer is that of the matrix as it
/// is stored to as many digits as long double leaves: 3 to 4 more than a band solver alone.
class reference_solver {
 public:
  /// `s` must outlive this object.
  explicit reference_solver(const linear_structure& s);
  ~reference_solver();

  /// The equilibrium under `load` [dofs]. Starts from the last answer, and again from the undeformed
  /// structure if that fails. `work` of this load, if known, decides which rigid-body motion the load drives.
  [[nodiscard]] reference_answer solve(std::span<const double> load, const rigid_work& work = {});

  /// The next answer is looked for from the undeformed structure.
  void start_undeformed();

  /// Reciprocal condition, its diagonal scaled to 1, of the matrix that the last answer was solved with: K
  /// and the springs that hold it. 0 if it has no factor.
  [[nodiscard]] double reciprocal_condition();

  /// The number of factorisations so far.
  [[nodiscard]] int factorisations() const;

 private:
  class search;
  std::unique_ptr<search> search_;
};

}  // namespace contct
