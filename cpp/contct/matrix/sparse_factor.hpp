// CHOLMOD's Cholesky factor of a sparse matrix. Every build has this header; builds without CHOLMOD refuse to
// make one.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"

namespace contct {

/// The factor of a symmetric positive definite matrix A, in an order of little fill. Rows are A's, from 0.
class sparse_factor {
 public:
  /// Is CHOLMOD built in?
  [[nodiscard]] static bool available();

  /// Find the order, AMD's or, if there are many rows, METIS's if that is better, and keep A. Throws
  /// std::bad_alloc, and std::logic_error if CHOLMOD is not built in.
  [[nodiscard]] static std::unique_ptr<sparse_factor> make(sparse_columns a);

  sparse_factor() = default;
  virtual ~sparse_factor() = default;
  sparse_factor(const sparse_factor&) = delete;
  sparse_factor& operator=(const sparse_factor&) = delete;

  /// Bytes that the factor takes, in dense blocks; known before it is made.
  [[nodiscard]] virtual std::int64_t bytes() const = 0;

  /// Factor A with `diagonal` [order] for its own. False when a pivot is not positive. Throws std::bad_alloc.
  [[nodiscard]] virtual bool factor(std::span<const double> diagonal) = 0;

  /// A, to change off-diagonal entries for the next factor. Throws std::logic_error if it is shared.
  [[nodiscard]] virtual sparse_columns& matrix() {
    throw std::logic_error("this factor's matrix cannot be changed");
  }

  /// Solve A x = b in place, for one right-hand side or several, one after the other. Throws std::bad_alloc.
  virtual void solve(std::span<double> b) = 0;

  /// L by columns; row i of A is its row places()[i]. This uses the factor up: nothing may be solved by it
  /// any more.
  [[nodiscard]] virtual sparse_columns lower() = 0;
  [[nodiscard]] virtual const std::vector<int>& places() const = 0;

  /// One of another matrix with entries in the same places, in this one's order. Throws as make does, and
  /// std::logic_error where others hold A.
  [[nodiscard]] virtual std::unique_ptr<sparse_factor> likewise(const sparse_columns& /*a*/) const {
    throw std::logic_error("this factor's order cannot be taken over");
  }

  /// Products and sums that a factorisation takes.
  [[nodiscard]] virtual double flops() const = 0;
};

}  // namespace contct
