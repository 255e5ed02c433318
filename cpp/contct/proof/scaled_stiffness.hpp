// K_A, the stiffness with the springs of some pairs: its factor in doubles, or in 32 digits if doubles are
// not accurate enough, and a proof of a lower bound on its least eigenvalue (reference/certificate-proof.md).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "contct/linear/sparse_factor.hpp"
#include "contct/linear/stiffness_matrix.hpp"
#include "contct/proof/factors.hpp"
#include "contct/proof/long_system.hpp"

namespace contct {

/// The proof that S K_A S >= mu I: a factor L of S K_A S - shift I up to rounding. mu is the shift less a
/// bound on the error of L L'.
struct stiffness_proof {
  std::vector<double> scale;  ///< S [dofs], powers of two
  std::vector<int> row_of;    ///< row of each dof in L [dofs], from 0
  double shift = 0.0;
  std::variant<band_matrix, long_band> factor;  ///< L, in 32 digits if doubles are not accurate enough
};

/// S K_A S, where S is diagonal and consists of powers of two, so that the diagonal of S K_A S is between 1/8
/// and 1. Rows of fixed dofs are unit rows.
class scaled_stiffness {
 public:
  /// `row_of`: the row of each dof in a band with `subdiagonals`. Without `subdiagonals`, CHOLMOD factors
  /// sparse columns. `by_columns`: sparse columns are faster than the band, and are used unless proofs are
  /// kept. `keeps_proofs`: least_eigenvalue keeps its proof, which takes the memory of one more band; proofs
  /// are not kept for sparse columns. `t` must outlive this object.
  scaled_stiffness(const long_system& t, std::vector<int> row_of, std::optional<int> subdiagonals,
                   bool by_columns = false, bool keeps_proofs = false);

  /// Factors K with the springs of these pairs, from 0, in doubles or, if a pivot is not positive, in 32
  /// digits. False if a pivot is not positive in 32 digits either, or the band is too large for 32 digits. A
  /// number beyond the pairs is a dof, counted from there; its spring is as stiff as K is at this dof.
  [[nodiscard]] bool factor(std::span<const int> pairs);

  /// Returns mu > 0 with S K_A S >= mu I; 0 if no mu is proved. Takes at least one factorisation and two
  /// solves.
  [[nodiscard]] double least_eigenvalue();

  /// If factoring in 32 digits failed too: displacements u with u' K_A u <= 0 up to rounding. Otherwise
  /// zeros.
  [[nodiscard]] std::vector<double> doubtful_motion() const;

  /// Is the last factor in 32 digits?
  [[nodiscard]] bool has_32_digits() const { return long_.has_value(); }

  /// Replaces b [dofs], which is 0 at fixed dofs, by K_A^-1 b, rounded to doubles.
  void solve(std::span<double> b) const;

  /// Returns K_A x. `sizes`: see long_system::add_product.
  [[nodiscard]] long_vector times(std::span<const double_double> x, std::span<double> sizes = {}) const;

  /// The proof for the last factor; empty before least_eigenvalue and for sparse columns.
  [[nodiscard]] const std::optional<stiffness_proof>& proof() const { return proof_; }

  [[nodiscard]] double scale(std::size_t dof) const { return scale_[dof]; }

 private:
  /// The products of a narrow band are summed in 32 digits.
  [[nodiscard]] bool is_narrow() const { return subdiagonals_ && *subdiagonals_ <= 16; }
  /// S K_A S - shift I, in rows of the band, or by columns.
  template <class Number>
  [[nodiscard]] band_of_numbers<Number> band(double shift) const;
  [[nodiscard]] sparse_columns columns() const;
  template <class Put>
  void each_entry(double shift, const Put& put) const;
  void solve_rows(std::span<double> x) const;
  [[nodiscard]] bool factor_in_doubles();
  bool factor_in_32_digits();
  [[nodiscard]] double proved_below_estimate();
  [[nodiscard]] double least_estimate() const;
  /// A bound on the norm of L L' - (S K_A S - shift I); empty if the factorisation failed.
  template <class Number>
  [[nodiscard]] std::optional<double> error_of_band(double shift);
  [[nodiscard]] std::optional<double> error_of_columns(double shift) const;

  const long_system& system_;
  std::vector<int> row_of_, dof_at_;
  std::optional<int> subdiagonals_;
  bool by_columns_, keeps_proofs_;
  long_vector springs_;  // diagonal entries of the springs of pairs [dofs]
  /// The off-diagonal entries of springs between two dofs; the key has both dofs.
  std::map<std::pair<int, int>, double_double> between_;
  std::vector<double> scale_;  // S [dofs]
  long_band narrow_;           // S K_A S as a narrow band
  sparse_columns columns_;     // by columns, rounded
  band_matrix factor_;
  std::unique_ptr<sparse_factor> sparse_;  // used instead of factor_
  std::optional<long_band> long_;          // used instead of factor_ and sparse_
  std::optional<stiffness_proof> proof_;
};

}  // namespace contct
