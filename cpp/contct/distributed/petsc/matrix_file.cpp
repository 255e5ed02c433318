#include "contct/distributed/petsc/matrix_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "contct/distributed/petsc/file_parts.hpp"
#include "contct/distributed/petsc/petsc_file.hpp"
#include "contct/read/matrix_entries.hpp"
#include "contct/read/petsc_matrix.hpp"

namespace contct::distributed::petsc {
namespace {

using read::entry_format;
using read::matrix_head;
using read::read_entry;

/// Comments may be long: more of the file is read until the size has been found.
matrix_head head_of(const open_file& f, const matrix_file& what) {
  if (what.rows > 0) return {what.rows, 0, 0, 0};
  for (std::size_t count = 1 << 16;; count *= 4) {
    const std::string text = f.bytes(0, count);
    try {
      return read::parse_matrix_head(text, what.name);
    } catch (const input_error&) {
      if (text.size() == f.size()) throw;
    }
  }
}

/// A rank's part of the lines behind the head.
std::string own_text(MPI_Comm job, const open_file& f, std::size_t begins) {
  const auto edge = [&](int rank) {
    const std::size_t at = begins + (f.size() - begins) / static_cast<std::size_t>(ranks_in(job)) *
                                        static_cast<std::size_t>(rank);
    return at == begins ? begins : f.end_of_line(at - 1);
  };
  const std::size_t from = edge(rank_in(job));
  const std::size_t to = rank_in(job) + 1 == ranks_in(job) ? f.size() : edge(rank_in(job) + 1);
  return f.bytes(from, to - from);
}

/// What a rank has read of the file, up to the first line that is wrong.
struct read_part {
  std::vector<read_entry> entries;
  std::optional<refusal> wrong;
};

read_part parse(const std::string& text, const matrix_file& what, int rows, std::int64_t lines_before) {
  read_part part;
  text::field_lines lines(text, what.name, lines_before);
  const entry_format format = what.rows > 0 ? entry_format::calculix : entry_format::matrix_market;
  try {
    while (lines.next()) part.entries.push_back(read::parse_entry(lines, rows, format));
  } catch (const input_error& e) {
    part.wrong = {lines.line(), e.what()};
  }
  return part;
}

/// Too many lines, or too few, as read_lines in read/matrix_files.cpp refuses them.
void check_count(MPI_Comm job, const matrix_file& what, const matrix_head& head, std::int64_t all_lines,
                 read_part& part) {
  if (what.rows > 0) return;
  const auto own = static_cast<std::int64_t>(part.entries.size());
  const std::int64_t before = sum_before(job, own);
  const std::int64_t all = sum_of(job, own);
  const auto refused = [&](std::int64_t line, const std::string& found, const std::string& allowed) {
    try {
      text::refuse_line(what.name, line, found, allowed);
    } catch (const input_error& e) {
      if (!part.wrong || line < part.wrong->place) part.wrong = {line, e.what()};
    }
  };
  if (before <= head.entries && before + own > head.entries)
    refused(part.entries[static_cast<std::size_t>(head.entries - before)].line, "more entries than that",
            fmt::format("{}, as line {} says", head.entries, head.line));
  const bool any_wrong = sum_of(job, part.wrong ? 1 : 0) > 0;  // before the end, then
  if (all < head.entries && !any_wrong && rank_in(job) == 0)
    refused(head.line + all_lines, fmt::format("the end of the file after {} of {}", all, head.entries),
            fmt::format("as many as line {} says", head.line));
}

read::written_digits digits_of(MPI_Comm job, std::span<const read_entry> entries) {
  read::written_digits written;
  for (const read_entry& e : entries) written.include(e);
  constexpr int none = std::numeric_limits<int>::max();
  int least = written.lowest.value_or(none);
  int most[2] = {written.highest.value_or(-none), written.most_digits};
  MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_INT, MPI_MIN, job);
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_INT, MPI_MAX, job);
  if (least == none) return {};
  return {most[1], least, most[0]};
}

/// The rows of both triangles, from the lower one by columns.
own_matrix rows_of(MPI_Comm job, const owners& all, const own_rows& own, std::vector<read_entry> lower) {
  const read::written_digits written = digits_of(job, lower);
  std::erase_if(lower, [](const read_entry& e) { return e.value == 0; });
  std::vector<read_entry> below = lower;
  std::erase_if(below, [](const read_entry& e) { return e.row == e.column; });
  std::vector<read_entry> rows =
      exchanged(job, all, std::move(below), [&](const read_entry& e) { return all.of(e.row); });
  for (read_entry& e : rows) std::swap(e.row, e.column);  // sorted by what is their row
  rows.insert(rows.end(), lower.begin(), lower.end());
  lower = {};
  read::sort_entries(rows, own.first, own.count);
  own_matrix m;
  m.rows.first = own.first;
  auto next = rows.begin();
  for (int row = own.first; row < own.first + own.count; ++row) {
    for (; next != rows.end() && next->column == row; ++next) {
      m.rows.columns.push_back(next->row);
      m.rows.values.push_back(next->value);
      if (written.lowest) m.last_digits.push_back(static_cast<std::int16_t>(written.last_digit_of(*next)));
    }
    m.rows.starts.push_back(m.rows.columns.size());
  }
  return m;
}

void check(MPI_Comm job, const matrix_file& what, const own_rows& own, std::span<const read_entry> entries) {
  agree_on(job, [&] { read::refuse_repeated(entries, what.name); });
  agree_on(job, [&] { read::refuse_negative(entries, what.name); });
  std::vector<char> stiff(static_cast<std::size_t>(own.count));
  for (const read_entry& e : entries)
    if (e.row == e.column && e.value != 0) stiff[static_cast<std::size_t>(e.row - own.first)] = 1;
  const std::vector<char> all = gathered_everywhere(job, std::span<const char>(stiff));
  agree_on(job, [&] { read::refuse_bare(entries, all, what.name); });
}

}  // namespace

own_matrix read_own(MPI_Comm job, const matrix_file& what) {
  std::optional<open_file> file;
  agree_on(job, [&] { file.emplace(what); });
  file->agree_on_size(job);
  const bool is_binary =
      found_by_rank_0(job, [&] { return what.rows == 0 && read::is_petsc_matrix(file->bytes(0, 8)); });
  if (is_binary) return read_own_binary(job, *file, what);
  const matrix_head head = found_by_rank_0(job, [&] { return head_of(*file, what); });
  std::string text;
  agree_on(job, [&] { text = own_text(job, *file, head.begins); });
  const std::int64_t lines = std::count(text.begin(), text.end(), '\n');
  read_part part = parse(text, what, head.rows, head.line + sum_before(job, lines));
  text = {};
  check_count(job, what, head, sum_of(job, lines), part);
  agree(job, part.wrong);
  const std::int64_t entries = sum_of(job, static_cast<std::int64_t>(part.entries.size()));
  agree_on(job, [&] {
    if (head.rows > entries)
      text::refuse_line(what.name, 0, fmt::format("{} rows and {} entries", head.rows, entries),
                        "an entry on the diagonal of every row");
  });
  const own_rows own(job, head.rows);
  const owners all(job, own);
  std::vector<read_entry> lower =
      exchanged(job, all, std::move(part.entries), [&](const read_entry& e) { return all.of(e.column); });
  read::sort_entries(lower, own.first, own.count);
  check(job, what, own, lower);
  return rows_of(job, all, own, std::move(lower));
}

}  // namespace contct::distributed::petsc
