#include "contct/read/petsc_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "contct/read/matrix_files.hpp"
#include "contct/text/input_text.hpp"

namespace contct::read {
namespace {

constexpr std::int64_t most_petsc_int = std::numeric_limits<int>::max() - 1;
constexpr std::int64_t bytes_of_int = 4, bytes_of_value = 8;

/// The unsigned number whose most significant byte stands first.
template <class Unsigned>
Unsigned number_at(std::string_view bytes, std::int64_t at) {
  Unsigned number = 0;
  for (const char c : bytes.substr(static_cast<std::size_t>(at), sizeof(Unsigned)))
    number = static_cast<Unsigned>(number << 8 | static_cast<unsigned char>(c));
  return number;
}

int int_at(std::string_view bytes, std::int64_t at) {
  return std::bit_cast<std::int32_t>(number_at<std::uint32_t>(bytes, at));
}

/// The places of a file whose size has been compared with its header.
class petsc_file {
 public:
  petsc_file(std::string_view bytes, std::string_view file) : bytes_(bytes), file_(file) {}

  /// Refuses sizes that cannot be, and a file of another length than they make.
  void read_header();
  /// Where each row begins among the entries [rows + 1].
  [[nodiscard]] std::vector<int> row_starts() const;
  /// Refuses entries that cannot be, and a place that is there twice.
  void check_entries(const std::vector<int>& starts) const;

  [[nodiscard]] const std::string& name() const { return file_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int entries() const { return entries_; }
  [[nodiscard]] int column(int entry) const { return int_at(bytes_, place_of_column(entry)); }
  [[nodiscard]] double value(int entry) const {
    return std::bit_cast<double>(number_at<std::uint64_t>(bytes_, place_of_value(entry)));
  }
  [[noreturn]] void refuse_value(int entry, const std::string& found, std::string_view allowed) const {
    refuse(place_of_value(entry), found, allowed);
  }

 private:
  static constexpr std::int64_t header = 4 * bytes_of_int;

  [[nodiscard]] static std::int64_t place_of_length(int row) { return header + bytes_of_int * row; }
  [[nodiscard]] std::int64_t place_of_column(int entry) const {
    return header + bytes_of_int * (std::int64_t{rows_} + entry);
  }
  [[nodiscard]] std::int64_t place_of_value(int entry) const {
    return header + bytes_of_int * (std::int64_t{rows_} + entries_) + bytes_of_value * entry;
  }
  [[noreturn]] void refuse(std::int64_t at, const std::string& found, std::string_view allowed) const {
    refuse_line(fmt::format("{}: byte {}", file_, at), 0, found, allowed);
  }

  std::string_view bytes_;
  std::string file_;
  int rows_ = 0, entries_ = 0;
};

void petsc_file::read_header() {
  if (std::ssize(bytes_) < header)
    refuse_line(file_, 0, fmt::format("{} bytes", bytes_.size()),
                "16 or more, with which PETSc's binary of a matrix begins");
  if (number_at<std::uint32_t>(bytes_, 0) != petsc_matrix_id)
    refuse_line(file_, 0, "PETSc's binary with 64-bit integers",
                "with 32-bit integers, as PETSc writes it where it is built without --with-64-bit-indices");
  rows_ = int_at(bytes_, 4);
  const int columns = int_at(bytes_, 8);
  entries_ = int_at(bytes_, 12);
  if (rows_ < 1 || rows_ > most_petsc_int)
    refuse(4, fmt::format("{} rows", rows_), fmt::format("1 to {}", most_petsc_int));
  if (columns != rows_) refuse(8, fmt::format("{} rows and {} columns", rows_, columns), "a square matrix");
  if (entries_ == -1) refuse(12, "a dense matrix", "a sparse one (MATAIJ): MatConvert makes it");
  if (entries_ < rows_ || entries_ > most_petsc_int)
    refuse(12, fmt::format("{} rows and {} entries", rows_, entries_),
           fmt::format("an entry on the diagonal of every row, and at most {} entries", most_petsc_int));
  const std::int64_t all = place_of_value(entries_);
  if (std::ssize(bytes_) != all)
    refuse_line(file_, 0, fmt::format("{} bytes", bytes_.size()),
                fmt::format("{}, which {} rows and {} entries take, each entry with a real 64-bit value", all,
                            rows_, entries_));
}

std::vector<int> petsc_file::row_starts() const {
  std::vector<int> starts = {0};
  starts.reserve(rows_ + std::size_t{1});
  for (int row = 0; row < rows_; ++row) {
    const int length = int_at(bytes_, place_of_length(row));
    const int left = entries_ - starts.back();
    if (length < 1 || length > std::min(rows_, left))
      refuse(place_of_length(row), fmt::format("{} entries in row {}", length, row + 1),
             fmt::format("1 to {}, with {} of {} entries left", rows_, left, entries_));
    starts.push_back(starts.back() + length);
  }
  if (starts.back() != entries_)
    refuse(12, fmt::format("{} entries, and rows that have {}", entries_, starts.back()),
           "as many entries as the rows have");
  return starts;
}

void petsc_file::check_entries(const std::vector<int>& starts) const {
  std::vector<int> last(rows_, -1);  // the last entry of each column
  for (int row = 0; row < rows_; ++row) {
    for (int entry = starts[row]; entry < starts[row + 1]; ++entry) {
      const int in = column(entry);
      if (in < 0 || in >= rows_)
        refuse(place_of_column(entry), fmt::format("column {} in row {}", std::int64_t{in} + 1, row + 1),
               fmt::format("1 to {}, in the file from 0", rows_));
      if (last[in] >= starts[row])
        refuse(place_of_column(entry),
               fmt::format("the place of row {} and column {} again, which byte {} has", row + 1, in + 1,
                           place_of_column(last[in])),
               "each place once: sum what belongs together");
      last[in] = entry;
      if (!std::isfinite(value(entry)))
        refuse_value(entry, fmt::format("{} in row {} and column {}", value(entry), row + 1, in + 1),
                     "a finite number");
    }
  }
}

/// The lower triangle by columns, rows ascending: the entries of the file.
class lower_triangle {
 public:
  /// Counted first, then filled row by row.
  lower_triangle(const petsc_file& f, const std::vector<int>& row_starts)
      : file_(f), starts_(f.rows() + std::size_t{1}, 0) {
    for_each(row_starts, [&](int /*row*/, int column, int /*entry*/) { ++starts_[column + std::size_t{1}]; });
    for (std::size_t column = 1; column < starts_.size(); ++column) starts_[column] += starts_[column - 1];
    std::vector<int> next(starts_.begin(), starts_.end() - 1);
    stored_.resize(static_cast<std::size_t>(starts_.back()));
    for_each(row_starts, [&](int row, int column, int entry) { stored_[next[column]++] = {row, entry}; });
  }

