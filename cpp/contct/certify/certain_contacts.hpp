// Finds which pairs are certainly in contact, and bounds the distance of a state from the equilibrium in the
// norm of K_A (reference/certificate-proof.md).
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/certify/scaled_stiffness.hpp"
#include "contct/model/structure.hpp"

namespace contct {

/// The proved facts about the contacts of a state.
struct contact_set {
  bool unique = true;      ///< false: the same forces also balance at other displacements
  std::string not_proved;  ///< why the contacts are not proved, in words; empty if they are
  double rho = std::numeric_limits<double>::infinity();  ///< bound on the distance to the equilibrium
  std::vector<int> closed;                               ///< A: the pairs certainly in contact, from 0
};

/// Finds the set A of pairs certainly in contact, and proves that K_A, with their springs, is definite.
class certain_contacts {
 public:
  /// All arguments must outlive this object.
  certain_contacts(const problem& p, const linear_structure& s, const long_system& system);

  /// Sets A and rho in `b` for a state with a residual. A begins with all pairs beyond their faces; pairs
  /// that are not certainly beyond are removed. If nothing is proved, returns false and sets `b.not_proved`.
  bool find(std::span<const double_double> u, const long_residual& r, contact_set& b);
  /// Proves a state that balances: the pairs of A do not stop some rigid-body motions, but the load does no
  /// work on them. Springs without force hold the structure during the proof.
  bool find_balanced(int step, std::span<const double_double> u, const long_residual& r, contact_set& b);

  /// Factors K_A and returns true if it is certainly positive definite.
  [[nodiscard]] bool proves(const std::vector<int>& closed);
  /// The pairs beyond their faces.
  [[nodiscard]] std::vector<int> pressed(std::span<const double_double> u) const;
  /// `closed`, plus the pairs nearest to their faces that are needed to hold the structure.
  [[nodiscard]] std::vector<int> holding(std::span<const double_double> u, std::vector<int> closed) const;

  /// The largest change of a dof between two states at a distance of 1 in the norm of K_A.
  [[nodiscard]] double reach(std::size_t dof) const { return stiffness_.scale(dof) * inverse_root_mu_; }
  /// The largest change of the relative displacement of a pair between two such states.
  [[nodiscard]] double reach(const long_pair& p) const {
    return p.other < 0 ? reach(p.dof) : reach(p.dof) + reach(p.other);
  }
  /// A bound on the difference of a pair's depth between u and any state within rho of u.
  [[nodiscard]] double reach_of_pair(std::size_t pair, std::span<const double_double> u, double rho) const;
  /// Is the pair separated in every state within rho of u?
  [[nodiscard]] bool is_certainly_open(std::size_t pair, std::span<const double_double> u, double rho) const;

  [[nodiscard]] scaled_stiffness& stiffness() { return stiffness_; }
  [[nodiscard]] const scaled_stiffness& stiffness() const { return stiffness_; }
  [[nodiscard]] const long_vector& z() const { return z_; }

 private:
  [[nodiscard]] std::string search(std::span<const double_double> u, const long_residual& r, bool balanced,
                                   contact_set& b);
  [[nodiscard]] rigid_rank held_by(const std::vector<int>& closed) const;
  /// Can half a unit in the last digits of a matrix make K_A indefinite? False if `free_motions` is given.
  [[nodiscard]] bool last_digits_decide() const;
  [[nodiscard]] std::optional<double> square_without_z(const long_residual& r) const;
  [[nodiscard]] std::optional<double> norm_of(const long_residual& r);
  [[nodiscard]] bool stands_free(int step, std::span<const double_double> u, const contact_set& b) const;
  /// Removes from `closed` the pairs that may be separated; returns false if there are none.
  bool erase_doubtful(std::span<const double_double> u, double rho, std::vector<int>& closed) const;

  const problem& problem_;
  const linear_structure& structure_;
  const long_system& system_;
  scaled_stiffness stiffness_;
  std::optional<std::vector<int>> factored_;  // the pairs of the last factor
  double mu_ = 0.0, inverse_root_mu_ = 0.0;
  long_vector z_;  // approximates K_A^-1 r
};

}  // namespace contct
