#include "contct/matrix/block_solve.hpp"

#include <algorithm>

namespace contct::matrix {
namespace {

/// A band's factor as one block, and the right-hand sides. Rows and columns from 0.
struct band_block {
  const band_matrix& l;
  double* b;

  [[nodiscard]] std::size_t width() const { return l.order(); }
  /// L_ij is column(j)[i], for rows i from j to end(j), not included.
  [[nodiscard]] const double* column(std::size_t j) const { return l.data() + j * l.subdiagonals(); }
  [[nodiscard]] std::size_t end(std::size_t j) const {
    return std::min<std::size_t>(j + l.subdiagonals() + 1, l.order());
  }
  /// The right-hand sides' row that belongs to row i.
  [[nodiscard]] double* row(std::size_t i) const { return b + i * block_width; }
};

/// The same of a supernode, all of whose columns end with its last row.
struct supernode_block {
  supernode_block(const supernodes& l, std::size_t s, double* right_hand_sides)
      : rows(&l.rows[l.row_places[s]]),
        entries(&l.entries[l.entry_places[s]]),
        height(l.row_places[s + 1] - l.row_places[s]),
        columns(l.columns[s + 1] - l.columns[s]),
        b(right_hand_sides) {}

  [[nodiscard]] std::size_t width() const { return columns; }
  [[nodiscard]] const double* column(std::size_t j) const { return entries + j * height; }
  [[nodiscard]] std::size_t end(std::size_t /*j*/) const { return height; }
  [[nodiscard]] double* row(std::size_t i) const { return b + rows[i] * block_width; }
  [[nodiscard]] bool is_zero() const {
    return std::all_of(row(0), row(0) + columns * block_width, [](double x) { return x == 0.0; });
  }

  const int* rows;
  const double* entries;
  std::size_t height, columns;
  double* b;
};

/// L Y = B from column `j` on, two columns at a time: every row below is loaded and stored once for both.
template <class Block>
void forward_substitution(const Block& l, std::size_t j) {
  for (; j + 1 < l.width(); j += 2) {
    const double* const one = l.column(j);
    const double* const two = l.column(j + 1);
    const std::size_t end_of_one = l.end(j);
    const std::size_t end_of_two = l.end(j + 1);
    const block_row x_one = divide(l.row(j), one[j]);
    if (j + 1 < end_of_one) subtract_from(l.row(j + 1), one[j + 1], x_one);
    const block_row x_two = divide(l.row(j + 1), two[j + 1]);
    std::size_t i = j + 2;
    for (; i < end_of_one; ++i) subtract_from(l.row(i), one[i], x_one, two[i], x_two);
    for (; i < end_of_two; ++i) subtract_from(l.row(i), two[i], x_two);
  }
  if (j == l.width()) return;
  const double* const last = l.column(j);
  const block_row x = divide(l.row(j), last[j]);
  for (std::size_t i = j + 1; i < l.end(j); ++i) subtract_from(l.row(i), last[i], x);
}

/// L^T X = Y: every row is a sum over its column.
template <class Block>
void back_substitution(const Block& l) {
  for (std::size_t j = l.width(); j-- > 0;) {
    const double* const column = l.column(j);
    block_row sum{};
    for (std::size_t i = j + 1; i < l.end(j); ++i) sum.add(column[i], block_row::load(l.row(i)));
    divide(l.row(j), column[j], sum);
  }
}

/// The sum over a column's rows from `i` to `end`, in four chains that do not wait for each other.
double sum_of_products(const double* column, const double* x, std::size_t i, std::size_t end) {
  std::array<double, 4> sums{};
  for (; i + sums.size() <= end; i += sums.size())
    for (std::size_t m = 0; m < sums.size(); ++m) sums[m] += column[i + m] * x[i + m];
  for (; i < end; ++i) sums[0] += column[i] * x[i];
  return sums[0] + sums[1] + sums[2] + sums[3];
}

}  // namespace

void solve_from(const band_matrix& factor_of_a, std::size_t first, std::span<double> b) {
  const band_block l{factor_of_a, b.data()};
  for (std::size_t j = first; j < l.width(); ++j) {  // L y = b
    const double* const column = l.column(j);
    const double y = b[j] / column[j];
    b[j] = y;
    for (std::size_t i = j + 1; i < l.end(j); ++i) b[i] -= column[i] * y;
  }
  for (std::size_t j = l.width(); j-- > 0;) {  // L^T x = y
    const double* const column = l.column(j);
    b[j] = (b[j] - sum_of_products(column, b.data(), j + 1, l.end(j))) / column[j];
  }
}

void solve_block_from(const band_matrix& factor_of_a, std::size_t first, std::span<double> b) {
  const band_block l{factor_of_a, b.data()};
  forward_substitution(l, first);
  back_substitution(l);
}

void solve_block(const supernodes& l, std::span<double> b) {
  for (std::size_t s = 0; s < l.count(); ++s) {
    const supernode_block of_s(l, s, b.data());
    if (!of_s.is_zero()) forward_substitution(of_s, 0);
  }
  for (std::size_t s = l.count(); s-- > 0;) back_substitution(supernode_block(l, s, b.data()));
}

}  // namespace contct::matrix
