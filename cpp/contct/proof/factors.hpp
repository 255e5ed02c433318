// Cholesky factors L of narrow bands in 32 digits, for matrices A that doubles cannot factor, and bounds on
// the error A - L L' of any factor.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <type_traits>
#include <vector>

#include "contct/linear/stiffness_matrix.hpp"
#include "contct/number/double_double.hpp"

namespace contct {

using long_band = band_of_numbers<double_double>;

/// Is a band small enough to be factored in 32 digits in acceptable time?
[[nodiscard]] bool can_be_factored_long(int order, int subdiagonals);

/// Replaces A by L with L L' = A up to rounding. If a pivot is not positive, leaves this pivot on the
/// diagonal, stops and returns false.
[[nodiscard]] bool factor(long_band& a);

/// Replaces x by (L L')^-1 x.
void solve_with(const long_band& l, std::span<double_double> x);

/// `failed`: the result of `factor`. If `factor` returned false, returns a vector x with x' A x <= 0 up to
/// rounding; otherwise zeros.
[[nodiscard]] std::vector<double_double> doubtful_motion_in(const long_band& failed);

/// Sums of the magnitudes in each row of a symmetric matrix, from the entries of one triangle.
class row_sums {
 public:
  row_sums(int order, double at_first) : sums_(order, at_first) {}
  void add(int row, int column, double entry) {
    sums_[row] += std::abs(entry);
    if (row != column) sums_[column] += std::abs(entry);
  }
  [[nodiscard]] double of(int row) const { return sums_[row]; }
  /// An upper bound on the largest sum, and so on the norm of the matrix; infinite if a sum is NaN.
  [[nodiscard]] double largest() const;

 private:
  std::vector<double> sums_;
};

/// An upper bound on the largest row sum of |A - L L'|, and so on the norm of A - L L'. The entries of A are
/// at most 1, with errors of at most `rounding`. Sums are computed in A's kind of number. The magnitudes of
/// the terms of an entry of L L' add up to at most 1.1, because the squares of a row of L add up to an entry
/// on the diagonal of A. The columns of L are subtracted one by one, because each column is contiguous in
/// memory.
template <class Number, class Entry>
[[nodiscard]] double largest_row_of_error(band_of_numbers<Number> a, const band_of_numbers<Entry>& l,
                                          double rounding) {
  constexpr double unit = std::is_same_v<Number, double> ? 0x1p-52 : 0x1p-98;
  const auto product = [](const Entry& x, const Entry& y) -> Number {
    if constexpr (std::is_same_v<Number, Entry>)
      return x * y;
    else
      return exact_product(x, y);
  };
  const int n = a.order();
  const int b = a.subdiagonals();
  for (int k = 0; k < n; ++k) {
    const int end = std::min(k + b + 1, n);
    const Entry* const column = &l.at(k, k);
    for (int i = k; i < end; ++i) {
      Number* const rest = &a.at(i, i);
      for (int j = i; j < end; ++j) rest[j - i] -= product(column[i - k], column[j - k]);
    }
  }
  row_sums sums(n, (2 * b + 1) * (2.0 * (b + 4) * unit + rounding));
  for (int i = 0; i < n; ++i)
    for (int j = a.first(i); j <= i; ++j) sums.add(i, j, double_double(a.at(i, j)).hi);
  return sums.largest();
}

/// The same bound for sparse A and L with their rows in the same order. The rounding of the sums is included,
/// but the entries of A count as exact.
[[nodiscard]] double largest_row_of_error(const sparse_columns& a, const sparse_columns& l);

/// A with its row and column i moved to `places[i]`.
[[nodiscard]] sparse_columns reordered(const sparse_columns& a, std::span<const int> places);

}  // namespace contct
