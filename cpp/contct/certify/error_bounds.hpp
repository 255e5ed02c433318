// Bounds on the distance of a state from the equilibrium, proved from the state alone
// (reference/certificate-proof.md).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contct/certify/certain_contacts.hpp"
#include "contct/path/path.hpp"

namespace contct {

/// The kinds of numbers that a state has.
enum class quantity { w, slope, force, reaction, moment, shear, gap };
inline constexpr std::array<const char*, 7> quantity_names = {"w",      "slope", "force", "reaction",
                                                              "moment", "shear", "gap"};

/// A number for each kind; empty if the structure has no such quantity.
struct by_quantity {
  std::array<std::optional<double>, quantity_names.size()> all;
  [[nodiscard]] std::optional<double>& operator[](quantity q) { return all[static_cast<std::size_t>(q)]; }
  [[nodiscard]] const std::optional<double>& operator[](quantity q) const {
    return all[static_cast<std::size_t>(q)];
  }
  /// The larger of the two.
  void take(quantity q, double value);
};

/// The reported numbers of a state.
struct reported_state {
  int step;                              ///< from 1
  std::span<const double> displacement;  ///< [dofs]
  std::span<const int> isep;             ///< [pairs] in_contact or separated
  end_numbers numbers;
};

/// The numbers that a run gives for the end of a step.
[[nodiscard]] reported_state reported_state_at(const problem& p, const step_state& s);

/// The data that a check of a step's bounds needs besides the problem file (reference/proof-format.md).
struct step_proof {
  // As handed out:
  std::vector<double> displacement;  ///< [dofs]
  std::vector<int> isep;             ///< in_contact or separated [pairs]
  end_numbers numbers;

  long_vector state;                            ///< u [dofs]
  std::vector<int> closed;                      ///< A: pairs from 0
  long_vector z;                                ///< about K_A^-1 r [dofs]; empty without loads
  std::optional<stiffness_proof> of_stiffness;  ///< empty without loads and supports
};

struct error_bounds : contact_set {
  /// The largest error that any number of a kind can have. Infinite: none is proved.
  by_quantity error;
  by_quantity size;      ///< the largest number of a kind; of forces, loads and reactions count too
  by_quantity settling;  ///< without loads: the forces that move one settling dof alone
  /// No load acts, and no pair is beyond its face at zero displacement, which is therefore the equilibrium.
  bool unloaded = false;
  /// A pair, from 0, whose status is certainly wrong; empty if there is none.
  std::optional<std::size_t> wrong_status;
  std::shared_ptr<const step_proof> proof;  ///< if it is kept
};
/// Decisions by rational numbers where doubles are too short; empty for a problem that is too large.
class exact_means {
 public:
  virtual ~exact_means() = default;
  /// The end of a step of the exact path; steps are counted from 1.
  [[nodiscard]] virtual found_end end_of(int step) = 0;
  /// K u less the loads at the end of a step and what pairs beyond their faces press with, at every dof, each
  /// number rounded once. At fixed dofs u is the prescribed displacement.
  [[nodiscard]] virtual std::optional<long_vector> residual_of(int step,
                                                               std::span<const double_double> u) = 0;
  /// Is K certainly positive semidefinite on the dofs that are not fixed?
  [[nodiscard]] virtual bool is_semidefinite() = 0;
};

/// Computes bounds on the errors of states of a problem.
class error_prover {
 public:
  /// All must outlive this object. `exactly`, which may be null, gives residuals if only 32 digits factor
  /// K_A, because residuals in 32 digits are too coarse then. It also decides whether a matrix that only
  /// pairs hold is semidefinite.
  error_prover(const problem& p, const linear_structure& s, exact_means* exactly = nullptr);

  [[nodiscard]] error_bounds bound(const reported_state& told);
  /// The same with exact residuals, which takes longer; nothing if these are not available.
  [[nodiscard]] std::optional<error_bounds> bound_closely(const reported_state& told);

  /// Corrections with this residual, as long as each makes it smaller. Nothing if the structure is not
  /// certainly held. The remainders below double precision are kept for `bound`.
  [[nodiscard]] std::optional<end_numbers> refine(int step, std::span<double> displacement,
                                                  std::span<int> isep);
  [[nodiscard]] double extent() const { return system_.extent; }

  /// Keep what proves the bounds.
  void keep_proof();

 private:
  /// A state and its proof.
  struct known_state {
    int step = 0;  // from 1
    bool refined = false;
    long_vector u;
    long_residual left;
    std::vector<element_value> values;    // the results in its elements
    std::optional<contact_set> contacts;  // of a refined state that is certainly held
  };
  /// The force of a support, how far off it may be, and by how much of rho.
  struct support_force {
    double_double force;
    double slack = 0.0, per_rho = 0.0;
  };

  /// At the end of a step, from 1; kept until another step is asked for.
  [[nodiscard]] const long_loads& loads_of(int step);
  [[nodiscard]] bool has_exact_residual(const long_loads& l);
  [[nodiscard]] long_residual residual_of(std::span<const double_double> u, const long_loads& l);
  [[nodiscard]] bool is_refined(int step, std::span<const double> displacement) const;
  /// `displacement`, with settlements as they are prescribed; the state refined last has its low parts, too.
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
  [[nodiscard]] std::vector<support_force> support_forces() const;
  void keep(const reported_state& told, error_bounds& b) const;

  const problem& problem_;
  long_system system_;  // its faces as at the end of the step of `loads_`
  certain_contacts contacts_;
  exact_means* exactly_;
  std::optional<bool> semidefinite_;
  bool closely_ = false;  // residuals are exact though doubles factor K_A
  long_loads loads_;
  known_state state_;  // refined or bounded last
  bool keeps_proof_ = false;
};

/// Widen the errors, which bound the numbers at nodes and ends of elements, until they bound the extremes of
/// w, moment and shear too that ranges_of finds along a beam, where w in the middle of elements has a size
/// too. Those of plates and matrices are at nodes and corners: nothing changes.
void widen_by_extremes(const problem& p, const reported_state& state, error_bounds& b);

}  // namespace contct
