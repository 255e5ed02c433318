// Cholesky factors by LAPACK for bands (dpbtrf, dpbtrs) and by CHOLMOD for sparse matrices, with springs
// added to K, and reciprocal condition numbers.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "contct/matrix/sparse_factor.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

/// Replaces `matrix` by its Cholesky factor L, A = L L^T (dpbtrf, lower). False if a pivot is not positive.
/// Rounding can make the factorisation succeed for a mechanism.
[[nodiscard]] bool factor(band_matrix& matrix);

/// Solves A x = b in place with the factor of A (dpbtrs), for one or several right-hand sides, one after the
/// other.
void solve_with(const band_matrix& factor_of_a, std::span<double> b);

using in_place_solver = std::function<void(std::span<double>)>;

/// The LAPACK in use: its version by ILAVER and the library that contains dpbtrf, as in "LAPACK 3.11.0,
/// liblapack.so.3.11.0"; if OpenBLAS is loaded, also its configuration. Results of solves differ between
/// these libraries; the calls of CONTCT do not.
[[nodiscard]] std::string lapack_identity();

/// Reciprocal condition number in the 1-norm of `k`, with `diagonal` [rows] as its diagonal and scaled to a
/// unit diagonal, which makes it independent of units: 1 / (norm of A times norm of its inverse). Estimated
/// as by dpbcon, in linear time. `solve` solves with the unscaled matrix.
[[nodiscard]] double reciprocal_condition(const stiffness_matrix& k, std::span<const double> diagonal,
                                          const in_place_solver& solve);

/// Whole decimal digits that a solution keeps: -log10(eps / rcond), from 0 to 15.
[[nodiscard]] int digits_left(double rcond);

/// K with springs, factored by LAPACK if K is a band, otherwise by CHOLMOD. Memory: a factor; for a sparse K
/// also a copy of its entries.
class stiffness_factor {
 public:
  /// `k` must outlive this object.
  explicit stiffness_factor(const stiffness_matrix& k);

  /// With an existing factor of K; `k` is not stored as a band.
  stiffness_factor(const stiffness_matrix& k, std::unique_ptr<sparse_factor> of_k)
      : k_(k), sparse_(std::move(of_k)) {}

  /// False if a pivot is not positive. Rounding can make the factorisation succeed for a mechanism.
  [[nodiscard]] bool factor(std::span<const spring_at> springs) {
    if (sparse_) return factor_columns(springs);
    assemble(springs);
    return contct::factor(band_);
  }

  /// Solves in place, by rows, for one or several right-hand sides, one after the other.
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

  /// Reciprocal condition of K with `springs`, its diagonal scaled to 1; 0 if it cannot be factored.
  /// Overwrites the factor.
  [[nodiscard]] double reciprocal_condition(std::span<const spring_at> springs);

 private:
  /// Overwrites the last factor.
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
