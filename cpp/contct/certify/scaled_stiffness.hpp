// K_A, the stiffness with the springs of some pairs: its factor, in doubles or in 32 digits if these are too
// short, and a proof of its least eigenvalue (reference/certificate-proof.md).
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "contct/certify/factors.hpp"
#include "contct/certify/long_system.hpp"
#include "contct/matrix/sparse_factor.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

/// S K_A S - shift I is all but L L': what proves that S K_A S >= mu I.
struct stiffness_proof {
  std::vector<double> scale;  ///< S [dofs], powers of two
  std::vector<int> row_of;    ///< the row of each dof in L [dofs], from 0
  double shift = 0.0;
  std::variant<band_matrix, long_band> factor;  ///< L, in 32 digits where doubles are too short for it
};

/// S K_A S, with powers of two in S such that the diagonal is between 1/8 and 1. Rows of fixed dofs are unit
/// rows.
class scaled_stiffness {
 public:
  /// `row_of`: the row of each dof in a band of `subdiagonals`; without these, by sparse columns, which takes
  /// CHOLMOD. `by_columns`: these are quicker than that band, and are taken unless a proof is kept. `t` must
  /// outlive this object.
  scaled_stiffness(const long_system& t, std::vector<int> row_of, std::optional<int> subdiagonals,
                   bool by_columns = false);

  /// Take the springs of these pairs, from 0, into K_A, and factor it. False where a pivot is not positive.
  [[nodiscard]] bool factor(std::span<const int> pairs);

  /// mu with S K_A S >= mu I; 0 where none can be proved. Takes a factorisation or more, and four solves.
  [[nodiscard]] double least_eigenvalue();

  /// If 32 digits gave no factor either: displacements on which K_A may do negative work. Otherwise 0.
  [[nodiscard]] std::vector<double> suspect() const;

  /// Did the last factor take 32 digits?
  [[nodiscard]] bool has_32_digits() const { return long_.has_value(); }

  /// K_A^-1 b, rounded to doubles, for b [dofs] that is 0 at fixed ones.
  void solve(std::span<double> b) const;

  /// K_A x; `sizes` as long_system::add_product has them.
  [[nodiscard]] long_vector times(std::span<const double_double> x, std::span<double> sizes = {}) const;

  /// Keep the proof of the bound that least_eigenvalue finds, which takes one more band. No proof is kept for
  /// sparse columns.
  void keep_proof() {
    keeps_proof_ = true;
    by_columns_ = !subdiagonals_;
  }
  /// The proof for the last factor; empty before least_eigenvalue.
  [[nodiscard]] const std::optional<stiffness_proof>& proof() const { return proof_; }

  [[nodiscard]] double scale(std::size_t dof) const { return scale_[dof]; }

 private:
  /// S K_A S - shift I, in rows of the band, or by columns.
  template <class Number>
  [[nodiscard]] band_of_numbers<Number> band(double shift) const;
  [[nodiscard]] sparse_columns columns(double shift) const;
  template <class Put>
  void each_entry(double shift, const Put& put) const;
  void solve_rows(std::span<double> x) const;
  [[nodiscard]] bool factor_in_doubles();
  bool factor_in_32_digits();
  [[nodiscard]] double proved_below_estimate();
  [[nodiscard]] double least_estimate() const;
  /// The norm of L L' - (S K_A S - shift I); nothing if there is no factor.
  template <class Number>
  [[nodiscard]] std::optional<double> error_of_band(double shift);
  [[nodiscard]] std::optional<double> error_of_columns(double shift) const;

  const long_system& system_;
  std::vector<int> row_of_, dof_at_;
  std::optional<int> subdiagonals_;
  bool by_columns_;
  long_vector springs_;  // [dofs] of the pairs taken in
  /// The off-diagonal entries of springs between two dofs, by both dofs.
  std::map<std::pair<int, int>, double_double> beside_;
  std::vector<double> scale_;  // S [dofs]
  band_matrix factor_;
  std::unique_ptr<sparse_factor> sparse_;  // in place of it
  std::optional<long_band> long_;          // in place of both
  bool keeps_proof_ = false;
  std::optional<stiffness_proof> proof_;
};

}  // namespace contct
