// A block of right-hand sides that go through a Cholesky factor together: it is read from memory once for
// all.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <span>

#include "contct/matrix/stiffness_matrix.hpp"

namespace contct::matrix {

/// How many right-hand sides a block has. Its entries are stored by rows: b[row * block_width + i].
inline constexpr std::size_t block_width = 8;

/// One row of a block, held in as many vector registers as it takes.
struct block_row {
  using lanes = double __attribute__((vector_size(16)));
  std::array<lanes, block_width / 2> part;

  static block_row load(const double* from) {
    block_row r{};
    std::memcpy(r.part.data(), from, sizeof r.part);
    return r;
  }
  void store(double* to) const { std::memcpy(to, part.data(), sizeof part); }
  void add(double entry, const block_row& x) {
    for (std::size_t i = 0; i < part.size(); ++i) part[i] += entry * x.part[i];
  }
  void subtract(double entry, const block_row& x) {
    for (std::size_t i = 0; i < part.size(); ++i) part[i] -= entry * x.part[i];
  }
};

/// row -= entry * x.
inline void subtract_from(double* row, double entry, const block_row& x) {
  block_row r = block_row::load(row);
  r.subtract(entry, x);
  r.store(row);
}

/// row -= a * x, then row -= b * y, with one load and one store.
inline void subtract_from(double* row, double a, const block_row& x, double b, const block_row& y) {
  block_row r = block_row::load(row);
  r.subtract(a, x);
  r.subtract(b, y);
  r.store(row);
}

/// row = (row - sum) / pivot; returns the row.
inline block_row divide(double* row, double pivot, const block_row& sum = {}) {
  block_row r = block_row::load(row);
  for (std::size_t i = 0; i < r.part.size(); ++i) r.part[i] = (r.part[i] - sum.part[i]) / pivot;
  r.store(row);
  return r;
}

/// Solve L L^T x = b in place for one b that is 0 before row `first` (from 0), with L in `factor_of_a` as
/// dpbtrf leaves it. The time goes into reading the factor; the unit vector of a row needs half of it on
/// average in the forward substitution.
void solve_from(const band_matrix& factor_of_a, std::size_t first, std::span<double> b);

/// The same for a block of right-hand sides.
void solve_block_from(const band_matrix& factor_of_a, std::size_t first, std::span<double> b);

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

/// Solve L L^T X = B in place for a block of right-hand sides. The forward
/// substitution skips supernodes whose rows are still zero: with unit vectors these are most.
void solve_block(const supernodes& l, std::span<double> b);

}  // namespace contct::matrix
