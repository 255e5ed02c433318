// The Cholesky factor of K with springs, in either storage of K.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contct/matrix/sparse_factor.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

namespace contct::matrix {

/// K with springs on its diagonal: factored by LAPACK where K is a band, by CHOLMOD where it is not.
/// Memory: the factor, besides K; for a sparse K its entries once more.
class stiffness_factor {
 public:
  /// `k` must outlive this object.
  explicit stiffness_factor(const stiffness_matrix& k);

  /// False when a pivot is not positive. Rounding can give a mechanism a factor, too.
  [[nodiscard]] bool factor(std::span<const spring_at> springs);

  /// Solve in place, by rows.
  void solve(std::span<double> b);

  /// Solve for the unit vectors of up to `block_width` rows in one pass over the factor:
  /// x[row * block_width + i] for the i-th. A row of -1 leaves zeros.
  void solve_units(std::span<const int> rows, std::vector<double>& x);

  /// Products and sums that a factorisation takes.
  [[nodiscard]] double flops() const;

  /// Reciprocal condition of K with `springs`, its diagonal scaled to 1: see cholesky.hpp. Overwrites
  /// the factor.
  [[nodiscard]] double reciprocal_condition(std::span<const spring_at> springs);

  /// The factor itself, of a band. Throws std::logic_error otherwise.
  [[nodiscard]] const band_matrix& band() const;

 private:
  void assemble(std::span<const spring_at> springs);

  const stiffness_matrix& k_;
  band_matrix band_;
  std::unique_ptr<sparse_factor> sparse_;  // of K where it is no band
};

}  // namespace contct::matrix
