#include "contct/read/matrix_market.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "contct/read/entry_list.hpp"
#include "contct/text/field_lines.hpp"
#include "contct/text/input_text.hpp"

namespace contct {
namespace {

constexpr std::int64_t most_rows = std::numeric_limits<int>::max() - 1;
constexpr std::int64_t most_entries = std::numeric_limits<int>::max() - 1;
constexpr std::size_t least_bytes_of_entry = 6;  // "1 1 1" and its line's end

bool same_word(std::string_view a, std::string_view lower) {
  return std::equal(a.begin(), a.end(), lower.begin(), lower.end(), [](char x, char y) {
    return (x >= 'A' && x <= 'Z' ? static_cast<char>(x - 'A' + 'a') : x) == y;
  });
}

/// The first line; true where it says "array" and not "coordinate".
bool read_header(field_lines& lines, std::string_view symmetry, bool may_be_array) {
  const std::string allowed = fmt::format("%%MatrixMarket matrix {} real {}",
                                          may_be_array ? "array (or coordinate)" : "coordinate", symmetry);
  if (!lines.next() || lines.line() != 1) lines.refuse("no header", allowed);
  const bool sound = lines.fields() == 5 && same_word(lines.field(0), "%%matrixmarket") &&
                     same_word(lines.field(1), "matrix") && same_word(lines.field(3), "real") &&
                     same_word(lines.field(4), symmetry);
  const bool array = sound && may_be_array && same_word(lines.field(2), "array");
  if (!sound || (!array && !same_word(lines.field(2), "coordinate")))
    lines.refuse(quoted(lines.whole_line()), allowed);
  return array;
}

/// To the line behind the comments: the size.
void go_to_size(field_lines& lines, std::size_t fields, std::string_view allowed) {
  do {
    if (!lines.next()) lines.refuse("the end of the file", allowed);
  } while (lines.field(0).front() == '%');
  lines.expect(fields, allowed);
}

void refuse_count(const field_lines& lines, std::size_t found, std::size_t said, std::int64_t where) {
  lines.refuse(fmt::format("the end of the file after {} of {}", found, said),
               fmt::format("as many as line {} says", where));
}

/// The place of entry (i, j), from 1 in the file.
struct place {
  int row, column;
};

place read_place(const field_lines& lines, int rows, int columns) {
  return {lines.whole(0, 1, rows, "the row") - 1, lines.whole(1, 1, columns, "the column") - 1};
}

std::vector<double> read_array(field_lines& lines, int rows) {
  std::vector<double> values;
  const std::int64_t size_line = lines.line();
  while (lines.next()) {
    lines.expect(1, "one number a line");
    if (values.size() == static_cast<std::size_t>(rows))
      lines.refuse("more numbers than rows", fmt::format("{}, as line {} says", rows, size_line));
    values.push_back(lines.real(0, "a load"));
  }
  if (values.size() < static_cast<std::size_t>(rows))
    refuse_count(lines, values.size(), static_cast<std::size_t>(rows), size_line);
  return values;
}

std::vector<double> read_sparse(field_lines& lines, int rows, int entries) {
  std::vector<double> values(static_cast<std::size_t>(rows), 0.0);
  std::vector<std::int64_t> line_of(values.size(), 0);
  const std::int64_t size_line = lines.line();
  int count = 0;
  while (lines.next()) {
    lines.expect(3, "row, column and value");
    if (count++ == entries)
      lines.refuse("more entries than that", fmt::format("{}, as line {} says", entries, size_line));
    const auto row = static_cast<std::size_t>(read_place(lines, rows, 1).row);
    if (line_of[row] != 0)
      lines.refuse(fmt::format("row {} again, which line {} has", row + 1, line_of[row]), "each row once");
    line_of[row] = lines.line();
    values[row] = lines.real(2, "a load");
  }
  if (count < entries)
    refuse_count(lines, static_cast<std::size_t>(count), static_cast<std::size_t>(entries), size_line);
  return values;
}

}  // namespace

sparse_matrix parse_symmetric(std::string_view text, std::string_view file) {
  field_lines lines(text, file);
  (void)read_header(lines, "symmetric", false);
  go_to_size(lines, 3, "rows, columns and the number of entries");
  const int rows = lines.whole(0, 1, most_rows, "the rows");
  const int columns = lines.whole(1, 1, most_rows, "the columns");
  if (rows != columns) lines.refuse(fmt::format("{} rows and {} columns", rows, columns), "a square matrix");
  const auto said = static_cast<std::size_t>(lines.whole(2, 1, most_entries, "the number of entries"));
  const std::int64_t size_line = lines.line();
  entry_list entries;
  entries.reserve(std::min(said, lines.bytes_left() / least_bytes_of_entry + 1));
  while (lines.next()) {
    lines.expect(3, "row, column and value");
    if (entries.size() == said)
      lines.refuse("more entries than that", fmt::format("{}, as line {} says", said, size_line));
    const auto [row, column] = read_place(lines, rows, rows);
    if (row < column)
      lines.refuse(fmt::format("row {} and column {}, above the diagonal", row + 1, column + 1),
                   "the lower triangle, row >= column: what symmetric means in this format");
    entries.add({row, column, lines.real(2, "an entry")}, lines.line());
  }
  if (entries.size() < said) refuse_count(lines, entries.size(), said, size_line);
  return entries.finish(rows, file);
}

std::vector<double> parse_vector(std::string_view text, std::string_view file, int rows) {
  field_lines lines(text, file);
  const bool array = read_header(lines, "general", true);
  go_to_size(lines, array ? 2 : 3, array ? "rows and columns" : "rows, columns and the number of entries");
  if (lines.whole(0, 1, most_rows, "the rows") != rows)
    lines.refuse(fmt::format("{} rows", lines.field(0)), fmt::format("{}, as the matrix has", rows));
  (void)lines.whole(1, 1, 1, "the columns");
  if (array) return read_array(lines, rows);
  return read_sparse(lines, rows, lines.whole(2, 0, rows, "the number of entries"));
}

sparse_matrix read_symmetric(const std::string& path) {
  return parse_symmetric(read_input(path, "Matrix Market file", largest_matrix_file), path);
}

std::vector<double> read_vector(const std::string& path, int rows) {
  return parse_vector(read_input(path, "Matrix Market file", largest_matrix_file), path, rows);
}

}  // namespace contct
