// A symmetric matrix in LAPACK's lower band storage.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace contct {

/// Symmetric band matrix of order n with kd subdiagonals. Column j keeps its diagonal and what
/// stands below it, one column after the other; for n = 5, kd = 2 (rows and columns from 0):
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
  [[nodiscard]] double& at(int row, int column) { return entries_[place(row, column)]; }
  [[nodiscard]] double at(int row, int column) const { return entries_[place(row, column)]; }

  /// Add `value` at (row, column) and, by symmetry, at (column, row); any order of the two.
  void add(int row, int column, double value);

  /// y = A x. x and y have n entries and do not overlap.
  void multiply(std::span<const double> x, std::span<double> y) const;

  [[nodiscard]] double* data() { return entries_.data(); }
  [[nodiscard]] const double* data() const { return entries_.data(); }

 private:
  [[nodiscard]] std::size_t place(int row, int column) const {
    return static_cast<std::size_t>(column) * static_cast<std::size_t>(subdiagonals_ + 1) +
           static_cast<std::size_t>(row - column);
  }

  int order_ = 0;
  int subdiagonals_ = 0;
  std::vector<double> entries_;
};

}  // namespace contct
