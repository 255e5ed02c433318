#include "contct/linear/stiffness_matrix.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace contct {
namespace {

int place_of(int row, std::span<const int> rows) {
  return rows.empty() ? row : rows[row];
}

/// Sorts entries by `place`, row or column, in linear time; entries with equal places keep their order.
std::vector<matrix_entry> sorted_by(int matrix_entry::*place, const std::vector<matrix_entry>& all,
                                    std::size_t order) {
  std::vector<std::size_t> next(order + 1);
  for (const matrix_entry& e : all) ++next[e.*place + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<matrix_entry> sorted(all.size());
  for (const matrix_entry& e : all) sorted[next[e.*place]++] = e;
  return sorted;
}

}  // namespace

double sparse_matrix::doubt(std::span<const double> x) const {
  constexpr double summation_slack =
      4 * std::numeric_limits<double>::epsilon() / 2;  // relative to sqrt(k_ii k_jj)
  std::vector<double> root(order);
  for (const matrix_entry& e : entries)
    if (e.row == e.column) root[e.row] = std::sqrt(std::abs(e.value));
  double sum = 0.0;
  for (const matrix_entry& e : entries) {
    const double both = (e.row == e.column ? 1.0 : 2.0) * std::abs(x[e.row]) * std::abs(x[e.column]);
    sum += both * summation_slack * root[e.row] * root[e.column];
  }
  return sum;
}

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

sparse_columns columns_of(const sparse_matrix& a, std::span<const int> rows) {
  const std::size_t n = a.order;
  constexpr std::size_t most = std::numeric_limits<int>::max();
  if (a.entries.size() + n > most)
    throw std::length_error("a matrix of " + std::to_string(a.entries.size()) +
                            " entries; allowed: at most " + std::to_string(most));
  std::vector<matrix_entry> entries;
  entries.reserve(a.entries.size());
  std::vector<char> has_diagonal(n, 0);
  for (const matrix_entry& e : a.entries) {
    const auto [column, row] = std::minmax({place_of(e.row, rows), place_of(e.column, rows)});
    entries.push_back({row, column, e.value});
    if (row == column) has_diagonal[row] = 1;
  }
  for (int row = 0; row < a.order; ++row)
    if (has_diagonal[row] == 0) entries.push_back({row, row, 0.0});
  entries = sorted_by(&matrix_entry::column, sorted_by(&matrix_entry::row, entries, n), n);
  sparse_columns k;
  k.starts.assign(n + 1, 0);
  k.rows.reserve(entries.size());
  k.values.reserve(entries.size());
  for (const matrix_entry& e : entries) {
    ++k.starts[e.column + 1];
    k.rows.push_back(e.row);
    k.values.push_back(e.value);
  }
  std::partial_sum(k.starts.begin(), k.starts.end(), k.starts.begin());
  return k;
}

sparse_columns columns_of(const band_matrix& a) {
  sparse_columns k;
  k.starts.reserve(a.order() + std::size_t{1});
  for (int column = 0; column < a.order(); ++column) {
    const int last = std::min(column + a.subdiagonals(), a.order() - 1);
    for (int row = column; row <= last; ++row) {
      if (row != column && a.at(row, column) == 0.0 && a.subdiagonals() != 3) continue;
      k.rows.push_back(row);
      k.values.push_back(a.at(row, column));
    }
    k.starts.push_back(static_cast<int>(k.rows.size()));
  }
  k.rows.shrink_to_fit();
  k.values.shrink_to_fit();
  return k;
}

void put_in(const sparse_columns& a, band_matrix& band) {
  const int width = band.subdiagonals() + 1;
  double* to = band.data();
  for (int column = 0, first = 0; column < a.order(); first = a.starts[++column], to += width) {
    const bool is_full = a.starts[column + 1] - first == width;
    is_full ? std::copy_n(&a.values[first], width, to) : std::fill_n(to, width, 0.0);
    for (int i = first; i < a.starts[column + 1] && !is_full; ++i) to[a.rows[i] - column] = a.values[i];
  }
}

double& sparse_columns::at(int row, int column) {
  const auto first = rows.begin() + starts[column];
  const auto last = rows.begin() + starts[column + 1];
  const auto place = std::lower_bound(first, last, row);
  if (place == last || *place != row)
    throw std::out_of_range("no entry at (" + std::to_string(row) + ", " + std::to_string(column) + ")");
  return values[place - rows.begin()];
}

stiffness_matrix stiffness_matrix::with(std::span<const spring_at> springs) const {
  stiffness_matrix sum = *this;
  for (const spring_at& s : springs) {
    sum.diagonal(s.row) += s.stiffness;
    if (s.other < 0) continue;
    sum.diagonal(s.other) += s.stiffness;
    sum.at(std::max(s.row, s.other), std::min(s.row, s.other)) -= s.stiffness;
  }
  return sum;
}

std::vector<double> stiffness_matrix::diagonal_with(std::span<const spring_at> springs) const {
  std::vector<double> all(order());
  for (std::size_t row = 0; row < all.size(); ++row) all[row] = diagonal(row);
  for (const spring_at& s : springs) {
    all[s.row] += s.stiffness;
    if (s.other >= 0) all[s.other] += s.stiffness;
  }
  return all;
}

std::vector<matrix_entry> stiffness_matrix::entries_in(std::span<const char> columns) const {
  std::vector<matrix_entry> found;
  each_entry(*this, [&](int row, int column, double value) {
    if (value == 0.0 || row == column) return;
    if (columns[column] != 0) found.push_back({row, column, value});
    if (columns[row] != 0) found.push_back({column, row, value});
  });
  return found;
}

void stiffness_matrix::fix(std::span<const double> pivots) {
  each_entry(*this, [pivots](int row, int column, double& value) {
    if (pivots[row] > 0.0 || pivots[column] > 0.0) value = row == column ? pivots[row] : 0.0;
  });
}

void stiffness_matrix::scale(std::span<const double> d) {
  each_entry(*this, [d](int row, int column, double& value) {
    value = value * d[row] * d[column];  // d * d may overflow
  });
}

double stiffness_matrix::one_norm(std::span<const double> diagonal, std::span<const double> d) const {
  std::vector<double> sums(d.size(), 0.0);
  each_entry(*this, [&](int row, int column, double value) {
    const double size = std::abs((row == column ? diagonal[row] : value) * (d[row] * d[column]));
    sums[row] += size;
    if (row != column) sums[column] += size;
  });
  return sums.empty() ? 0.0 : *std::max_element(sums.begin(), sums.end());
}

}  // namespace contct
