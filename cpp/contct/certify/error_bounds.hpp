// Bounds on the errors of a state, proved from its printed numbers (reference/certificate-proof.md).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contct/certify/certain_contacts.hpp"
#include "contct/path/path.hpp"

namespace contct {

enum class quantity { w, slope, force, reaction, moment, shear, gap };
inline constexpr std::array<const char*, 7> quantity_names = {"w",      "slope", "force", "reaction",
                                                              "moment", "shear", "gap"};

/// One number for each kind; empty if the structure has no numbers of that kind.
struct by_quantity {
  std::array<std::optional<double>, quantity_names.size()> all;
  [[nodiscard]] std::optional<double>& operator[](quantity q) { return all[static_cast<std::size_t>(q)]; }
  [[nodiscard]] const std::optional<double>& operator[](quantity q) const {
    return all[static_cast<std::size_t>(q)];
  }
  /// Keeps the larger of `value` and the number stored for `q`; NaN counts as infinite.
  void take(quantity q, double value);
};

struct reported_state {
  int step;                              ///< from 1
  std::span<const double> displacement;  ///< [dofs]
  std::span<const int> isep;             ///< [pairs] in_contact or separated
  end_numbers numbers;
};

/// The numbers that a run reports for the end of a step.
[[nodiscard]] reported_state reported_state_at(const problem& p, const step_state& s);

/// The data that a check of a step's bounds needs besides the problem file (reference/proof-format.md).
struct step_proof {
  // The state as reported:
  std::vector<double> displacement;  ///< [dofs]
  std::vector<int> isep;             ///< in_contact or separated [pairs]
  end_numbers numbers;

  long_vector state;                            ///< the displacements u in 32 digits [dofs]
  std::vector<int> closed;                      ///< A: the pairs certainly in contact, from 0
  long_vector z;                                ///< approximates K_A^-1 r [dofs]; empty without loads
  std::optional<stiffness_proof> of_stiffness;  ///< empty if no load acts and only contact holds
};

struct error_bounds : contact_set {
  /// Bounds on the largest error of each kind of number; empty for a kind without numbers or without a bound.
  by_quantity error;
  std::optional<double> pressure;  ///< the same for bearing pressures; empty without beds
  by_quantity size;      ///< the largest number of each kind; nodal loads count as forces and moments
  by_quantity settling;  ///< if no load acts: the largest K_ii times settlement of dof i
  /// No node is loaded or settles, and at zero displacement no pair is beyond its face: u = 0 is an
  /// equilibrium.
  bool at_rest = false;
  bool unloaded = false;  ///< at rest, and no load acts inside elements either
  /// The first pair, from 0, whose status is certainly wrong.
  std::optional<std::size_t> wrong_status;
  std::shared_ptr<const step_proof> proof;  ///< null unless proofs are kept
};
/// Answers in rational numbers, for use where doubles are too coarse; empty or false if the problem is too
/// large.
class exact_means {
 public:
  virtual ~exact_means() = default;
  /// The state at the end of a step, from 1, of the exact path.
  [[nodiscard]] virtual found_end end_of(int step) = 0;
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
  /// matrix that only pairs hold is semidefinite.
  error_prover(const problem& p, const linear_structure& s, exact_means* exactly = nullptr);

  [[nodiscard]] error_bounds bound(const reported_state& told);
  /// The bounds from exact residuals, which take longer; empty if there is no `exactly`.
  [[nodiscard]] std::optional<error_bounds> bound_closely(const reported_state& told);

  /// Corrects displacements and statuses by the residual as long as the residual becomes smaller, and returns
  /// the numbers of the corrected state. Empty if the structure is not certainly held. For the last state,
  /// digits below double precision are kept for `bound`.
  [[nodiscard]] std::optional<end_numbers> refine(int step, std::span<double> displacement,
                                                  std::span<int> isep);
  [[nodiscard]] double extent() const { return system_.extent; }

  /// Keeps the proofs of later bounds.
  void keep_proof();

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

  /// The loads at the end of a step, from 1; stored until another step is asked for.
  [[nodiscard]] const long_loads& loads_of(int step);
  [[nodiscard]] bool has_exact_residual(const long_loads& l);
  [[nodiscard]] long_residual residual_of(std::span<const double_double> u, const long_loads& l);
  [[nodiscard]] bool is_refined(int step, std::span<const double> displacement) const;
  /// The displacements in 32 digits: those of state_ if `displacement` was refined last, otherwise
  /// `displacement` with the prescribed settlements.
  [[nodiscard]] long_vector long_displacement(int step, std::span<const double> displacement,
                                              const long_loads& l) const;

  [[nodiscard]] long_vector residual_of_set(const long_residual& r, std::span<const double_double> u,
                                            const std::vector<int>& closed) const;
  [[nodiscard]] double correction_for(const long_vector& force, std::vector<double>& correction);
  [[nodiscard]] bool correct(const long_loads& l);
  void settle_statuses(const long_loads& l, std::span<int> isep) const;
  void settle_certain_statuses(double rho, std::span<int> isep) const;
  [[nodiscard]] end_numbers numbers_of(std::span<const int> isep) const;

  [[nodiscard]] bool is_semidefinite();
  void measure(const long_loads& l, error_bounds& b) const;
  [[nodiscard]] bool rests(const reported_state& told, error_bounds& b);
  [[nodiscard]] bool find_contacts(const reported_state& told, const long_loads& l, contact_set& b);
  void bound_displacements(const reported_state& told, error_bounds& b) const;
  void bound_pairs(const reported_state& told, error_bounds& b) const;
  void bound_forces(const reported_state& told, error_bounds& b) const;
  [[nodiscard]] std::vector<support_force> support_forces(bool convex = true) const;
  void keep(const reported_state& told, error_bounds& b) const;

  const problem& problem_;
  const linear_structure& structure_;
  long_system system_;  // the faces are at their places at the end of the step of `loads_`
  certain_contacts contacts_;
  exact_means* exactly_;
  std::optional<bool> semidefinite_;
  bool closely_ = false;  // residuals are exact even if doubles factor K_A
  long_loads loads_;
  known_state state_;
  bool keeps_proof_ = false;
};

/// Widens the bounds on w, slope, moment and shear of a beam, which hold at the ends of elements, to include
/// the extremes that ranges_of finds inside the elements, and every slope of a beam_lines. The sizes then
/// include the inside of elements. Does nothing for plates and matrices, whose extremes are at nodes and
/// corners.
void widen_by_extremes(const problem& p, const reported_state& state, error_bounds& b);

}  // namespace contct
