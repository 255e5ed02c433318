// A block of right-hand sides that go through a factor together: it is read from memory once for all.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

#include "contct/rooms.hpp"

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

}  // namespace contct::matrix
