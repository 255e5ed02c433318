#include "contct/proof/factors.hpp"

#include <limits>
#include <utility>

namespace contct {
namespace {

constexpr double half_ulp = 0x1p-53;

double_double root_of(const double_double& x) {
  const double near = std::sqrt(x.hi);
  const double_double left = x - exact_product(near, near);
  return renormalized(near, left.hi / (2 * near));
}

/// The sum of l_ik l_jk over the columns k < `end` that rows i and j have in common.
double_double product(const long_band& l, int i, int j, int end) {
  double_double sum;
  for (int k = std::max(l.first(i), l.first(j)); k < end; ++k) sum += l.at(i, k) * l.at(j, k);
  return sum;
}

/// Replaces the first `rows` entries of x by B'^-1 times these entries, where B is the leading block of L
/// with `rows` rows and columns.
void solve_upper(const long_band& l, std::span<double_double> x, int rows) {
  for (int i = rows; i-- > 0;) {
    x[i] = x[i] / l.at(i, i);
    for (int k = l.first(i); k < i; ++k) x[k] -= l.at(i, k) * x[i];
  }
}

/// The row sums of |A| + |L| |L'|.
row_sums magnitudes(const sparse_columns& a, const sparse_columns& l) {
  row_sums sums(l.order(), 0.0);
  for (int column = 0; column < l.order(); ++column) {
    double of_column = 0.0;
    for (int at = l.starts[column]; at < l.starts[column + 1]; ++at) of_column += std::abs(l.values[at]);
    for (int at = l.starts[column]; at < l.starts[column + 1]; ++at)
      sums.add(l.rows[at], l.rows[at], l.values[at] * of_column);
    for (int at = a.starts[column]; at < a.starts[column + 1]; ++at)
      sums.add(a.rows[at], column, a.values[at]);
  }
  return sums;
}

/// The first column of each block, and then the order of L. A block consists of adjacent columns that have
/// the same rows below the diagonal of the block's last column. Most columns of a factor are in large blocks.
std::vector<int> blocks_of(const sparse_columns& l) {
  std::vector<int> firsts;
  for (int column = 0; column < l.order(); ++column) {
    const auto rows = l.rows.begin() + l.starts[column];
    const int size = l.starts[column + 1] - l.starts[column];
    const bool goes_on = column > 0 && l.starts[column] - l.starts[column - 1] == size + 1 &&
                         std::equal(rows, rows + size, l.rows.begin() + l.starts[column - 1] + 1);
    if (!goes_on) firsts.push_back(column);
  }
  firsts.push_back(l.order());
  return firsts;
}

}  // namespace

bool can_be_factored_long(int order, int subdiagonals) {
  constexpr double most_products = 1e8;
  return static_cast<double>(order) * (subdiagonals + 1) * (subdiagonals + 1) <= most_products;
}

bool factor(long_band& a) {
  for (int i = 0; i < a.order(); ++i) {
    for (int j = a.first(i); j < i; ++j) a.at(i, j) = (a.at(i, j) - product(a, i, j, j)) / a.at(j, j);
    const double_double pivot = a.at(i, i) - product(a, i, i, i);
    const bool is_positive = pivot.hi > 0.0 && std::isfinite(pivot.hi);
    a.at(i, i) = is_positive ? root_of(pivot) : pivot;
    if (!is_positive) return false;
  }
  return true;
}

void solve_with(const long_band& l, std::span<double_double> x) {
  for (int i = 0; i < l.order(); ++i) {
    for (int k = l.first(i); k < i; ++k) x[i] -= l.at(i, k) * x[k];
    x[i] = x[i] / l.at(i, i);
  }
  solve_upper(l, x, l.order());
}

/// Returns x with 1 in the row whose pivot is not positive, -B'^-1 l in the rows above, and 0 below. B is the
/// factor of the rows above, and l the entries to the left of the pivot.
std::vector<double_double> doubtful_motion_in(const long_band& failed) {
  std::vector<double_double> x(failed.order());
  int row = 0;
  while (row < failed.order() && failed.at(row, row).hi > 0.0) ++row;
  if (row == failed.order()) return x;
  for (int k = failed.first(row); k < row; ++k) x[k] = -failed.at(row, k);
  solve_upper(failed, x, row);
  x[row] = 1.0;
  return x;
}

double row_sums::largest() const {
  double most = 0.0;
  for (const double sum : sums_) {
    if (!std::isfinite(sum)) return std::numeric_limits<double>::infinity();  // std::max would ignore NaN
    most = std::max(most, sum);
  }
  return most * (1 + 0x1p-30);
}

double largest_row_of_error(const sparse_columns& a, const sparse_columns& l) {
  const int n = l.order();
  row_sums sums(n, 0.0);
  const std::vector<int> firsts = blocks_of(l);
  std::vector<int> next(firsts.size(), 0);  // [block] the number of its rows that are done
  std::vector<std::vector<int>> with(n);    // [row] the blocks whose next row is this row
  for (int block = 0; firsts[block] < n; ++block) with[firsts[block]].push_back(block);
  std::vector<double> difference(n, 0.0);  // one column of A - L L'
  std::vector<int> rows;                   // rows of `difference` that are not 0
  std::vector<double> product;             // the part of one block in a column of L L'
  const auto add = [&](int row, double value) {
    if (difference[row] == 0.0) rows.push_back(row);
    difference[row] += value;
  };
  int most_terms = 0;
  for (int column = 0; column < n; ++column) {
    for (int at = a.starts[column]; at < a.starts[column + 1]; ++at) add(a.rows[at], a.values[at]);
    int terms = 0;
    for (const int block : std::exchange(with[column], {})) {
      const int first = firsts[block];
      const int row = next[block]++;
      const int* const own = &l.rows[l.starts[first]];
      const int height = l.starts[first + 1] - l.starts[first];
      product.assign(height - row, 0.0);
      const int width = std::min(row + 1, firsts[block + 1] - first);  // of the columns that begin above
      const auto from_row = [&](int k) { return &l.values[l.starts[first + k] + row - k]; };
      int k = 0;
      for (; k + 3 < width; k += 4) {  // the sum is read and written once for four columns
        const double* const v0 = from_row(k);
        const double* const v1 = from_row(k + 1);
        const double* const v2 = from_row(k + 2);
        const double* const v3 = from_row(k + 3);
        for (int i = 0; i < height - row; ++i)
          product[i] += (v0[0] * v0[i] + v1[0] * v1[i]) + (v2[0] * v2[i] + v3[0] * v3[i]);
      }
      for (; k < width; ++k)
        for (int i = 0; i < height - row; ++i) product[i] += from_row(k)[0] * from_row(k)[i];
      terms += width;
      for (int i = 0; i < height - row; ++i) add(own[row + i], -product[i]);
      if (next[block] < height) with[own[next[block]]].push_back(block);
    }
    most_terms = std::max(most_terms, terms);
    for (const int row : rows) sums.add(row, column, std::exchange(difference[row], 0.0));
    rows.clear();
  }
  const row_sums sizes = magnitudes(a, l);
  for (int row = 0; row < n; ++row)  // each product is added in `product` and in `difference`
    sums.add(row, row, (most_terms + 4) * half_ulp * sizes.of(row));
  return sums.largest() + 0x1p-900;  // for underflow
}

sparse_columns reordered(const sparse_columns& a, std::span<const int> places) {
  sparse_matrix moved{a.order(), {}};
  each_entry(a, [&moved](int row, int column, double value) {
    moved.entries.push_back({row, column, value});
  });
  return columns_of(moved, places);
}

}  // namespace contct
