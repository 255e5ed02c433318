// The Cholesky factor of K with springs, however K is stored.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "contct/matrix/sparse_factor.hpp"
#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

/// A spring at one row.
struct spring_at {
  int row;
  double stiffness;
};

/// K with springs on its diagonal: factored by LAPACK where K is a band, by CHOLMOD where it is not.
/// Memory: the factor, besides K; for a sparse K its entries once more.
class stiffness_factor {
 public:
  /// `k` must outlive this object.
  explicit stiffness_factor(const stiffness_matrix& k);

  /// False when a pivot is not positive. True does not mean that the matrix was sound: a mechanism can pass.
  [[nodiscard]] bool factor(std::span<const spring_at> springs);

  /// Solve in place, by rows.
  void solve(std::span<double> b);

  /// Solve for the unit vectors of up to `many` rows in one pass over the factor: x[row * many + i] for the
  /// i-th. A row of -1 leaves zeros.
  void solve_units(std::span<const int> rows, std::vector<double>& x);

  /// Products and sums that a factorisation takes.
  [[nodiscard]] double flops() const;

  /// Reciprocal condition of K with `springs`, its diagonal scaled to 1: see cholesky.hpp. The factor is gone
  /// afterwards.
  [[nodiscard]] double reciprocal_condition(std::span<const spring_at> springs);

  /// The factor itself, of a band. Throws std::logic_error otherwise.
  [[nodiscard]] const band_matrix& band() const;

 private:
  [[nodiscard]] std::vector<double> diagonal_with(std::span<const spring_at> springs) const;
  void assemble(std::span<const spring_at> springs);

  const stiffness_matrix& k_;
  band_matrix band_;
  std::optional<sparse_factor> sparse_;
};

}  // namespace contct
