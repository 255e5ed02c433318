// A symmetric matrix without its zeros, column by column.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contct/matrix/band_matrix.hpp"
#include "contct/matrix/sparse_matrix.hpp"

namespace contct {

/// The lower triangle by columns, from 0. Every column begins with its diagonal entry, also where that is 0.
/// Memory: 12 bytes an entry.
struct sparse_columns {
  std::vector<int> starts = {
      0};                 ///< [order + 1] place of each column's diagonal; the last is the number of entries
  std::vector<int> rows;  ///< [entries] ascending within a column
  std::vector<double> values;  ///< [entries]

  [[nodiscard]] int order() const { return static_cast<int>(starts.size()) - 1; }
  [[nodiscard]] double& diagonal(int row) { return values[place_of_diagonal(row)]; }
  [[nodiscard]] double diagonal(int row) const { return values[place_of_diagonal(row)]; }

 private:
  [[nodiscard]] std::size_t place_of_diagonal(int row) const {
    return static_cast<std::size_t>(starts[static_cast<std::size_t>(row)]);
  }
};

/// Throws std::length_error when there are more entries than an int counts.
[[nodiscard]] sparse_columns columns_of(const sparse_matrix& a);

/// The same of a band; zeros in it are left out.
[[nodiscard]] sparse_columns columns_of(const band_matrix& a);

}  // namespace contct
