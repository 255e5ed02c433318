// CHOLMOD's Cholesky factor of a sparse matrix. Builds without CHOLMOD cannot make a factor.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

/// The factor of a symmetric positive definite matrix A. The factor orders the rows of A for little fill;
/// diagonals and right-hand sides stay in the order of A.
class sparse_factor {
 public:
  /// True if CHOLMOD is built in.
  [[nodiscard]] static bool available();

  /// Stores `a` as A and orders its rows by AMD; many rows by METIS or AMD, whichever is better. Does not
  /// factor A. Throws std::bad_alloc, and std::logic_error if CHOLMOD is not built in.
  [[nodiscard]] static std::unique_ptr<sparse_factor> make(sparse_columns a);

  sparse_factor() = default;
  virtual ~sparse_factor() = default;
  sparse_factor(const sparse_factor&) = delete;
  sparse_factor& operator=(const sparse_factor&) = delete;

  /// The bytes of the factor, stored in dense blocks; known before A is factored.
  [[nodiscard]] virtual std::int64_t bytes() const = 0;

  /// Factors A with `diagonal` [order] on its diagonal; false if a pivot is not positive. Throws
  /// std::bad_alloc.
  [[nodiscard]] virtual bool factor(std::span<const double> diagonal) = 0;

  /// Returns A, so that the caller can change off-diagonal entries before the next `factor`. Throws
  /// std::logic_error if MPI ranks share the factor.
  [[nodiscard]] virtual sparse_columns& matrix() {
    throw std::logic_error("this factor's matrix cannot be changed");
  }

  /// Solves A x = b in place. `b`: right-hand sides, one after the other. Throws std::bad_alloc.
  virtual void solve(std::span<double> b) = 0;

  /// Returns L by columns; row i of A is row places()[i] of L. Afterwards the factor cannot solve any more.
  [[nodiscard]] virtual sparse_columns lower() = 0;
  [[nodiscard]] virtual const std::vector<int>& places() const = 0;

  /// Makes a factor of `a`, whose entries are at the same positions as those of A, with the same order of
  /// rows. Throws as `make` does, and std::logic_error if MPI ranks share this factor.
  [[nodiscard]] virtual std::unique_ptr<sparse_factor> likewise(const sparse_columns& /*a*/) const {
    throw std::logic_error("this factor's order cannot be taken over");
  }

  /// The number of multiplications and additions in a factorisation.
  [[nodiscard]] virtual double flops() const = 0;
};

}  // namespace contct
