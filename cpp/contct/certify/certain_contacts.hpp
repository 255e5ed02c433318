// Which pairs are certainly in contact, and how far a state can be from the equilibrium in the norm of their
// stiffness (reference/certificate-proof.md).
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "contct/certify/scaled_stiffness.hpp"
#include "contct/model/structure.hpp"

namespace contct {

/// The facts about a state's contacts that are certain.
struct contact_set {
  bool unique = true;      ///< false: the same forces also balance at other displacements
  std::string not_proved;  ///< why the contacts are not proved, in words; empty if they are
  double rho = std::numeric_limits<double>::infinity();  ///< how far the state is, in the norm of K_A
  std::vector<int> closed;  ///< A: the pairs that are certainly in contact, from 0
};

/// A, the pairs that are certainly in contact, with K_A, its factor, and the proof that it is definite.
class certain_contacts {
 public:
  /// All must outlive this object.
  certain_contacts(const problem& p, const linear_structure& s, const long_system& system);

  /// A and rho of `b`, for a state with a residual: A begins with all pairs beyond their faces; those that
  /// are not certainly beyond are removed. False, with the reason, if nothing is proved.
  bool find(std::span<const double_double> u, const long_residual& r, contact_set& b);
  /// If the pairs of A leave rigid-body motions on which the load does no work: add springs without force,
  /// which hold the structure at its position and change nothing else.
  bool find_balanced(int step, std::span<const double_double> u, const long_residual& r, contact_set& b);

  /// Factor K_A; is it definite for certain?
  [[nodiscard]] bool proves(const std::vector<int>& closed);
  /// Pairs beyond their faces.
  [[nodiscard]] std::vector<int> pressed(std::span<const double_double> u) const;
  /// `closed`, extended by the pairs nearest to their faces if `closed` alone does not hold the structure.
  [[nodiscard]] std::vector<int> holding(std::span<const double_double> u, std::vector<int> closed) const;

  /// The largest change of a dof between two states at a distance of 1.
  [[nodiscard]] double reach(std::size_t dof) const { return stiffness_.scale(dof) * inverse_root_mu_; }
  /// The same of the difference that a pair sees: of one dof, or between two.
  [[nodiscard]] double reach(const long_pair& p) const {
    return p.other < 0 ? reach(p.dof) : reach(p.dof) + reach(p.other);
  }
  /// The largest difference between a pair's depth under u and in any state within rho of u.
  [[nodiscard]] double reach_of_pair(std::size_t pair, std::span<const double_double> u, double rho) const;
  /// Not in contact, in any state within rho of u.
  [[nodiscard]] bool is_certainly_open(std::size_t pair, std::span<const double_double> u, double rho) const;

  [[nodiscard]] scaled_stiffness& stiffness() { return stiffness_; }
  [[nodiscard]] const scaled_stiffness& stiffness() const { return stiffness_; }
  [[nodiscard]] const long_vector& z() const { return z_; }

 private:
  [[nodiscard]] std::string search(std::span<const double_double> u, const long_residual& r, bool balanced,
                                   contact_set& b);
  [[nodiscard]] rigid_rank held_by(const std::vector<int>& closed) const;
  /// Can half a unit in the last digits of a matrix, that does not say how many motions it leaves free, make
  /// K_A indefinite?
  [[nodiscard]] bool last_digits_decide() const;
  [[nodiscard]] std::optional<double> norm_of(const long_residual& r);
  [[nodiscard]] bool stands_free(int step, std::span<const double_double> u, const contact_set& b) const;
  /// Removes from `closed` the pairs that may be separated; false if there are none.
  bool erase_doubtful(std::span<const double_double> u, double rho, std::vector<int>& closed) const;

  const problem& problem_;
  const linear_structure& structure_;
  const long_system& system_;
  scaled_stiffness stiffness_;
  std::optional<std::vector<int>> factored_;  // the pairs in the last factor
  double mu_ = 0.0, inverse_root_mu_ = 0.0;
  long_vector z_;  // about K_A^-1 r
};

}  // namespace contct
