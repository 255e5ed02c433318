// Finds the set A of pairs that are certainly in contact, and bounds the distance of a state from the
// equilibrium in the norm of K_A, the stiffness with the springs of A (reference/certificate-proof.md).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/proof/scaled_stiffness.hpp"
#include "contct/proof/solved_path.hpp"
#include "contct/structure/structure.hpp"

namespace contct {

/// Tells how nearly free the rigid-body motions of a matrix are, and asks for free_motions.
[[nodiscard]] std::string nearly_free_words(const linear_structure& s);

class certain_contacts {
 public:
  /// All arguments must outlive this object.
  certain_contacts(const problem& p, const linear_structure& s, const long_system& system, bool keeps_proofs);

  /// Sets A and rho in `b` for displacements u with residual r. A begins with all pairs that are beyond their
  /// faces at u; pairs that may be separated in the equilibrium are removed. If nothing is proved, returns
  /// false and sets `b.not_proved`.
  bool find(std::span<const double_double> u, const long_residual& r, contact_set& b);
  /// The same for a state that balances: the supports and the pairs of A leave a rigid-body motion free, but
  /// the load does no work on this motion. Springs without force hold the structure during the proof. If
  /// nothing is proved, returns false and leaves `b` unchanged.
  bool find_balanced(int step, std::span<const double_double> u, const long_residual& r, contact_set& b);

  /// Factors K_A for A = `closed`; returns true if K_A is certainly positive definite.
  [[nodiscard]] bool proves(const std::vector<int>& closed);
  /// The pairs at free dofs that are beyond their faces.
  [[nodiscard]] std::vector<int> pressed(std::span<const double_double> u) const;
  /// `closed`, plus as many of the pairs nearest to their faces as are needed to hold the structure. If the
  /// pairs of a beam or plate are too few: plus springs at dofs (see scaled_stiffness::factor).
  [[nodiscard]] std::vector<int> holding(std::span<const double_double> u, std::vector<int> closed) const;

  /// A bound on the change of a displacement between two states at a distance of 1 in the norm of K_A.
  [[nodiscard]] double reach(std::size_t dof) const { return stiffness_.scale(dof) * inverse_root_mu_; }
  /// The same bound for the relative displacement of a pair.
  [[nodiscard]] double reach(const long_pair& p) const {
    return p.other < 0 ? reach(p.dof) : reach(p.dof) + reach(p.other);
  }
  /// A bound on the change of a pair's depth beyond its face between u and any state within rho of u,
  /// rounding included.
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
  [[nodiscard]] std::optional<double> norm_of(const long_residual& r);
  [[nodiscard]] double square_of_norm(const long_residual& r, const long_vector& left,
                                      std::span<const double> sizes, double& least) const;
  [[nodiscard]] bool stands_free(int step, std::span<const double_double> u, const contact_set& b) const;
  /// Removes from `closed` the pairs that may be separated; returns false if no pair was removed.
  bool erase_doubtful(std::span<const double_double> u, double rho, std::vector<int>& closed) const;

  const problem& problem_;
  const linear_structure& structure_;
  const long_system& system_;
  scaled_stiffness stiffness_;
  std::optional<std::vector<int>> factored_;  // the pairs whose springs are in the factor
  double mu_ = 0.0, inverse_root_mu_ = 0.0;
  long_vector z_;  // approximates K_A^-1 r
};

}  // namespace contct