  /// Refuses an upper triangle that is another one. A place without an entry is 0.
  void compare_with_upper(const std::vector<int>& row_starts) const;

  /// Refuses what cannot be positive semidefinite: a diagonal that is missing or negative, and a row with
  /// entries where it is 0.
  void check_diagonal() const;

  [[nodiscard]] sparse_matrix matrix() const;

 private:
  struct place {
    int row, entry;
  };

  template <class Visit>
  void for_each(const std::vector<int>& row_starts, const Visit& visit) const {
    for (int row = 0; row < file_.rows(); ++row)
      for (int entry = row_starts[row]; entry < row_starts[row + 1]; ++entry)
        if (const int column = file_.column(entry); column <= row) visit(row, column, entry);
  }
  [[noreturn]] void refuse_lonely(int entry, int row, int column) const {
    file_.refuse_value(entry,
                       fmt::format("{} in row {} and column {}, and no entry in row {} and column {}",
                                   file_.value(entry), row + 1, column + 1, column + 1, row + 1),
                       "both triangles, equal to the bit: PETSc stores all entries of a matrix (MATAIJ)");
  }
  [[nodiscard]] bool begins_with_diagonal(int column) const {
    return starts_[column] < starts_[column + 1] && stored_[starts_[column]].row == column;
  }

