// Symmetric matrices without their zeros: by single entries, as other programs write them, and by columns.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contct/matrix/band_matrix.hpp"

namespace contct::matrix {

/// One entry of the lower triangle, row >= column; from 0.
struct matrix_entry {
  int row;
  int column;
  double value;
};

/// Symmetric: each place of the lower triangle at most once, places not named are 0. 16 bytes an entry.
struct sparse_matrix {
  int order = 0;
  std::vector<matrix_entry> entries;

  /// y = A x in long double.
  [[nodiscard]] std::vector<long double> times(std::span<const double> x) const;
};

/// The largest distance of an entry from the diagonal, with row i of the matrix at `rows[i]`; at i where
/// `rows` is empty.
[[nodiscard]] int subdiagonals_of(const sparse_matrix& a, std::span<const int> rows);

/// Bytes of the band that holds it in that order.
[[nodiscard]] std::int64_t bytes_of_band(const sparse_matrix& a, std::span<const int> rows);

/// As a band in that order.
[[nodiscard]] band_matrix band_of(const sparse_matrix& a, std::span<const int> rows);

/// The lower triangle by columns, from 0. Every column begins with its diagonal entry, also where that is 0.
/// Memory: 12 bytes an entry.
struct sparse_columns {
  /// [order + 1] place of each column's diagonal; the last is the number of entries.
  std::vector<int> starts = {0};
  std::vector<int> rows;       ///< [entries] ascending within a column
  std::vector<double> values;  ///< [entries]

  [[nodiscard]] int order() const { return static_cast<int>(starts.size()) - 1; }
  [[nodiscard]] double& diagonal(std::size_t row) { return values[starts[row]]; }
  [[nodiscard]] double diagonal(std::size_t row) const { return values[starts[row]]; }
};

/// Throws std::length_error when there are more entries than an int counts.
[[nodiscard]] sparse_columns columns_of(const sparse_matrix& a);

/// The same of a band; zeros in it are left out.
[[nodiscard]] sparse_columns columns_of(const band_matrix& a);

}  // namespace contct::matrix
