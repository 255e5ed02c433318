// CHOLMOD's Cholesky factor of a sparse matrix. Builds without CHOLMOD have this header too, but cannot make
// a factor.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

/// The factor of a symmetric positive definite matrix A, with rows ordered for little fill. Rows are numbered
/// as in A, from 0.
class sparse_factor {
 public:
  /// True if CHOLMOD is built in.
  [[nodiscard]] static bool available();

  /// Finds the order of rows by AMD; if there are many rows, by METIS or AMD, whichever is better. Keeps A.
  /// Throws std::bad_alloc, and std::logic_error if CHOLMOD is not built in.
  [[nodiscard]] static std::unique_ptr<sparse_factor> make(sparse_columns a);

  sparse_factor() = default;
  virtual ~sparse_factor() = default;
  sparse_factor(const sparse_factor&) = delete;
  sparse_factor& operator=(const sparse_factor&) = delete;

  /// Bytes of the factor in dense blocks; known before it is computed.
  [[nodiscard]] virtual std::int64_t bytes() const = 0;

  /// Factors A with `diagonal` [order] as its diagonal. False if a pivot is not positive. Throws
  /// std::bad_alloc.
  [[nodiscard]] virtual bool factor(std::span<const double> diagonal) = 0;

  /// A, for changes of off-diagonal entries before the next `factor`. Throws std::logic_error if MPI ranks
  /// share the factor.
  [[nodiscard]] virtual sparse_columns& matrix() {
    throw std::logic_error("this factor's matrix cannot be changed");
  }

  /// Solves A x = b in place, for one or several right-hand sides, one after the other. Throws
  /// std::bad_alloc.
  virtual void solve(std::span<double> b) = 0;

  /// L by columns; row i of A is row places()[i] of L. Afterwards the factor cannot solve any more.
  [[nodiscard]] virtual sparse_columns lower() = 0;
  [[nodiscard]] virtual const std::vector<int>& places() const = 0;

  /// Makes a factor of another matrix with entries at the same positions, in the same order of rows. Throws
  /// as `make` does, and std::logic_error if MPI ranks share this factor.
  [[nodiscard]] virtual std::unique_ptr<sparse_factor> likewise(const sparse_columns& /*a*/) const {
    throw std::logic_error("this factor's order cannot be taken over");
  }

  /// The number of multiplications and additions in a factorisation.
  [[nodiscard]] virtual double flops() const = 0;
};

}  // namespace contct
