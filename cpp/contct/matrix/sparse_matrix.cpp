#include "contct/matrix/sparse_matrix.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace contct::matrix {
namespace {

int place_of(int row, std::span<const int> rows) {
  return rows.empty() ? row : rows[row];
}

/// Each column's entries by their rows: the diagonal's becomes the first.
void sort_columns(sparse_columns& a) {
  std::vector<std::pair<int, double>> column;
  for (std::size_t c = 0; c + 1 < a.starts.size(); ++c) {
    const int first = a.starts[c];
    const int last = a.starts[c + 1];
    column.clear();
    for (int i = first; i < last; ++i) column.emplace_back(a.rows[i], a.values[i]);
    std::sort(column.begin(), column.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    for (int i = first; i < last; ++i) std::tie(a.rows[i], a.values[i]) = column[i - first];
  }
}

}  // namespace

std::vector<long double> sparse_matrix::times(std::span<const double> x) const {
  std::vector<long double> y(x.size(), 0.0L);
  for (const auto& [row, column, value] : entries) {
    y[row] += static_cast<long double>(value) * x[column];
    if (row != column) y[column] += static_cast<long double>(value) * x[row];
  }
  return y;
}

int subdiagonals_of(const sparse_matrix& a, std::span<const int> rows) {
  int widest = 0;
  for (const matrix_entry& e : a.entries)
    widest = std::max(widest, std::abs(place_of(e.row, rows) - place_of(e.column, rows)));
  return widest;
}

std::int64_t bytes_of_band(const sparse_matrix& a, std::span<const int> rows) {
  return std::int64_t{8} * a.order * (subdiagonals_of(a, rows) + 1);
}

band_matrix band_of(const sparse_matrix& a, std::span<const int> rows) {
  band_matrix band(a.order, subdiagonals_of(a, rows));
  for (const matrix_entry& e : a.entries) band.add(place_of(e.row, rows), place_of(e.column, rows), e.value);
  return band;
}

sparse_columns columns_of(const sparse_matrix& a) {
  const std::size_t n = a.order;
  constexpr std::size_t most = std::numeric_limits<int>::max();
  if (a.entries.size() + n > most)
    throw std::length_error("a matrix of " + std::to_string(a.entries.size()) +
                            " entries; allowed: at most " + std::to_string(most));
  sparse_columns k;
  k.starts.assign(n + 1, 1);  // a diagonal entry each
  k.starts[0] = 0;
  for (const matrix_entry& e : a.entries)
    if (e.row != e.column) ++k.starts[e.column + 1];
  std::partial_sum(k.starts.begin(), k.starts.end(), k.starts.begin());
  k.rows.resize(k.starts.back());
  k.values.assign(k.rows.size(), 0.0);
  for (int row = 0; row < a.order; ++row) k.rows[k.starts[row]] = row;
  std::vector<int> next(k.starts.begin(), k.starts.end() - 1);
  for (const matrix_entry& e : a.entries) {
    const int place = e.row == e.column ? k.starts[e.column] : ++next[e.column];
    k.rows[place] = e.row;
    k.values[place] = e.value;
  }
  sort_columns(k);
  return k;
}

sparse_columns columns_of(const band_matrix& a) {
  sparse_columns k;
  for (int column = 0; column < a.order(); ++column) {
    const int last = std::min(column + a.subdiagonals(), a.order() - 1);
    for (int row = column; row <= last; ++row) {
      if (row != column && a.at(row, column) == 0.0) continue;
      k.rows.push_back(row);
      k.values.push_back(a.at(row, column));
    }
    k.starts.push_back(static_cast<int>(k.rows.size()));
  }
  return k;
}

}  // namespace contct::matrix
