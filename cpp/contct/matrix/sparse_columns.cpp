#include "contct/matrix/sparse_columns.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace contct {
namespace {

/// Each column's entries by their rows; the diagonal's is the least of them.
void sort_columns(sparse_columns& a) {
  std::vector<std::pair<int, double>> column;
  for (std::size_t c = 0; c + 1 < a.starts.size(); ++c) {
    const auto first = static_cast<std::size_t>(a.starts[c]);
    const auto last = static_cast<std::size_t>(a.starts[c + 1]);
    column.clear();
    for (std::size_t i = first; i < last; ++i) column.emplace_back(a.rows[i], a.values[i]);
    std::sort(column.begin(), column.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    for (std::size_t i = first; i < last; ++i) std::tie(a.rows[i], a.values[i]) = column[i - first];
  }
}

}  // namespace

sparse_columns columns_of(const sparse_matrix& a) {
  const auto n = static_cast<std::size_t>(a.order);
  if (a.entries.size() + n > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("a matrix of " + std::to_string(a.entries.size()) +
                            " entries; allowed: at most " + std::to_string(std::numeric_limits<int>::max()));
  sparse_columns k;
  k.starts.assign(n + 1, 1);  // a diagonal entry each
  k.starts[0] = 0;
  for (const matrix_entry& e : a.entries)
    if (e.row != e.column) ++k.starts[static_cast<std::size_t>(e.column) + 1];
  std::partial_sum(k.starts.begin(), k.starts.end(), k.starts.begin());
  k.rows.resize(static_cast<std::size_t>(k.starts.back()));
  k.values.assign(k.rows.size(), 0.0);
  for (int row = 0; row < a.order; ++row)
    k.rows[static_cast<std::size_t>(k.starts[static_cast<std::size_t>(row)])] = row;
  std::vector<int> next(k.starts.begin(), k.starts.end() - 1);
  for (const matrix_entry& e : a.entries) {
    const auto column = static_cast<std::size_t>(e.column);
    const auto place = static_cast<std::size_t>(e.row == e.column ? k.starts[column] : ++next[column]);
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

}  // namespace contct
