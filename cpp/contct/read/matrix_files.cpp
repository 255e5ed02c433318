#include "contct/read/matrix_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "contct/number/decimal.hpp"
#include "contct/text/input_text.hpp"

namespace contct {
namespace {

constexpr std::int64_t most_rows = std::numeric_limits<int>::max() - 1;
constexpr std::int64_t most_entries = most_rows;

/// An entry of the lower triangle, row >= column, both from 0, and its line in the file.
struct read_entry {
  int row, column;
  double value;
  std::int64_t line;
};

/// True for a line that looks like a header, which a message may quote. Any other line may contain text that
/// a message must not reveal.
bool is_like_header(std::string_view line) {
  return line.front() == '%' || lower_case(line).find("market") != std::string::npos;
}

constexpr std::size_t least_bytes_of_entry = 6;  // "1 1 1" and a line end

/// Reads lines with numbers, and counts the numbers that do not stand for their double. `warn`
/// adds one warning, with the first such number and the count.
class number_lines : public field_lines {
 public:
  using field_lines::field_lines;

  double number(std::size_t i, std::string_view what, bool fortran = false) {
    const double value = real(i, what, fortran);
    if (!stands_for(field(i), value) && rounded_++ == 0)
      first_ = fmt::format("{}:{}: {}", printable(file(), std::string::npos), line(),
                           rounding_words(printable(field(i)), value));
    return value;
  }

  void warn(std::vector<std::string>* warnings) const {
    if (rounded_ == 0 || warnings == nullptr) return;
    warnings->push_back(rounded_ == 1 ? first_
                                      : fmt::format("{} (the first of {} such numbers)", first_, rounded_));
  }

