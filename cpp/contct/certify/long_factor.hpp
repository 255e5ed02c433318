// Cholesky's factor of a narrow band in numbers of 32 digits, for what doubles cannot factor.
#pragma once

#include <span>
#include <vector>

#include "contct/numeric/double_double.hpp"

namespace contct::certify {

/// The lower triangle of a symmetric band, row by row.
class long_band {
 public:
  long_band(int order, int subdiagonals)
      : order_(order),
        subdiagonals_(subdiagonals),
        entries_(static_cast<std::size_t>(order) * (static_cast<std::size_t>(subdiagonals) + 1)) {}

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] int subdiagonals() const { return subdiagonals_; }
  /// The first column of a row in the band.
  [[nodiscard]] int first(int row) const { return row < subdiagonals_ ? 0 : row - subdiagonals_; }

  /// Entry (row, column), row >= column >= first(row).
  [[nodiscard]] numeric::double_double& at(int row, int column) { return entries_[place(row, column)]; }
  [[nodiscard]] const numeric::double_double& at(int row, int column) const {
    return entries_[place(row, column)];
  }

 private:
  [[nodiscard]] std::size_t place(int row, int column) const {
    return static_cast<std::size_t>(row) * (static_cast<std::size_t>(subdiagonals_) + 1) +
           static_cast<std::size_t>(column - row + subdiagonals_);
  }

  int order_, subdiagonals_;
  std::vector<numeric::double_double> entries_;
};

/// May a band be factored so, by the time that takes?
[[nodiscard]] bool can_be_factored_long(int order, int subdiagonals);

/// A becomes L, with L L' = A but for rounding. False where a pivot is not positive.
[[nodiscard]] bool factor(long_band& a);

/// x becomes (L L')^-1 x.
void solve_with(const long_band& l, std::span<numeric::double_double> x);

/// An upper bound on the largest row sum of |A - L L'|, so on its norm, where the entries of A, at most 1,
/// are off by at most `rounding`.
[[nodiscard]] double largest_row_of_error(const long_band& a, const long_band& l, double rounding);

}  // namespace contct::certify
