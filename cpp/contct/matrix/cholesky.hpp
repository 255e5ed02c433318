// Cholesky factors of a stiffness matrix K with springs, by LAPACK for bands (dpbtrf, dpbtrs) and by CHOLMOD
// for sparse matrices, and reciprocal condition numbers.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "contct/matrix/sparse_factor.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

/// Replaces `matrix`, A, by its Cholesky factor L with A = L L^T (dpbtrf, lower). Returns false if a pivot is
/// not positive. Rounding can make the factorisation of a mechanism succeed.
[[nodiscard]] bool factor(band_matrix& matrix);

/// Solves A x = b in place with the factor of A (dpbtrs). `b`: one or several right-hand sides, stored one
/// after the other.
void solve_with(const band_matrix& factor_of_a, std::span<double> b);

using in_place_solver = std::function<void(std::span<double>)>;

/// Describes the LAPACK in use: its version by ILAVER and the library that contains dpbtrf, as in "LAPACK
/// 3.11.0, liblapack.so.3.11.0"; if OpenBLAS is loaded, also its configuration. Results of solves depend on
/// these libraries; the CONTCT kernels do not use them.
[[nodiscard]] std::string lapack_identity();

/// Estimates the reciprocal condition number in the 1-norm of A, which is `k` with `diagonal` [rows] as its
/// diagonal, scaled to a unit diagonal: 1 / (norm of A times norm of its inverse). The scaling makes the
/// number independent of units. 0 if an entry of `diagonal` is not positive. `solve` solves with the unscaled
/// matrix, a few times.
[[nodiscard]] double reciprocal_condition(const stiffness_matrix& k, std::span<const double> diagonal,
                                          const in_place_solver& solve);

/// The number of whole decimal digits, from 0 to 15, that a solution keeps: -log10(eps / rcond), eps = 2^-53.
[[nodiscard]] int digits_left(double rcond);

/// K with springs, factored by LAPACK if K is a band, otherwise by CHOLMOD. Memory: one factor; for a sparse
/// K also a copy of its entries.
class stiffness_factor {
 public:
  /// `k` must outlive this object.
  explicit stiffness_factor(const stiffness_matrix& k);

  /// Uses `of_k`, an object that factors K, instead of making one. `k` must be stored by columns, and outlive
  /// this object.
  stiffness_factor(const stiffness_matrix& k, std::unique_ptr<sparse_factor> of_k)
      : k_(k), sparse_(std::move(of_k)) {}

  /// Factors K with `springs`. Returns false if a pivot is not positive: see contct::factor.
  [[nodiscard]] bool factor(std::span<const spring_at> springs) {
    if (sparse_) return factor_columns(springs);
    assemble(springs);
    return contct::factor(band_);
  }

  /// Solves in place. `b`: right-hand sides, one after the other, each in the order of K's rows.
  void solve(std::span<double> b) {
    if (sparse_) return sparse_->solve(b);
    solve_with(band_, b);
  }

  /// The number of multiplications and additions in a factorisation.
  [[nodiscard]] double flops() const {
    if (sparse_) return sparse_->flops();
    const double kd = k_.band().subdiagonals();
    return static_cast<double>(k_.order()) * kd * kd;
  }

  /// The reciprocal condition number of K with `springs`, scaled to a unit diagonal; 0 if this matrix cannot
  /// be factored. Overwrites the factor.
  [[nodiscard]] double reciprocal_condition(std::span<const spring_at> springs);

 private:
  /// Writes K with `springs` into band_, over the last factor.
  void assemble(std::span<const spring_at> springs) {
    band_ = k_.band();
    for (const spring_at& s : springs) {
      band_.at(s.row, s.row) += s.stiffness;
      if (s.other < 0) continue;
      band_.at(s.other, s.other) += s.stiffness;
      band_.add(s.row, s.other, -s.stiffness);
    }
  }
  [[nodiscard]] bool factor_columns(std::span<const spring_at> springs);

  const stiffness_matrix& k_;
  band_matrix band_;
  std::unique_ptr<sparse_factor> sparse_;  // null if K is a band
};

}  // namespace contct
