#include "contct/matrix/band_solve.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "contct/matrix/several_right_hand_sides.hpp"

namespace contct {
namespace {

/// A factor's column j: L_jj, L_j+1,j, ... and how many rows it has below the diagonal.
struct column {
  const double* entries;
  std::size_t below;
};

column column_of(const band_matrix& l, std::size_t j) {
  const auto kd = static_cast<std::size_t>(l.subdiagonals());
  const auto n = static_cast<std::size_t>(l.order());
  return {l.data() + j * (kd + 1), std::min(kd, n - 1 - j)};
}

/// L Y = B.
void go_down(const band_matrix& l, std::size_t first, double* b) {
  const auto n = static_cast<std::size_t>(l.order());
  // Two columns at a time: every row below is loaded and stored once for both.
  std::size_t j = first;
  for (; j + 1 < n; j += 2) {
    const column one = column_of(l, j);
    const column two = column_of(l, j + 1);
    double* const x = b + j * side_by_side;
    rows_side_by_side x_one = rows_side_by_side::load(x);
    rows_side_by_side x_two = rows_side_by_side::load(x + side_by_side);
    x_one.divide(one.entries[0]);
    x_one.store(x);
    if (one.below > 0) x_two.subtract(one.entries[1], x_one);
    x_two.divide(two.entries[0]);
    x_two.store(x + side_by_side);
    for (std::size_t k = 2; k <= one.below; ++k) {
      rows_side_by_side row = rows_side_by_side::load(x + k * side_by_side);
      row.subtract(one.entries[k], x_one);
      row.subtract(two.entries[k - 1], x_two);
      row.store(x + k * side_by_side);
    }
    for (std::size_t k = std::max<std::size_t>(one.below, 1); k <= two.below; ++k) {
      rows_side_by_side row = rows_side_by_side::load(x + (k + 1) * side_by_side);
      row.subtract(two.entries[k], x_two);
      row.store(x + (k + 1) * side_by_side);
    }
  }
  if (j < n) {
    rows_side_by_side last = rows_side_by_side::load(b + j * side_by_side);
    last.divide(column_of(l, j).entries[0]);
    last.store(b + j * side_by_side);
  }
}

/// L^T X = Y, upwards: every row is a sum over its column.
void go_up(const band_matrix& l, double* b) {
  for (auto j = static_cast<std::size_t>(l.order()); j-- > 0;) {
    const column c = column_of(l, j);
    double* const x = b + j * side_by_side;
    rows_side_by_side sum{};
    for (std::size_t k = 1; k <= c.below; ++k)
      sum.add(c.entries[k], rows_side_by_side::load(x + k * side_by_side));
    rows_side_by_side row = rows_side_by_side::load(x);
    row.subtract(sum);
    row.divide(c.entries[0]);
    row.store(x);
  }
}

/// The sum over a column below its diagonal, in chains that do not wait for each other.
double sum_below(const column& c, const double* x) {
  std::array<double, 4> sums{};
  std::size_t k = 1;
  for (; k + sums.size() <= c.below + 1; k += sums.size())
    for (std::size_t m = 0; m < sums.size(); ++m) sums[m] += c.entries[k + m] * x[k + m];
  for (; k <= c.below; ++k) sums[0] += c.entries[k] * x[k];
  return sums[0] + sums[1] + sums[2] + sums[3];
}

}  // namespace

void solve_from(const band_matrix& factor_of_a, int first, std::span<double> b) {
  const auto n = static_cast<std::size_t>(factor_of_a.order());
  for (auto j = static_cast<std::size_t>(first); j < n; ++j) {  // L y = b
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

void solve_many_from(const band_matrix& factor_of_a, int first, std::span<double> b) {
  go_down(factor_of_a, static_cast<std::size_t>(first), b.data());
  go_up(factor_of_a, b.data());
}

}  // namespace contct
