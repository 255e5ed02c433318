// A symmetric matrix by its entries, as other programs hand it over.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "contct/matrix/band_matrix.hpp"

namespace contct {

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

  [[nodiscard]] std::vector<double> diagonal() const;
};

/// The largest distance of an entry from the diagonal, with row i of the matrix at `rows[i]`; at i where
/// `rows` is empty.
[[nodiscard]] int subdiagonals_of(const sparse_matrix& a, std::span<const int> rows);

/// Bytes of the band that holds it in that order.
[[nodiscard]] std::int64_t bytes_of_band(const sparse_matrix& a, std::span<const int> rows);

/// As a band in that order.
[[nodiscard]] band_matrix band_of(const sparse_matrix& a, std::span<const int> rows);

}  // namespace contct
