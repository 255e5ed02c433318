// Cholesky factors of sparse matrices, by CHOLMOD or by an MPI job. Builds without CHOLMOD cannot make
// CHOLMOD's factors.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "contct/linear/stiffness_matrix.hpp"

namespace contct {

/// The factor of symmetric positive definite matrices that have their entries at the same positions. The
/// factor may order the rows for little fill; right-hand sides stay in the order of the matrix.
class matrix_factor {
 public:
  matrix_factor() = default;
  virtual ~matrix_factor() = default;
  matrix_factor(const matrix_factor&) = delete;
  matrix_factor& operator=(const matrix_factor&) = delete;

  /// Factors `a`; false if a pivot is not positive. Rounding can make the factorisation of a mechanism
  /// succeed. Throws std::bad_alloc.
  [[nodiscard]] virtual bool factor(const sparse_columns& a) = 0;

  /// Solves A x = b in place. `b`: right-hand sides, one after the other. Throws std::bad_alloc.
  virtual void solve(std::span<double> b) = 0;

  /// The number of multiplications and additions in a factorisation.
  [[nodiscard]] virtual double flops() const = 0;

  /// True for the factor of a band by LAPACK.
  [[nodiscard]] virtual bool is_band() const { return false; }
};

/// CHOLMOD's factor.
class sparse_factor : public matrix_factor {
 public:
  /// True if CHOLMOD is built in.
  [[nodiscard]] static bool available();

  /// Orders the rows of matrices like `a` by AMD; many rows by METIS or AMD, whichever is better. Throws
  /// std::bad_alloc, and std::logic_error if CHOLMOD is not built in.
  [[nodiscard]] static std::unique_ptr<sparse_factor> make(const sparse_columns& a);

  /// Another factor for matrices with entries at the same positions, with the same order of rows.
  [[nodiscard]] virtual std::unique_ptr<sparse_factor> likewise() const = 0;

  /// The bytes of the factor, stored in dense blocks; known before a matrix is factored.
  [[nodiscard]] virtual std::int64_t bytes() const = 0;

  /// Returns L by columns; row i of A is row places()[i] of L.
  [[nodiscard]] virtual sparse_columns lower() const = 0;
  [[nodiscard]] virtual const std::vector<int>& places() const = 0;
};

}  // namespace contct
