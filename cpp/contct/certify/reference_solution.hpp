// The reference solution: the equilibrium under a load as the minimiser of a convex energy, without kernel or
// path.
#pragma once

#include <span>
#include <vector>

#include "contct/matrix/stiffness_factor.hpp"
#include "contct/structure/structure.hpp"

namespace contct::certify {

/// What was found for one load.
struct reference_answer {
  enum class outcome {
    found,           ///< the minimiser of the energy
    no_equilibrium,  ///< a rigid motion that nothing stops does work under the load
    not_found,       ///< too ill-conditioned, or out of iterations
  };
  outcome how = outcome::not_found;
  bool unique = false;               ///< supports and pressed pairs hold the structure
  std::vector<double> displacement;  ///< [dofs]
  std::vector<char> pressed;         ///< [pairs] 1 where n (w - c) > 0
  int factorisations = 0;
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
/// Where the pressed pairs do not hold the structure, the step is the rigid motion that the load
/// drives; where it drives none, springs without force hold the structure.
///
/// Every solve is refined with residuals in long double, so the answer is that of the matrix as it
/// is stored to as many digits as long double leaves: 3 to 4 more than a band solver alone.
class reference_solver {
 public:
  /// `s` must outlive this object.
  explicit reference_solver(const linear_structure& s);

  /// The equilibrium under `load` [dofs]. Starts from the last answer, and once more from the undeformed
  /// structure where that leads nowhere.
  [[nodiscard]] reference_answer solve(std::span<const double> load);

 private:
  using numbers = std::vector<long double>;
  using pair_set = std::vector<char>;
  struct holding_spring {
    std::size_t row;
    double stiffness;
    long double rest;
  };

  [[nodiscard]] pair_set pressed_at(const numbers& u, long double tie, const pair_set& tied) const;
  [[nodiscard]] bool holds(const pair_set& set, rigid_rank& rank) const;
  [[nodiscard]] bool holds_firmly() const;
  [[nodiscard]] bool drives(const rigid_row& motion) const;
  [[nodiscard]] bool nothing_stops(const numbers& motion) const;
  [[nodiscard]] bool rigid_direction(const rigid_rank& rank, numbers& p) const;
  void add_holding_springs(rigid_rank& rank);
  [[nodiscard]] bool factor_with(const pair_set& set);
  /// r = load - K u - the springs of `set`.
  void residual(const numbers& u, const pair_set& set, numbers& r) const;
  /// Solve with `set` closed for the point where its springs are in equilibrium. Returns the size
  /// of the last correction, or a negative number when refinement does not converge.
  [[nodiscard]] long double refined_solve(const pair_set& set, numbers& u);
  [[nodiscard]] long double best_step(const numbers& u, const numbers& p) const;
  void take(std::span<const double> load);
  void start_undeformed();
  [[nodiscard]] reference_answer search();
  [[nodiscard]] reference_answer::outcome why_endless(const numbers& p) const;
  void remember_size_of_load();
  [[nodiscard]] reference_answer end(reference_answer::outcome how, bool unique) const;
  [[nodiscard]] std::size_t row_of_pair(std::size_t i) const { return pair_rows_[i]; }

  const linear_structure& structure_;
  std::vector<std::size_t> pair_rows_;   // [pairs]
  numbers load_;                         // [rows]
  rigid_row resultant_{};                // work of the load on each rigid motion
  rigid_row resultant_size_{};           // the same with every part counted as positive
  std::vector<holding_spring> holding_;  // of this iteration only
  long double largest_load_ = 0.0L;      // sum of all forces on deflections, the largest so far
  numbers u_;                            // the last answer [rows]
  pair_set set_;                         // and its pressed pairs
  stiffness_factor factor_;
  std::vector<double> scale_;  // square roots of K's diagonal [rows]
  int factorisations_ = 0;
};

}  // namespace contct::certify
