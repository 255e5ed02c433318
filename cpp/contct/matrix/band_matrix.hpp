// A symmetric matrix in LAPACK's lower band storage.
#pragma once

#include <cstddef>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::matrix {

/// Symmetric band matrix of order n with kd subdiagonals. Column j has its diagonal entry and
/// those below it, one column after the other; for n = 5, kd = 2 (rows and columns from 0):
///
///     a00                              column 0: a00 a10 a20
///     a10 a11                          column 1: a11 a21 a31
///     a20 a21 a22                      column 2: a22 a32 a42
///         a31 a32 a33                  column 3: a33 a43  *
///             a42 a43 a44              column 4: a44  *   *
///
/// The places marked * exist and are never read. Memory: 8 (kd + 1) bytes a row.
class band_matrix {
 public:
  band_matrix() = default;
  band_matrix(int order, int subdiagonals);

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] int subdiagonals() const { return subdiagonals_; }

  /// Entry (row, column), row >= column, row - column <= kd.
  [[nodiscard]] double& at(std::size_t row, std::size_t column) { return entries_[place(row, column)]; }
  [[nodiscard]] double at(std::size_t row, std::size_t column) const { return entries_[place(row, column)]; }

  /// Add `value` at (row, column) and, by symmetry, at (column, row); any order of the two.
  void add(std::size_t row, std::size_t column, double value);

  [[nodiscard]] double* data() { return entries_.data(); }
  [[nodiscard]] const double* data() const { return entries_.data(); }

 private:
  [[nodiscard]] std::size_t place(std::size_t row, std::size_t column) const {
    return column * (subdiagonals_ + 1) + (row - column);
  }

  int order_ = 0;
  int subdiagonals_ = 0;
  std::vector<double> entries_;
};

}  // namespace contct::matrix
