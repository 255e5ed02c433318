#include "contct/matrix/band_solve.hpp"

#include <algorithm>
#include <array>

#include "contct/matrix/several_right_hand_sides.hpp"

namespace contct::matrix {
namespace {

/// A factor's column j: L_jj, L_j+1,j, ... and how many rows it has below the diagonal.
struct column {
  const double* entries;
  std::size_t below;
};

column column_of(const band_matrix& l, std::size_t j) {
  const std::size_t kd = l.subdiagonals();
  const std::size_t n = l.order();
  return {l.data() + j * (kd + 1), std::min(kd, n - 1 - j)};
}

/// L Y = B, two columns at a time: every row below is loaded and stored once for both.
void forward_substitution(const band_matrix& l, std::size_t first, double* b) {
  const std::size_t n = l.order();
  std::size_t j = first;
  for (; j + 1 < n; j += 2) {
    const column one = column_of(l, j);
    const column two = column_of(l, j + 1);
    double* const row_one = b + j * block_width;
    double* const row_two = row_one + block_width;
    const block_row x_one = divide(row_one, one.entries[0]);
    if (one.below > 0) subtract_from(row_two, one.entries[1], x_one);
    const block_row x_two = divide(row_two, two.entries[0]);
    for (std::size_t k = 2; k <= one.below; ++k)
      subtract_from(row_one + k * block_width, one.entries[k], x_one, two.entries[k - 1], x_two);
    for (std::size_t k = std::max<std::size_t>(one.below, 1); k <= two.below; ++k)
      subtract_from(row_two + k * block_width, two.entries[k], x_two);
  }
  if (j < n) divide(b + j * block_width, column_of(l, j).entries[0]);
}

/// L^T X = Y: every row is a sum over its column.
void back_substitution(const band_matrix& l, double* b) {
  for (std::size_t j = l.order(); j-- > 0;) {
    const column c = column_of(l, j);
    double* const row = b + j * block_width;
    block_row sum{};
    for (std::size_t k = 1; k <= c.below; ++k) sum.add(c.entries[k], block_row::load(row + k * block_width));
    divide(row, c.entries[0], sum);
  }
}

/// The sum over a column below its diagonal, in four chains that do not wait for each other.
double sum_below(const column& c, const double* x) {
  std::array<double, 4> sums{};
  std::size_t k = 1;
  for (; k + sums.size() <= c.below + 1; k += sums.size())
    for (std::size_t m = 0; m < sums.size(); ++m) sums[m] += c.entries[k + m] * x[k + m];
  for (; k <= c.below; ++k) sums[0] += c.entries[k] * x[k];
  return sums[0] + sums[1] + sums[2] + sums[3];
}

}  // namespace

void solve_from(const band_matrix& factor_of_a, std::size_t first, std::span<double> b) {
  const std::size_t n = factor_of_a.order();
  for (std::size_t j = first; j < n; ++j) {  // L y = b
    const column c = column_of(factor_of_a, j);
    const double y = b[j] / c.entries[0];
    b[j] = y;
    for (std::size_t k = 1; k <= c.below; ++k) b[j + k] -= c.entries[k] * y;
  }
  for (std::size_t j = n; j-- > 0;) {  // L^T x = y
    const column c = column_of(factor_of_a, j);
    b[j] = (b[j] - sum_below(c, &b[j])) / c.entries[0];
  }
}

void solve_block_from(const band_matrix& factor_of_a, std::size_t first, std::span<double> b) {
  forward_substitution(factor_of_a, first, b.data());
  back_substitution(factor_of_a, b.data());
}

}  // namespace contct::matrix
