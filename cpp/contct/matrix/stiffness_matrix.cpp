#include "contct/matrix/stiffness_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace contct {
namespace {

int place_of(int row, std::span<const int> rows) {
  return rows.empty() ? row : rows[row];
}

/// Calls on(column, value) for each diagonal entry and below(row, column, value) for each stored entry below
/// the diagonal, column by column. `Stored`: the variant of the two storages, const or not.
template <class Stored, class On, class Below>
void each_entry(Stored& stored, On on, Below below) {
  if (auto* const band = std::get_if<band_matrix>(&stored)) {
    for (int column = 0; column < band->order(); ++column) {
      on(column, band->at(column, column));
      const int last = std::min(column + band->subdiagonals(), band->order() - 1);
      for (int row = column + 1; row <= last; ++row) below(row, column, band->at(row, column));
    }
  } else {
    auto& k = std::get<sparse_columns>(stored);
    for (int column = 0; column < k.order(); ++column) {
      const int first = k.starts[column];
      on(column, k.values[first]);
      for (int i = first + 1; i < k.starts[column + 1]; ++i) below(k.rows[i], column, k.values[i]);
    }
  }
}

template <class Stored, class Real>
void subtract(const Stored& k, std::span<const Real> x, std::span<long double> r) {
  each_entry(
      k, [&](std::size_t i, double value) { r[i] -= value * static_cast<long double>(x[i]); },
      [&](std::size_t row, std::size_t column, double value) {
        if (value == 0.0) return;  // as most entries in the band of a plate
        r[row] -= value * static_cast<long double>(x[column]);
        r[column] -= value * static_cast<long double>(x[row]);
      });
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

band_matrix band_of(const sparse_matrix& a, std::span<const int> rows) {
  band_matrix band(a.order, subdiagonals_of(a, rows));
  for (const matrix_entry& e : a.entries) band.add(place_of(e.row, rows), place_of(e.column, rows), e.value);
  return band;
}

namespace {

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

sparse_columns columns_of(const sparse_matrix& a) {
  const std::size_t n = a.order;
  constexpr std::size_t most = std::numeric_limits<int>::max();
  if (a.entries.size() + n > most)
    throw std::length_error("a matrix of " + std::to_string(a.entries.size()) +
                            " entries; allowed: at most " + std::to_string(most));
  std::vector<matrix_entry> entries = a.entries;
  std::vector<char> has_diagonal(n, 0);
  for (const matrix_entry& e : entries)
    if (e.row == e.column) has_diagonal[e.row] = 1;
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

double& sparse_columns::at(int row, int column) {
  const auto first = rows.begin() + starts[column];
  const auto last = rows.begin() + starts[column + 1];
  const auto place = std::lower_bound(first, last, row);
  if (place == last || *place != row)
    throw std::out_of_range("no entry at (" + std::to_string(row) + ", " + std::to_string(column) + ")");
  return values[place - rows.begin()];
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
  each_entry(
      stored_, [](std::size_t /*i*/, double /*own*/) {},
      [&](std::size_t row, std::size_t column, double value) {
        if (value == 0.0) return;
        const auto r = static_cast<int>(row);
        const auto c = static_cast<int>(column);
        if (columns[column] != 0) found.push_back({r, c, value});
        if (columns[row] != 0) found.push_back({c, r, value});
      });
  return found;
}

void stiffness_matrix::fix(std::span<const double> pivots) {
  each_entry(
      stored_,
      [pivots](std::size_t i, double& value) {
        if (pivots[i] > 0.0) value = pivots[i];
      },
      [pivots](std::size_t row, std::size_t column, double& value) {
        if (pivots[row] > 0.0 || pivots[column] > 0.0) value = 0.0;
      });
}

void stiffness_matrix::scale(std::span<const double> d) {
  each_entry(
      stored_, [d](std::size_t i, double& value) { value = value * d[i] * d[i]; },  // d * d may overflow
      [d](std::size_t row, std::size_t column, double& value) { value = value * d[row] * d[column]; });
}

void stiffness_matrix::subtract_product(std::span<const double> x, std::span<long double> r) const {
  subtract(stored_, x, r);
}

void stiffness_matrix::subtract_product(std::span<const long double> x, std::span<long double> r) const {
  subtract(stored_, x, r);
}

double stiffness_matrix::one_norm(std::span<const double> diagonal, std::span<const double> d) const {
  std::vector<double> sums(d.size(), 0.0);
  each_entry(
      stored_, [&](std::size_t i, double /*own*/) { sums[i] += std::abs(diagonal[i] * (d[i] * d[i])); },
      [&](std::size_t row, std::size_t column, double value) {
        const double size = std::abs(value * (d[row] * d[column]));
        sums[row] += size;
        sums[column] += size;
      });
  return sums.empty() ? 0.0 : *std::max_element(sums.begin(), sums.end());
}

std::optional<stiffness_matrix> without_zeros(const stiffness_matrix& k) {
  if (!k.is_band()) return std::nullopt;
  const auto entries = k.band().entries();
  if (2 * std::ranges::count(entries, 0.0) <= std::ssize(entries)) return std::nullopt;
  return columns_of(k.band());
}

}  // namespace contct
