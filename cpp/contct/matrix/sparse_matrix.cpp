#include "contct/matrix/sparse_matrix.hpp"

#include <algorithm>
#include <cstdlib>

namespace contct {
namespace {

int place_of(int row, std::span<const int> rows) {
  return rows.empty() ? row : rows[static_cast<std::size_t>(row)];
}

}  // namespace

std::vector<long double> sparse_matrix::times(std::span<const double> x) const {
  std::vector<long double> y(x.size(), 0.0L);
  for (const matrix_entry& e : entries) {
    const auto row = static_cast<std::size_t>(e.row);
    const auto column = static_cast<std::size_t>(e.column);
    y[row] += static_cast<long double>(e.value) * x[column];
    if (row != column) y[column] += static_cast<long double>(e.value) * x[row];
  }
  return y;
}

std::vector<double> sparse_matrix::diagonal() const {
  std::vector<double> d(static_cast<std::size_t>(order), 0.0);
  for (const matrix_entry& e : entries)
    if (e.row == e.column) d[static_cast<std::size_t>(e.row)] = e.value;
  return d;
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

}  // namespace contct