 private:
  std::int64_t rounded_ = 0;
  std::string first_;
};

/// Reads the first line, in any case: "%%MatrixMarket matrix coordinate real" and `symmetry`; then goes to
/// the line with the size, after the comments. True if the first line has "array" instead of "coordinate".
bool read_header(field_lines& lines, std::string_view symmetry, bool may_be_array) {
  const std::string allowed = fmt::format("%%MatrixMarket matrix {} real {}",
                                          may_be_array ? "array (or coordinate)" : "coordinate", symmetry);
  constexpr const char* way_out =
      ". Python writes it by scipy.io.mmwrite(FILE, scipy.sparse.coo_matrix(A), symmetry=\"symmetric\")";
  if (!lines.next() || lines.line() != 1) lines.refuse("no header", allowed);
  const auto has = [&lines](std::size_t i, std::string_view word) {
    return lines.fields() == 5 && lower_case(lines.field(i)) == word;
  };
  const bool sound = has(0, "%%matrixmarket") && has(1, "matrix") && has(3, "real") && has(4, symmetry);
  const bool array = sound && may_be_array && has(2, "array");
  if (!sound || (!array && !has(2, "coordinate")))
    lines.refuse(is_like_header(lines.here()) ? in_quotes(lines.here()) : field_words(lines.here(), "a line"),
                 allowed + (may_be_array ? "" : way_out));
  const char* const size = array ? "rows and columns" : "rows, columns and the number of entries";
  do {
    if (!lines.next()) lines.refuse("the end of the file", size);
  } while (lines.field(0).front() == '%');
  lines.expect(array ? 2 : 3, size);
  return array;
}

/// Reads a line "row column value". Rows and columns are from 1 in the file, from 0 in the result. `what`
/// describes the value in messages.
read_entry entry_in(number_lines& lines, int rows, int columns, std::string_view what, bool fortran = false) {
  lines.expect(3, "row, column and value");
  return {lines.whole(0, 1, rows, "the row") - 1, lines.whole(1, 1, columns, "the column") - 1,
          lines.number(2, what, fortran), lines.line()};
}

/// Reads an entry of the lower triangle of a stiffness matrix; or of the upper triangle, as CalculiX writes
/// it, and returns it in the lower triangle.
read_entry entry_of_triangle(number_lines& lines, int rows, bool is_upper) {
  read_entry e = entry_in(lines, rows, rows, "an entry", is_upper);
  if (is_upper) std::swap(e.row, e.column);
  if (e.row < e.column)
    lines.refuse(is_upper ? fmt::format("row {} and column {}, below the diagonal", e.column + 1, e.row + 1)
                          : fmt::format("row {} and column {}, above the diagonal", e.row + 1, e.column + 1),
                 is_upper ? "the upper triangle, row <= column, as CalculiX writes it"
                          : "the lower triangle, row >= column, as \"symmetric\" requires in this format");
  return e;
}

void refuse_repeated(std::span<const read_entry> entries, std::string_view file) {
  const auto same =
      std::ranges::adjacent_find(entries, {}, [](const read_entry& e) { return std::pair(e.row, e.column); });
  if (same == entries.end()) return;
  refuse_line(file, std::next(same)->line,
              fmt::format("row {} and column {} a second time, after line {}", same->row + 1,
                          same->column + 1, same->line),
              "each row and column once: write the sum of the entries");
}

/// Refuses a negative diagonal entry, and an entry in a row or column whose diagonal entry is 0.
void refuse_indefinite(std::span<const read_entry> entries, int order, std::string_view file) {
  std::vector<char> stiff(order, 0);
  for (const read_entry& e : entries) {
    if (e.row != e.column) continue;
    if (e.value < 0)
      refuse_line(file, e.line, fmt::format("{:g} on the diagonal of row {}", e.value, e.row + 1),
                  "0 or more: a stiffness matrix is positive semidefinite");
    stiff[e.row] = e.value != 0 ? 1 : 0;
  }
  for (const read_entry& e : entries) {
    const int bare = stiff[e.row] == 0 ? e.row : e.column;
    if (e.value == 0 || stiff[bare] != 0) continue;
    refuse_line(file, e.line, fmt::format("{:g} in row {}, whose diagonal entry is 0", e.value, bare + 1),
                "a matrix that is positive semidefinite");
  }
}

/// Makes the matrix, without entries that are 0. Linear in the entries, except for sorting.
sparse_matrix matrix_of(std::vector<read_entry> entries, int order, std::string_view file) {
  // The file only declares the order, so the order is checked before memory of this size is allocated.
  if (order > static_cast<std::int64_t>(entries.size()))
    refuse_line(file, 0, fmt::format("{} rows and {} entries", order, entries.size()),
                "an entry on the diagonal of every row");
  std::ranges::sort(entries, {}, [](const read_entry& e) { return std::tuple(e.column, e.row, e.line); });
  refuse_repeated(entries, file);
  refuse_indefinite(entries, order, file);
  sparse_matrix matrix{order, {}, entries.size()};
  for (const read_entry& e : entries)
    if (e.value != 0) matrix.entries.push_back({e.row, e.column, e.value});
  return matrix;
}

/// Calls read(i) for each line i, from 0, after the line with the size, which declares `said` such lines.
template <class Read>
void read_lines(field_lines& lines, int said, std::string_view kind, const Read& read) {
  const std::int64_t size_line = lines.line();
  int count = 0;
  for (; lines.next(); ++count) {
    if (lines.field(0).front() == '%') lines.refuse("a comment", "comments between the header and the size");
    if (count == said)
      lines.refuse(fmt::format("more than {} {}", said, kind),
                   fmt::format("{}, as line {} declares", said, size_line));
    read(count);
  }
  if (count < said)
    lines.refuse(fmt::format("the end of the file after {} of {} entries", count, said),
                 fmt::format("{} entries, as line {} declares", said, size_line));
}

/// The line of the file in which each name occurs.
using line_numbers = std::unordered_map<std::string_view, std::int64_t>;

/// Refuses `name` if an earlier line has it; otherwise adds it to `line_of`.
void refuse_again(const field_lines& lines, std::string_view what, std::string_view name,
                  line_numbers& line_of) {
  const auto [before, is_new] = line_of.try_emplace(name, lines.line());
  if (!is_new)
    lines.refuse(fmt::format("the {} of line {} a second time", what, before->second),
                 fmt::format("each {} once", what));
}

/// The number of fields before a comment, which begins with #.
std::size_t fields_before_comment(const field_lines& lines) {
  std::size_t count = 0;
  while (count < lines.fields() && lines.field(count).front() != '#') ++count;
  return count;
}

}  // namespace

sparse_matrix parse_symmetric(std::string_view text, std::string_view file,
                              std::vector<std::string>* warnings) {
  number_lines lines(text, file);
  (void)read_header(lines, "symmetric", false);
  const int rows = lines.whole(0, 1, most_rows, "the rows");
  const int columns = lines.whole(1, 1, most_rows, "the columns");
  if (rows != columns) lines.refuse(fmt::format("{} rows and {} columns", rows, columns), "a square matrix");
  const int count = lines.whole(2, 1, most_entries, "the number of entries");
  std::vector<read_entry> entries;
  // The declared entry count alone is not used to allocate memory.
  entries.reserve(std::min<std::size_t>(count, lines.rest().size() / least_bytes_of_entry + 1));
  read_lines(lines, count, "entries", [&](int) { entries.push_back(entry_of_triangle(lines, rows, false)); });
  lines.warn(warnings);
  return matrix_of(std::move(entries), rows, file);
}

sparse_matrix parse_calculix_stiffness(std::string_view text, std::string_view file, int rows,
                                       std::vector<std::string>* warnings) {
  number_lines lines(text, file);
  std::vector<read_entry> entries;
  while (lines.next()) entries.push_back(entry_of_triangle(lines, rows, true));
  lines.warn(warnings);
  return matrix_of(std::move(entries), rows, file);
}

std::vector<double> parse_vector(std::string_view text, std::string_view file, int rows,
                                 std::vector<std::string>* warnings) {
  number_lines lines(text, file);
  const bool array = read_header(lines, "general", true);
  if (lines.whole(0, 1, most_rows, "the rows") != rows)
    lines.refuse(fmt::format("{} rows", lines.field(0)), fmt::format("{}, as in the matrix", rows));
  (void)lines.whole(1, 1, 1, "the columns");
  const int count = array ? rows : lines.whole(2, 0, rows, "the number of entries");
  std::vector<double> values(rows, 0.0);
  std::vector<std::int64_t> line_of(rows, 0);
  read_lines(lines, count, array ? "numbers" : "entries", [&](int row) {
    if (array) lines.expect(1, "one number a line");
    const read_entry e = array ? read_entry{row, 0, lines.number(0, "a load"), lines.line()}
                               : entry_in(lines, rows, 1, "a load");
    if (line_of[e.row] != 0)
      lines.refuse(fmt::format("row {} a second time, after line {}", e.row + 1, line_of[e.row]),
                   "each row once");
    line_of[e.row] = e.line;
    values[e.row] = e.value;
  });
  lines.warn(warnings);
  return values;
}

std::vector<std::string> parse_labels(std::string_view text, std::string_view file) {
  constexpr std::size_t longest = 100;
  field_lines lines(text, file);
  std::vector<std::string> labels;
  line_numbers line_of;  // views of `text`, because `labels` reallocates
  while (lines.next()) {
    lines.expect(1, "one label a line, without blanks");
    const std::string_view label = lines.field(0);
    if (label.size() > longest)
      lines.refuse(field_words(label), fmt::format("a label of at most {} bytes", longest));
    refuse_again(lines, "label", label, line_of);
    labels.emplace_back(label);
  }
  if (labels.empty()) refuse_line(file, 0, "no label", "one label a line");
  return labels;
}

std::vector<placed_node> parse_coordinates(std::string_view text, std::string_view file) {
  constexpr std::string_view allowed = "name x y, or name x y z";
  field_lines lines(text, file);
  std::vector<placed_node> nodes;
  line_numbers line_of;  // views of `text`
  std::size_t alike = 0;
  while (lines.next()) {
    const std::size_t fields = fields_before_comment(lines);
    if (fields == 0) continue;
    if (fields != 3 && fields != 4) lines.refuse(field_words(lines.here(), "a line"), allowed);
    if (alike == 0) alike = fields;
    if (fields != alike)
      lines.refuse(fmt::format("{} coordinates for node {}", fields - 1, field_words(lines.field(0))),
                   fmt::format("{}, as in the lines before", alike - 1));
    refuse_again(lines, "node", lines.field(0), line_of);
    nodes.push_back({std::string(lines.field(0)),
                     {lines.real(1, "x"), lines.real(2, "y"), fields == 4 ? lines.real(3, "z") : 0.0}});
  }
  if (nodes.empty()) refuse_line(file, 0, "no node", allowed);
  return nodes;
}

}  // namespace contct
