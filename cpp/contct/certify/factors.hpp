// Cholesky's factor of a narrow band in numbers of 32 digits, for what doubles cannot factor; and how far
// factors are from what they were made of.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/number/double_double.hpp"

namespace contct {

using long_band = band_of_numbers<double_double>;

/// May a band be factored so, by the time that takes?
[[nodiscard]] bool can_be_factored_long(int order, int subdiagonals);

/// A becomes L, with L L' = A but for rounding. False where a pivot is not positive, which is left in its
/// place.
[[nodiscard]] bool factor(long_band& a);

/// x becomes (L L')^-1 x.
void solve_with(const long_band& l, std::span<double_double> x);

/// Where `factor` returned false: x with x' A x <= 0 but for rounding. Otherwise 0.
[[nodiscard]] std::vector<double_double> suspect_in(const long_band& failed);

/// Sums of magnitudes in the rows of a symmetric matrix of which one triangle is told.
class row_sums {
 public:
  row_sums(int order, double at_first) : sums_(order, at_first) {}
  void add(int row, int column, double entry) {
    sums_[row] += std::abs(entry);
    if (row != column) sums_[column] += std::abs(entry);
  }
  [[nodiscard]] double of(int row) const { return sums_[row]; }
  /// The largest, from above, so a bound on the norm; infinite where one is no number.
  [[nodiscard]] double largest() const;

 private:
  std::vector<double> sums_;
};

/// An upper bound on the largest row sum of |A - L L'|, so on its norm, where the entries of A, at most 1,
/// are off by at most `rounding`.
[[nodiscard]] double largest_row_of_error(const long_band& a, const long_band& l, double rounding);

/// The same of a symmetric A and a lower triangle L by columns, both in the same order. Rounding of the sums
/// is in the bound.
[[nodiscard]] double largest_row_of_error(const sparse_columns& a, const sparse_columns& l);

/// A with row i at `places[i]`.
[[nodiscard]] sparse_columns reordered(const sparse_columns& a, std::span<const int> places);

}  // namespace contct
