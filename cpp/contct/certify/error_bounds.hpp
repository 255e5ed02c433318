// How far a state can be from the equilibrium, proved from the state alone (reference/certificate.md).
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "contct/certify/scaled_stiffness.hpp"
#include "contct/certify/step_proof.hpp"
#include "contct/path/observer.hpp"

namespace contct::certify {

/// Sums of doubles are off by less than this share of their magnitudes.
inline constexpr double summation_slack = 0x1p-30;

/// The kinds of numbers that a state has.
enum class quantity { w, slope, force, reaction, moment, shear, gap };
inline constexpr std::array<const char*, 7> quantity_names = {"w",      "slope", "force", "reaction",
                                                              "moment", "shear", "gap"};

/// A number for each kind; none where the structure has no such quantity.
struct by_quantity {
  std::array<std::optional<double>, quantity_names.size()> all;
  [[nodiscard]] std::optional<double>& operator[](quantity q) { return all[static_cast<std::size_t>(q)]; }
  [[nodiscard]] const std::optional<double>& operator[](quantity q) const {
    return all[static_cast<std::size_t>(q)];
  }
  /// The larger of the two.
  void take(quantity q, double value);
};

/// What was handed out for a state.
struct handed_out {
  int step;                              ///< from 1
  std::span<const double> displacement;  ///< [dofs]
  std::span<const int> isep;             ///< [pairs] in_contact or separated
  std::vector<double> pair_forces;       ///< [pairs] positive where pressed
  std::vector<double> reactions;         ///< [supports of the problem]
  std::vector<double> element_values;    ///< as element_results has them
};

/// The numbers that a run gives for the end of a step.
[[nodiscard]] handed_out handed_out_at(const problem& p, const step_state& s);

struct error_bounds {
  /// The largest error that any number of a kind can have. Infinite: none is proved.
  by_quantity error;
  by_quantity size;      ///< the largest number of a kind; of forces, loads and reactions count too
  by_quantity settling;  ///< where nothing else acts: what it takes to move a settling dof alone
  /// Nothing acts, and no pair is beyond its face in the state of no displacement: that is the equilibrium.
  bool unloaded = false;
  bool unique = true;      ///< false: the structure may stand elsewhere as well, under the same forces
  std::string not_proved;  ///< why there is no bound, in words; empty where there is
  double rho = std::numeric_limits<double>::infinity();  ///< in the norm of K_A
  std::vector<int> closed;  ///< A: the pairs that are certainly in contact, from 0
  /// A pair, from 0, that certainly has the other status; none where all statuses hold.
  std::optional<std::size_t> wrong_status;
};

/// Bounds errors of states of a problem.
class error_prover {
 public:
  /// Both must outlive this object. `exactly` gives residuals where only 32 digits factor K_A: those in 32
  /// digits would be too coarse there. `exactly_semidefinite` decides about a matrix that only pairs hold.
  error_prover(const problem& p, const linear_structure& s, exact_residual exactly = nullptr,
               semidefinite_test exactly_semidefinite = nullptr);

  [[nodiscard]] error_bounds bound(const handed_out& state);
  /// The same with exact residuals where there are any, which takes longer; otherwise nothing.
  [[nodiscard]] std::optional<error_bounds> bound_closely(const handed_out& state);

  /// Corrections with this residual, as long as each makes it smaller. Nothing where nothing
  /// certain holds the structure. What is left over from doubles is kept for `bound`.
  [[nodiscard]] std::optional<end_numbers> refine(int step, std::span<double> displacement,
                                                  std::span<int> isep);
  [[nodiscard]] double span() const { return true_.span; }

  /// Keep what proves the bounds.
  void keep_proof() {
    keeps_proof_ = true;
    stiffness_.keep_proof();
  }
  /// Of the last `bound` that proved anything; none before, or unless it is kept.
  [[nodiscard]] std::optional<step_proof> take_proof() { return std::exchange(proof_, std::nullopt); }

