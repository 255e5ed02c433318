#include "contct/certify/sparse_product.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace contct::certify {
namespace {

using matrix::sparse_columns;

constexpr double half_ulp = 0x1p-53;

/// One column of A - L L' after the other, from the first; each in an array of all rows.
class column_differences {
 public:
  column_differences(const sparse_columns& a, const sparse_columns& l)
      : a_(a),
        l_(l),
        next_(l.starts.begin(), l.starts.end() - 1),
        first_with_(l.order(), none),
        after_(l.order(), none),
        difference_(l.order(), 0.0),
        is_listed_(l.order(), 0) {}

  /// The rows of column i that are not 0; columns come in their order.
  const std::vector<int>& take(int i) {
    listed_.clear();
    for (int at = a_.starts[i]; at < a_.starts[i + 1]; ++at) add(a_.rows[at], a_.values[at]);
    int with_i = std::exchange(first_with_[i], none);
    subtract_column(i, i);
    while (with_i != none) {
      const int column = with_i;
      with_i = after_[column];
      subtract_column(column, i);
    }
    return listed_;
  }
  /// Of the column taken last; it is 0 from then on.
  [[nodiscard]] double difference(int row) {
    is_listed_[row] = 0;
    return std::exchange(difference_[row], 0.0);
  }
  /// The most products that any difference is made of, so far.
  [[nodiscard]] int most_terms() const { return most_terms_; }

 private:
  static constexpr int none = -1;

  void add(int row, double value) {
    if (is_listed_[row] == 0) listed_.push_back(row);
    is_listed_[row] = 1;
    difference_[row] += value;
  }

  /// L_ik times column k, from row i on. The column is met again at its next row.
  void subtract_column(int k, int i) {
    const int at = next_[k];
    for (int below = at; below < l_.starts[k + 1]; ++below)
      add(l_.rows[below], -l_.values[at] * l_.values[below]);
    if (at + 1 < l_.starts[k + 1]) {
      next_[k] = at + 1;
      after_[k] = std::exchange(first_with_[l_.rows[at + 1]], k);
    }
    terms_ = k == i ? 1 : terms_ + 1;
    most_terms_ = std::max(most_terms_, terms_);
  }

  const sparse_columns& a_;
  const sparse_columns& l_;
  std::vector<int> next_;                // the entry of each column of L that is next
  std::vector<int> first_with_, after_;  // lists of columns by the row of that entry
  std::vector<double> difference_;       // [rows]
  std::vector<char> is_listed_;
  std::vector<int> listed_;
  int terms_ = 0, most_terms_ = 0;
};

/// Row sums of |A| + |L| |L'|.
std::vector<double> magnitudes(const sparse_columns& a, const sparse_columns& l) {
  std::vector<double> sums(l.order(), 0.0);
  for (int column = 0; column < l.order(); ++column) {
    double of_column = 0.0;
    for (int at = l.starts[column]; at < l.starts[column + 1]; ++at) of_column += std::abs(l.values[at]);
    for (int at = l.starts[column]; at < l.starts[column + 1]; ++at)
      sums[l.rows[at]] += std::abs(l.values[at]) * of_column;
    for (int at = a.starts[column]; at < a.starts[column + 1]; ++at) {
      sums[a.rows[at]] += std::abs(a.values[at]);
      if (a.rows[at] != column) sums[column] += std::abs(a.values[at]);
    }
  }
  return sums;
}

}  // namespace

double largest_row_of_error_in(const sparse_columns& a, const sparse_columns& l) {
  column_differences product(a, l);
  std::vector<double> sums(l.order(), 0.0);
  for (int column = 0; column < l.order(); ++column) {
    for (const int row : product.take(column)) {
      const double error = std::abs(product.difference(row));
      sums[row] += error;
      if (row != column) sums[column] += error;
    }
  }
  const std::vector<double> sizes = magnitudes(a, l);
  double largest = 0.0;
  for (int row = 0; row < l.order(); ++row) {
    const double sum = sums[row] + (product.most_terms() + 3) * half_ulp * sizes[row];
    if (!std::isfinite(sum)) return std::numeric_limits<double>::infinity();  // std::max would pass NaN over
    largest = std::max(largest, sum);
  }
  return largest * (1 + 0x1p-30) + 0x1p-900;  // of underflow
}

sparse_columns reordered(const sparse_columns& a, std::span<const int> places) {
  matrix::sparse_matrix moved{a.order(), {}};
  for (int column = 0; column < a.order(); ++column)
    for (int at = a.starts[column]; at < a.starts[column + 1]; ++at) {
      const auto [right, below] = std::minmax(places[a.rows[at]], places[column]);
      moved.entries.push_back({below, right, a.values[at]});
    }
  return matrix::columns_of(moved);
}

}  // namespace contct::certify
