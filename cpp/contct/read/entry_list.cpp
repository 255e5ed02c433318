#include "contct/read/entry_list.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "contct/text/field_lines.hpp"

namespace contct {

/// By columns, and by rows in each: columns are counted first, so that the whole is linear.
void entry_list::sort(int order) {
  std::vector<std::size_t> next(static_cast<std::size_t>(order) + 1, 0);
  for (const read_entry& e : entries_) ++next[static_cast<std::size_t>(e.column) + 1];
  for (std::size_t column = 1; column < next.size(); ++column) next[column] += next[column - 1];
  const std::vector<std::size_t> starts = next;
  std::vector<read_entry> sorted(entries_.size());
  for (const read_entry& e : entries_) sorted[next[static_cast<std::size_t>(e.column)]++] = e;
  for (std::size_t column = 0; column + 1 < starts.size(); ++column) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(starts[column]),
              sorted.begin() + static_cast<std::ptrdiff_t>(starts[column + 1]),
              [](const read_entry& a, const read_entry& b) {
                return a.row != b.row ? a.row < b.row : a.line < b.line;
              });
  }
  entries_ = std::move(sorted);
}

void entry_list::refuse_repeated(std::string_view file) const {
  const auto same = std::adjacent_find(
      entries_.begin(), entries_.end(),
      [](const read_entry& a, const read_entry& b) { return a.row == b.row && a.column == b.column; });
  if (same == entries_.end()) return;
  refuse_line(file, (same + 1)->line,
              fmt::format("the place of row {} and column {} again, which line {} has", same->row + 1,
                          same->column + 1, same->line),
              "each place once: sum what belongs together");
}

sparse_matrix entry_list::finish(int order, std::string_view file) {
  // Before anything of the order's size is made: it is only what a line claims.
  if (static_cast<std::size_t>(order) > entries_.size())
    refuse_line(file, 0, fmt::format("{} rows and {} entries", order, entries_.size()),
                "an entry on the diagonal of every row");
  sort(order);
  refuse_repeated(file);
  sparse_matrix matrix{order, {}};
  std::vector<char> stiff(static_cast<std::size_t>(order), 0);
  for (const read_entry& e : entries_) {
    if (e.row == e.column && e.value < 0)
      refuse_line(file, e.line, fmt::format("{:g} on the diagonal of row {}", e.value, e.row + 1),
                  "0 or more: a stiffness matrix is positive semidefinite");
    if (e.row == e.column && e.value > 0) stiff[static_cast<std::size_t>(e.row)] = 1;
    if (e.value != 0) matrix.entries.push_back({e.row, e.column, e.value});
  }
  for (const read_entry& e : entries_) {
    const int bare = stiff[static_cast<std::size_t>(e.row)] == 0 ? e.row : e.column;
    if (e.value == 0 || stiff[static_cast<std::size_t>(bare)] != 0) continue;
    refuse_line(file, e.line, fmt::format("{:g} in row {}, which has 0 on its diagonal", e.value, bare + 1),
                "a matrix that is positive semidefinite");
  }
  return matrix;
}

}  // namespace contct