 private:
  struct residual {
    long_vector force;          // what is left of the load, 0 at fixed dofs [dofs]
    std::vector<double> slack;  // how far off that may be [dofs]
    long_vector needed;         // K u less the loads, at every dof [dofs]
  };
  /// How deep a pair is beyond its face under `u`.
  [[nodiscard]] double_double depth(std::size_t pair, std::span<const double_double> u) const;
  [[nodiscard]] residual residual_of(std::span<const double_double> u, const true_loads& l) const;
  [[nodiscard]] bool has_exact_residual(const true_loads& l) const;
  [[nodiscard]] bool is_below_range(const true_loads& l) const;
  void put_forces(residual& r) const;
  /// `displacement`, with settlements as they are prescribed; of the state refined last with what doubles
  /// leave over.
  [[nodiscard]] long_vector long_displacement(int step, std::span<const double> displacement,
                                              const true_loads& l) const;
  [[nodiscard]] bool correct(const true_loads& l, long_vector& u);
  [[nodiscard]] long_vector residual_of_set(const residual& r, std::span<const double_double> u,
                                            const std::vector<int>& closed) const;
  [[nodiscard]] double correction_for(const long_vector& force, std::vector<double>& correction) const;
  void settle_statuses(std::span<const double_double> u, const true_loads& l, std::span<int> isep) const;
  void settle_certain_statuses(std::span<const double_double> u, double rho, std::span<int> isep) const;
  [[nodiscard]] end_numbers numbers_of(std::span<const double_double> u, std::span<const int> isep) const;
  [[nodiscard]] bool is_refined(int step, std::span<const double> displacement) const;
  [[nodiscard]] std::vector<int> pressed(std::span<const double_double> u) const;
  [[nodiscard]] std::vector<int> holding(std::span<const double_double> u, std::vector<int> closed) const;
  [[nodiscard]] rigid_rank held_by(const std::vector<int>& closed) const;
  void measure(const true_loads& l, error_bounds& b) const;
  [[nodiscard]] bool is_unloaded(const true_loads& l) const;
  void bound_unloaded(const handed_out& state, error_bounds& b);
  [[nodiscard]] bool proves(const std::vector<int>& closed);
  /// Is K, without any pair, proved to be positive semidefinite? Only then E is convex. May leave another
  /// factor.
  [[nodiscard]] bool is_semidefinite();
  /// Can half a unit in the last digits of a matrix, that does not say how many motions it leaves free, make
  /// K_A indefinite?
  [[nodiscard]] bool last_digits_decide() const;
  [[nodiscard]] std::optional<double> norm_of(const residual& r, double mu);
  void keep(const handed_out& state, const long_vector& u, const error_bounds& b);
  bool find_closed(std::span<const double_double> u, const residual& r, error_bounds& b);
  bool find_balanced(int step, std::span<const double_double> u, const residual& r, error_bounds& b);
  [[nodiscard]] bool stands_free(int step, std::span<const double_double> u, const error_bounds& b) const;
  /// The pairs that may not be in contact leave `closed`; false where there are none.
  bool erase_doubtful(std::span<const double_double> u, double rho, std::vector<int>& closed) const;
  /// At the end of a step, from 1; kept until another step is asked for.
  [[nodiscard]] const true_loads& loads_of(int step);
  /// How far rounding can put a pair's depth off.
  [[nodiscard]] double doubt(std::size_t pair, std::span<const double_double> u) const;
  /// Not in contact, in any state within rho of u.
  [[nodiscard]] bool is_certainly_open(std::size_t pair, std::span<const double_double> u, double rho) const;
  [[nodiscard]] double reach(std::size_t dof) const { return stiffness_.scale(dof) * inverse_root_mu_; }
  void bound_displacements(const handed_out& state, std::span<const double_double> u, error_bounds& b) const;
  [[nodiscard]] double reach_of_pair(std::size_t pair, std::span<const double_double> u, double rho) const;
  void bound_pairs(const handed_out& state, std::span<const double_double> u, error_bounds& b) const;
  void bound_forces(const handed_out& state, std::span<const double_double> u, error_bounds& b) const;
  /// The force of each support, how far off it may be, and by how much of rho.
  struct true_reaction {
    double_double force;
    double slack = 0.0, per_rho = 0.0;
  };
  /// Of the numbers that it is made of: a coordinate, a length or a modulus comes in at most ten times, each
  /// good to 2^-94.
  [[nodiscard]] static double noise_of(const element_value& v) { return 4 * true_rounding * v.size; }
  [[nodiscard]] std::vector<true_reaction> reactions_at(std::span<const double_double> u,
                                                        const residual& r) const;
  void bound_reactions(const handed_out& state, const residual& r, std::span<const double_double> u,
                       error_bounds& b) const;
  void bound_element_values(const handed_out& state, error_bounds& b) const;

  const problem& problem_;
  const linear_structure& structure_;
  true_system true_;
  scaled_stiffness stiffness_;
  std::optional<std::vector<int>> factored_;  // the pairs in the last factor
  double mu_ = 0.0, inverse_root_mu_ = 0.0;
  exact_residual exactly_;
  semidefinite_test exactly_semidefinite_;
  std::optional<bool> semidefinite_;
  bool closely_ = false;  // residuals are exact though doubles factor K_A
  true_loads loads_;
  int refined_step_ = 0;
  long_vector refined_;
  std::optional<error_bounds>
      refined_bounds_;                 // of that state, where it is held for certain: A and rho alone
  residual residual_;                  // of the state refined or bounded last
  std::vector<element_value> values_;  // and what is read off its elements
  long_vector z_;                      // about K_A^-1 r
  bool keeps_proof_ = false;
  std::optional<step_proof> proof_;
};

}  // namespace contct::certify
