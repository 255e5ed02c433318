// Cholesky's factor of a narrow band in numbers of 32 digits, for what doubles cannot factor.
#pragma once

#include <span>

#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/numeric/double_double.hpp"

namespace contct::certify {

using long_band = matrix::band_of_numbers<numeric::double_double>;

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
