// A block of right-hand sides through a sparse Cholesky factor.
#pragma once

#include <cstddef>
#include <span>

#include "contct/rooms.hpp"

namespace contct::matrix {

/// A Cholesky factor L in supernodes: neighbouring columns that have the same rows below them, as one block.
/// Supernode s has columns `columns[s]` to `columns[s + 1]`, not included; its rows are in `rows` from
/// `row_places[s]` to `row_places[s + 1]`, its own columns first, ascending; its entries are in `entries`
/// from `entry_places[s]`, one column of all its rows after the other. Everything from 0.
struct supernodes {
  std::span<const int> columns;       ///< [supernodes + 1]
  std::span<const int> row_places;    ///< [supernodes + 1]
  std::span<const int> entry_places;  ///< [supernodes]
  std::span<const int> rows;
  std::span<const double> entries;

  [[nodiscard]] std::size_t count() const { return columns.size() - 1; }
};

/// Solve L L^T X = B in place for a block of right-hand sides, b[row * block_width + i]. The forward
/// substitution skips supernodes whose rows are still zero: with unit vectors these are most.
void solve_block(const supernodes& l, std::span<double> b);

}  // namespace contct::matrix
