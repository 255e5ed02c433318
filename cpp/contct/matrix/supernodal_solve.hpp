// Several right-hand sides at once through a sparse Cholesky factor.
#pragma once

#include <span>

namespace contct {

/// A Cholesky factor L in supernodes: neighbouring columns that have the same rows below them, as one block.
/// Supernode s has columns `columns[s]` to `columns[s + 1]`, not included; its rows stand in `rows` from
/// `row_places[s]` to `row_places[s + 1]`, its own columns first, ascending; its entries stand in `entries`
/// from `entry_places[s]`, one column of all its rows after the other. Everything from 0.
struct supernodes {
  std::span<const int> columns;       ///< [supernodes + 1]
  std::span<const int> row_places;    ///< [supernodes + 1]
  std::span<const int> entry_places;  ///< [supernodes]
  std::span<const int> rows;
  std::span<const double> entries;

  [[nodiscard]] std::size_t count() const { return columns.size() - 1; }
};

/// Solve L L^T X = B in place for `many` right-hand sides: b[row * many + i] for the i-th. On the way down
/// only those supernodes are visited that something has reached: for unit vectors these are few.
void solve_many(const supernodes& l, std::span<double> b);

}  // namespace contct
