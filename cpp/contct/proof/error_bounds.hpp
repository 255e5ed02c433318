// Bounds on the errors of a state, proved from its printed numbers (reference/certificate-proof.md).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contct/proof/certain_contacts.hpp"
#include "contct/structure/extremes.hpp"

namespace contct {

/// The state with all its numbers: those that are missing are computed from the displacements.
[[nodiscard]] structure_state with_numbers(const problem& p, structure_state s);

/// The data that a check of a step's bounds needs besides the problem file (reference/proof-format.md).
struct step_proof {
  structure_state told;                         ///< the state as reported
  long_vector state;                            ///< the displacements u in 32 digits [dofs]
  std::vector<int> closed;                      ///< A: the pairs certainly in contact, from 0
  long_vector z;                                ///< approximates K_A^-1 r [dofs]; empty without loads
  std::optional<stiffness_proof> of_stiffness;  ///< empty if no load acts and only contact holds
};

/// Answers in rational numbers, for use where doubles are too coarse; undecided, empty or false if the
/// problem is too large.
class exact_means {
 public:
  virtual ~exact_means() = default;
  /// The state at the end of a step, from 1, of the exact path.
  [[nodiscard]] virtual solved_step end_of(int step) = 0;
  /// K u - f + sum of n k max(0, d) at the end of a step [dofs], each number rounded once. f: the load; n, k,
  /// d: surface, stiffness and depth beyond the face of each pair. At fixed dofs, the prescribed
  /// displacements are used for u.
  [[nodiscard]] virtual std::optional<long_vector> residual_of(int step,
                                                               std::span<const double_double> u) = 0;
  /// Is K certainly positive semidefinite on the dofs that are not fixed?
  [[nodiscard]] virtual bool is_semidefinite() = 0;
};

class error_prover {
 public:
  /// All arguments must outlive this object. `exactly` may be null. If K_A can be factored only in 32 digits,
  /// residuals in 32 digits are too coarse, and `exactly` computes them. `exactly` also decides whether a
  /// matrix that only pairs hold is semidefinite. `keeps_proofs`: bounds have their proofs.
  error_prover(const problem& p, const linear_structure& s, exact_means* exactly = nullptr,
               bool keeps_proofs = false);

  [[nodiscard]] error_bounds bound(const structure_state& told);
  /// The bounds from exact residuals, which take longer. There must be an `exactly`.
  [[nodiscard]] error_bounds bound_closely(const structure_state& told);

  /// Corrects displacements and statuses by the residual as long as the residual becomes smaller, and sets
  /// the numbers of the corrected state. Returns false, with no numbers, if the structure is not certainly
  /// held. For the last state, digits below double precision are kept for `bound`.
  bool refine(structure_state& s);

 private:
  /// The state that was refined or bounded last.
  struct known_state {
    int step = 0;  // from 1
    bool refined = false;
    long_vector u;
    long_residual left;
    std::vector<element_value> values;
    std::optional<contact_set> contacts;  // set only for a refined state that is certainly held
  };
  /// The force of a support. Its error is at most slack + per_rho * rho.
  struct support_force {
    double_double force;
    double slack = 0.0, per_rho = 0.0;
  };

  [[nodiscard]] bool has_exact_residual(const long_loads& l);
  [[nodiscard]] long_residual residual_of(std::span<const double_double> u, const long_loads& l);
  [[nodiscard]] bool is_refined(int step, std::span<const double> displacement) const;
  /// The displacements in 32 digits: those of state_ if `displacement` was refined last, otherwise
  /// `displacement` with the prescribed settlements.
  [[nodiscard]] long_vector long_displacement(int step, std::span<const double> displacement,
                                              const long_loads& l) const;

  [[nodiscard]] double solve(const long_vector& force, std::vector<double>& correction);
  [[nodiscard]] bool correct(const long_loads& l);
  void settle_statuses(const long_loads& l, std::span<int> isep) const;
  [[nodiscard]] end_numbers numbers_of(std::span<const int> isep) const;

  [[nodiscard]] bool is_semidefinite();
  [[nodiscard]] bool rests(const structure_state& told, const long_loads& l, error_bounds& b);
  [[nodiscard]] bool find_contacts(const structure_state& told, const long_loads& l, contact_set& b);
  void measure(const structure_state& told, const long_loads& l, error_bounds& b) const;
  void bound_displacements(const structure_state& told, error_bounds& b) const;
  void bound_pairs(const structure_state& told, error_bounds& b) const;
  void bound_forces(const structure_state& told, error_bounds& b) const;
  [[nodiscard]] std::vector<support_force> support_forces(bool convex = true) const;
  void keep(const structure_state& told, error_bounds& b) const;

  const problem& problem_;
  const linear_structure& structure_;
  long_system system_;
  certain_contacts contacts_;
  exact_means* exactly_;
  std::optional<bool> semidefinite_;
  bool closely_ = false;  // residuals are exact even if doubles factor K_A
  known_state state_;
  bool keeps_proofs_;
};

/// A bound on the largest value of a polynomial from t = 0 to 1, at most `close` and rounding above it.
[[nodiscard]] double bound_on_largest(const line_polynomial<double>& p, double close);

/// Widens the bounds on w, slope, moment and shear of a beam, which hold at the ends of elements, to include
/// the extremes that ranges_of finds inside the elements, and every slope of a beam_lines. The sizes then
/// include the inside of elements. Does nothing for plates and matrices, whose extremes are at nodes and
/// corners.
void widen_by_extremes(const problem& p, const structure_state& state, error_bounds& b);

}  // namespace contct