  const petsc_file& file_;
  std::vector<int> starts_;
  std::vector<place> stored_;
};

void lower_triangle::compare_with_upper(const std::vector<int>& row_starts) const {
  std::vector<char> has_partner(stored_.size(), 0);
  for (int row = 0; row < file_.rows(); ++row) {
    const auto end = stored_.begin() + starts_[row + 1];
    for (int entry = row_starts[row]; entry < row_starts[row + 1]; ++entry) {
      const int column = file_.column(entry);
      if (column <= row) continue;
      const double value = file_.value(entry);
      const auto partner = std::lower_bound(stored_.begin() + starts_[row], end, column,
                                            [](const place& p, int of) { return p.row < of; });
      if (partner == end || partner->row != column) {
        if (value != 0.0) refuse_lonely(entry, row, column);
        continue;
      }
      has_partner[partner - stored_.begin()] = 1;
      const double other = file_.value(partner->entry);
      if (value != other)
        file_.refuse_value(partner->entry,
                           fmt::format("{} in row {} and column {}, and {} in row {} and column {}", other,
                                       column + 1, row + 1, value, row + 1, column + 1),
                           "a symmetric matrix, equal to the bit");
    }
  }
  for (int column = 0; column < file_.rows(); ++column) {
    for (int i = starts_[column]; i < starts_[column + 1]; ++i) {
      const auto& [row, entry] = stored_[i];
      if (row != column && has_partner[i] == 0 && file_.value(entry) != 0.0)
        refuse_lonely(entry, row, column);
    }
  }
}

void lower_triangle::check_diagonal() const {
  std::vector<char> stiff(static_cast<std::size_t>(file_.rows()), 0);
  for (int row = 0; row < file_.rows(); ++row) {
    if (!begins_with_diagonal(row))
      refuse_line(file_.name(), 0, fmt::format("no entry on the diagonal of row {}", row + 1),
                  "an entry on the diagonal of every row, 0 where the row has nothing");
    const int entry = stored_[starts_[row]].entry;
    const double value = file_.value(entry);
    if (value < 0)
      file_.refuse_value(entry, fmt::format("{} on the diagonal of row {}", value, row + 1),
                         "0 or more: a stiffness matrix is positive semidefinite");
    stiff[row] = value > 0 ? 1 : 0;
  }
  for (int column = 0; column < file_.rows(); ++column) {
    for (int i = starts_[column]; i < starts_[column + 1]; ++i) {
      const auto& [row, entry] = stored_[i];
      const double value = file_.value(entry);
      const int bare = stiff[row] == 0 ? row : column;
      if (value != 0.0 && stiff[bare] == 0)
        file_.refuse_value(entry, fmt::format("{} in row {}, which has 0 on its diagonal", value, bare + 1),
                           "a matrix that is positive semidefinite");
    }
  }
}

sparse_matrix lower_triangle::matrix() const {
  sparse_matrix a{file_.rows(), {}};
  a.entries.reserve(stored_.size());
  for (int column = 0; column < file_.rows(); ++column) {
    for (int i = starts_[column]; i < starts_[column + 1]; ++i)
      if (const double value = file_.value(stored_[i].entry); value != 0.0)
        a.entries.push_back({stored_[i].row, column, value});
  }
  return a;
}

}  // namespace

bool is_petsc_matrix(std::string_view bytes) {
  if (bytes.size() < sizeof(std::uint32_t)) return false;
  const auto begins = number_at<std::uint32_t>(bytes, 0);
  if (begins == petsc_matrix_id) return true;
  return begins == 0 && bytes.size() >= sizeof(std::uint64_t) &&
         number_at<std::uint64_t>(bytes, 0) == petsc_matrix_id;
}

sparse_matrix parse_petsc_matrix(std::string_view bytes, std::string_view file) {
  petsc_file f(bytes, file);
  f.read_header();
  const std::vector<int> starts = f.row_starts();
  f.check_entries(starts);
  const lower_triangle lower(f, starts);
  lower.compare_with_upper(starts);
  lower.check_diagonal();
  return lower.matrix();
}

sparse_matrix parse_stiffness(std::string_view bytes, std::string_view file,
                              std::vector<std::string>* warnings) {
  if (is_petsc_matrix(bytes)) return parse_petsc_matrix(bytes, file);
  if (bytes.size() >= sizeof petsc_matrix_id && bytes.front() == '\0')
    refuse_line(file, 0,
                fmt::format("a binary file that begins with {:08x}", number_at<std::uint32_t>(bytes, 0)),
                fmt::format("a Matrix Market file, or PETSc's binary of a matrix, which begins with {:08x}",
                            petsc_matrix_id));
  return parse_symmetric(bytes, file, warnings);
}

}  // namespace contct::read
