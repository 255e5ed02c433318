// Cholesky factors of a stiffness matrix K with springs, by LAPACK for bands (dpbtrf, dpbtrs) and by CHOLMOD
// for sparse matrices, and reciprocal condition numbers.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "contct/linear/sparse_factor.hpp"
#include "contct/linear/stiffness_matrix.hpp"

namespace contct {

/// Replaces `matrix`, A, by its Cholesky factor L with A = L L^T (dpbtrf, lower). Returns false if a pivot is
/// not positive.
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

/// The factor that suits the storage of `k`: LAPACK's for a band, otherwise CHOLMOD's.
[[nodiscard]] std::unique_ptr<matrix_factor> usual_factor(const stiffness_matrix& k);

/// K with springs, factored. Memory: one factor, and a copy of K while it is factored.
class stiffness_factor {
 public:
  /// `k` must outlive this object.
  explicit stiffness_factor(const stiffness_matrix& k) : stiffness_factor(k, usual_factor(k)) {}
  stiffness_factor(const stiffness_matrix& k, std::unique_ptr<matrix_factor> by)
      : k_(k), factor_(std::move(by)) {}

  /// Factors K with `springs`. Returns false if a pivot is not positive: see matrix_factor.
  [[nodiscard]] bool factor(std::span<const spring_at> springs);

  /// Solves in place. `b`: right-hand sides, one after the other, each in the order of K's rows.
  void solve(std::span<double> b) { factor_->solve(b); }

  /// The number of multiplications and additions in a factorisation.
  [[nodiscard]] double flops() const { return factor_->flops(); }

  /// The reciprocal condition number of K with `springs`, scaled to a unit diagonal; 0 if this matrix cannot
  /// be factored. Overwrites the factor.
  [[nodiscard]] double reciprocal_condition(std::span<const spring_at> springs);

 private:
  const stiffness_matrix& k_;
  std::unique_ptr<matrix_factor> factor_;
};

}  // namespace contct
