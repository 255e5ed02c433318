#include "contct/read/matrix_entries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/text/decimal.hpp"

namespace contct::read {
namespace {

bool same_word(std::string_view a, std::string_view lower) {
  return std::equal(a.begin(), a.end(), lower.begin(), lower.end(), [](char x, char y) {
    return (x >= 'A' && x <= 'Z' ? static_cast<char>(x - 'A' + 'a') : x) == y;
  });
}

int first_digit(const read_entry& e) {
  return static_cast<int>(std::floor(std::log10(std::abs(e.value))));
}

}  // namespace

bool read_header(field_lines& lines, std::string_view symmetry, bool may_be_array) {
  const std::string allowed = fmt::format("%%MatrixMarket matrix {} real {}",
                                          may_be_array ? "array (or coordinate)" : "coordinate", symmetry);
  if (!lines.next() || lines.line() != 1) lines.refuse("no header", allowed);
  const bool sound = lines.fields() == 5 && same_word(lines.field(0), "%%matrixmarket") &&
                     same_word(lines.field(1), "matrix") && same_word(lines.field(3), "real") &&
                     same_word(lines.field(4), symmetry);
  const bool array = sound && may_be_array && same_word(lines.field(2), "array");
  if (!sound || (!array && !same_word(lines.field(2), "coordinate")))
    lines.refuse(same_word(lines.field(0), "%%matrixmarket") ? in_quotes(lines.here())
                                                             : field_words(lines.here(), "a line"),
                 allowed);
  return array;
}

void go_to_size(field_lines& lines, std::size_t fields, std::string_view allowed) {
  do {
    if (!lines.next()) lines.refuse("the end of the file", allowed);
  } while (lines.field(0).front() == '%');
  lines.expect(fields, allowed);
}

read_entry entry_in(const field_lines& lines, int rows, int columns, std::string_view what, bool fortran) {
  lines.expect(3, "row, column and value");
  return {lines.whole(0, 1, rows, "the row") - 1, lines.whole(1, 1, columns, "the column") - 1,
          lines.real(2, what, fortran), lines.line(),
          last_written_digit(lines.field(2)).value_or(sparse_matrix::exact_entry)};
}

matrix_head parse_matrix_head(std::string_view text, std::string_view file) {
  field_lines lines(text, file);
  (void)read_header(lines, "symmetric", false);
  go_to_size(lines, 3, "rows, columns and the number of entries");
  matrix_head head;
  head.rows = lines.whole(0, 1, most_rows, "the rows");
  const int columns = lines.whole(1, 1, most_rows, "the columns");
  if (head.rows != columns)
    lines.refuse(fmt::format("{} rows and {} columns", head.rows, columns), "a square matrix");
  head.entries = lines.whole(2, 1, most_entries, "the number of entries");
  head.line = lines.line();
  head.begins = text.size() - lines.rest().size();
  return head;
}

read_entry parse_entry(const field_lines& lines, int rows, entry_format format) {
  read_entry e = entry_in(lines, rows, rows, "an entry", format == entry_format::calculix);
  if (format == entry_format::matrix_market) {
    if (e.row < e.column)
      lines.refuse(fmt::format("row {} and column {}, above the diagonal", e.row + 1, e.column + 1),
                   "the lower triangle, row >= column: what symmetric means in this format");
    return e;
  }
  if (e.row > e.column)
    lines.refuse(fmt::format("row {} and column {}, below the diagonal", e.row + 1, e.column + 1),
                 "the upper triangle, row <= column, as CalculiX writes it");
  std::swap(e.row, e.column);
  return e;
}

void sort_entries(std::vector<read_entry>& entries, int first, int count) {
  std::vector<std::size_t> starts(static_cast<std::size_t>(count) + 1, 0);
  for (const read_entry& e : entries) ++starts[static_cast<std::size_t>(e.column - first) + 1];
  for (std::size_t column = 1; column < starts.size(); ++column) starts[column] += starts[column - 1];
  std::vector<std::size_t> next = starts;
  std::vector<read_entry> sorted(entries.size());
  for (const read_entry& e : entries) sorted[next[static_cast<std::size_t>(e.column - first)]++] = e;
  for (std::size_t column = 0; column + 1 < starts.size(); ++column) {
    std::sort(sorted.data() + starts[column], sorted.data() + starts[column + 1],
              [](const read_entry& a, const read_entry& b) {
                return a.row != b.row ? a.row < b.row : a.line < b.line;
              });
  }
  entries = std::move(sorted);
}

void refuse_repeated(std::span<const read_entry> entries, std::string_view file) {
  const auto same = std::adjacent_find(
      entries.begin(), entries.end(),
      [](const read_entry& a, const read_entry& b) { return a.row == b.row && a.column == b.column; });
  if (same == entries.end()) return;
  refuse_line(file, std::next(same)->line,
              fmt::format("the place of row {} and column {} again, which line {} has", same->row + 1,
                          same->column + 1, same->line),
              "each place once: sum what belongs together");
}

void refuse_negative(std::span<const read_entry> entries, std::string_view file) {
  for (const read_entry& e : entries)
    if (e.row == e.column && e.value < 0)
      refuse_line(file, e.line, fmt::format("{:g} on the diagonal of row {}", e.value, e.row + 1),
                  "0 or more: a stiffness matrix is positive semidefinite");
}

void refuse_bare(std::span<const read_entry> entries, std::span<const char> stiff, std::string_view file) {
  for (const read_entry& e : entries) {
    const int bare = stiff[static_cast<std::size_t>(e.row)] == 0 ? e.row : e.column;
    if (e.value == 0 || stiff[static_cast<std::size_t>(bare)] != 0) continue;
    refuse_line(file, e.line, fmt::format("{:g} in row {}, which has 0 on its diagonal", e.value, bare + 1),
                "a matrix that is positive semidefinite");
  }
}

void written_digits::include(const read_entry& e) {
  if (e.value == 0 || e.last_digit == sparse_matrix::exact_entry) return;
  most_digits = std::max(most_digits, first_digit(e) - e.last_digit + 1);
  lowest = std::min(lowest.value_or(e.last_digit), e.last_digit);
  highest = std::max(highest.value_or(e.last_digit), e.last_digit);
}

int written_digits::last_digit_of(const read_entry& e) const {
  if (e.last_digit == sparse_matrix::exact_entry) return e.last_digit;
  return lowest == highest ? *lowest : first_digit(e) - most_digits + 1;
}

}  // namespace contct::read
