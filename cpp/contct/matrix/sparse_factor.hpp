// CHOLMOD's Cholesky factor of a sparse matrix; every build has this header, not every one has the library.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "contct/matrix/sparse_columns.hpp"

namespace contct {

/// A = L L^T of a symmetric positive definite matrix, in an order of little fill.
class sparse_factor {
 public:
  /// Is the library built in? Without it nothing below can be called: std::logic_error.
  [[nodiscard]] static bool available();

  /// Finds the order, and keeps A. Throws std::bad_alloc.
  explicit sparse_factor(sparse_columns a);
  ~sparse_factor();
  sparse_factor(sparse_factor&& other) noexcept;
  sparse_factor& operator=(sparse_factor&& other) noexcept;
  sparse_factor(const sparse_factor&) = delete;
  sparse_factor& operator=(const sparse_factor&) = delete;

  /// Bytes that the factor takes; known before it is made.
  [[nodiscard]] std::int64_t bytes() const;

  /// Factor A with `diagonal` [order] for its own. False when a pivot is not positive. Throws std::bad_alloc.
  [[nodiscard]] bool factor(std::span<const double> diagonal);

  /// Solve A x = b in place.
  void solve(std::span<double> b);

  /// Solve A x = e for the unit vectors of up to `many` rows in one pass over the factor: x[row * many + i]
  /// for the i-th. A row of -1 leaves zeros.
  void solve_units(std::span<const int> rows, std::vector<double>& x);

  /// Products and sums that a factorisation takes.
  [[nodiscard]] double flops() const;

 private:
  class library;
  std::unique_ptr<library> library_;
};

}  // namespace contct
