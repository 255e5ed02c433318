// Some rows of a plate's stiffness, for a process that has no others.
#pragma once

#include <algorithm>
#include <cstddef>

#include "contct/matrix/remote_matrix.hpp"
#include "contct/structure/problem.hpp"

namespace contct::structure {

/// Rows `first` to `first + count`, by dofs, from 0. `stiffness_of(e)` is the matrix [12][12] of element e;
/// elements are added up in the order of their numbers.
template <class Number, class Stiffness>
matrix::full_rows<Number> rows_of(const plate& p, int first, int count, Stiffness&& stiffness_of) {
  constexpr int around = 27;  // dofs of a node and of its neighbours
  matrix::full_rows<Number> all;
  all.first = first;
  if (count == 0) return all;
  const int nodes_across = p.columns();
  const auto place = [&](int row_node, int column_dof) {  // among the 27
    const int node = column_dof / 3;
    const int across = node % nodes_across - row_node % nodes_across + 1;
    const int up = node / nodes_across - row_node / nodes_across + 1;
    return static_cast<std::size_t>((3 * up + across) * 3 + column_dof % 3);
  };
  std::vector<Number> sums(static_cast<std::size_t>(count) * around);
  std::vector<char> there(sums.size(), 0);
  const int lowest = std::max(first / 3 / nodes_across - 1, 0);
  const int highest = std::min((first + count - 1) / 3 / nodes_across, p.rows() - 2);
  for (int e = lowest * (nodes_across - 1); e < (highest + 1) * (nodes_across - 1); ++e) {
    const std::array<int, 12> dofs = p.dofs_of(e);
    const auto is_own = [&](int dof) { return dof >= first && dof < first + count; };
    if (std::ranges::none_of(dofs, is_own)) continue;
    const auto& k = stiffness_of(e);
    for (std::size_t i = 0; i < 12; ++i) {
      if (!is_own(dofs[i])) continue;
      const std::size_t row = static_cast<std::size_t>(dofs[i] - first) * around;
      for (std::size_t j = 0; j < 12; ++j) {
        const std::size_t at = row + place(dofs[i] / 3, dofs[j]);
        sums[at] += k[i][j];
        there[at] = 1;
      }
    }
  }
  for (int row = first; row < first + count; ++row) {
    for (int at = 0; at < around; ++at) {
      const std::size_t entry = static_cast<std::size_t>(row - first) * around + static_cast<std::size_t>(at);
      if (there[entry] == 0) continue;
      const int node = row / 3 + (at / 9 - 1) * nodes_across + at / 3 % 3 - 1;
      all.columns.push_back(3 * node + at % 3);
      all.values.push_back(sums[entry]);
    }
    all.starts.push_back(all.columns.size());
  }
  return all;
}

/// The same in doubles: what `build` assembles, to the bit. Throws std::invalid_argument as that does.
[[nodiscard]] matrix::full_rows<double> stiffness_rows(const plate& p, int first, int count);

}  // namespace contct::structure
