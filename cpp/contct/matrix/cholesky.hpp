// Cholesky factors: LAPACK's of bands (dpbtrf, dpbtrs), those of K with springs in either storage, and their
// condition.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "contct/matrix/sparse_factor.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

/// Replace `matrix` by its Cholesky factor L, A = L L^T (dpbtrf, lower). Returns false when a
/// pivot is not positive. Rounding can give the matrix of a mechanism a factor, too.
[[nodiscard]] bool factor(band_matrix& matrix);

/// Solve A x = b in place, with the factor of A (dpbtrs), for one right-hand side or several, one after the
/// other.
void solve_with(const band_matrix& factor_of_a, std::span<double> b);

/// Solves A x = b in place.
using in_place_solver = std::function<void(std::span<double>)>;

/// The LAPACK in use: its version from ILAVER, and the library that holds dpbtrf, as in "LAPACK 3.11.0,
/// liblapack.so.3.11.0"; and the configuration of OpenBLAS if that is loaded. Results of solves differ
/// between libraries, calls of CONTCT do not.
[[nodiscard]] std::string lapack_identity();

/// Reciprocal condition number, in the 1-norm, of `k` with `diagonal` [rows] in place of its own, scaled to a
/// unit diagonal: 1 / (norm of A times norm of its inverse), estimated as dpbcon does, in linear time. The
/// scaling makes it independent of units. `solve` solves with that matrix, unscaled.
[[nodiscard]] double reciprocal_condition(const stiffness_matrix& k, std::span<const double> diagonal,
                                          const in_place_solver& solve);

/// Whole decimal digits that a solution keeps at this reciprocal condition: -log10(eps / rcond),
/// never negative, at most 15.
[[nodiscard]] int digits_left(double rcond);

/// K with springs on its diagonal: factored by LAPACK if K is a band, otherwise by CHOLMOD. Memory: the
/// factor, besides K; for a sparse K its entries once more.
class stiffness_factor {
 public:
  /// `k` must outlive this object.
  explicit stiffness_factor(const stiffness_matrix& k);

  /// By a factor of K that is at hand; `k` is not stored as a band.
  stiffness_factor(const stiffness_matrix& k, std::unique_ptr<sparse_factor> of_k)
      : k_(k), sparse_(std::move(of_k)) {}

  /// False when a pivot is not positive. Rounding can give a mechanism a factor, too.
  [[nodiscard]] bool factor(std::span<const spring_at> springs) {
    if (sparse_) return factor_columns(springs);
    assemble(springs);
    return contct::factor(band_);
  }

  /// Solve in place, by rows, for one right-hand side or several, one after the other.
  void solve(std::span<double> b) {
    if (sparse_) return sparse_->solve(b);
    solve_with(band_, b);
  }

  /// Products and sums that a factorisation takes.
  [[nodiscard]] double flops() const {
    if (sparse_) return sparse_->flops();
    const double kd = k_.band().subdiagonals();
    return static_cast<double>(k_.order()) * kd * kd;
  }

  /// Reciprocal condition of K with `springs`, its diagonal scaled to 1; 0 when it has no factor then.
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
  std::unique_ptr<sparse_factor> sparse_;  // of K if it is not stored as a band
};

}  // namespace contct
