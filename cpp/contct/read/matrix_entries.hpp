// Entries of a matrix as lines of a file have them: read, sorted and checked.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/text/input_text.hpp"

namespace contct::read {

/// Rows, and entries, that a file may say it has.
inline constexpr std::int64_t most_rows = std::numeric_limits<int>::max() - 1;
inline constexpr std::int64_t most_entries = most_rows;

/// An entry of the lower triangle, row >= column, from 0, and the line that it was read from. 32 bytes.
struct read_entry {
  int row, column;
  double value;
  std::int64_t line;
  int last_digit;  ///< its power of ten, or sparse_matrix::exact_entry
};

/// Matrix Market's files have the lower triangle, CalculiX's the upper one.
enum class entry_format { matrix_market, calculix };

/// What a Matrix Market file says before its entries.
struct matrix_head {
  int rows = 0;
  int entries = 0;
  std::int64_t line = 0;   ///< that says so, from 1; all behind it have entries
  std::size_t begins = 0;  ///< at which byte these do
};

/// Of the beginning of the file, which has the whole head. Throws input_error.
[[nodiscard]] matrix_head parse_matrix_head(std::string_view text, std::string_view file);

/// The first line: "%%MatrixMarket matrix coordinate real" and `symmetry`, in any case; true where it says
/// "array" in place of "coordinate".
bool read_header(text::field_lines& lines, std::string_view symmetry, bool may_be_array);

/// To the line behind the comments: the size.
void go_to_size(text::field_lines& lines, std::size_t fields, std::string_view allowed);

/// The line "row column value", from 1 in the file and from 0 in the answer; `what` the value is.
[[nodiscard]] read_entry entry_in(const text::field_lines& lines, int rows, int columns,
                                  std::string_view what, bool fortran = false);

/// The same of a stiffness: in its triangle, and turned into the lower one.
[[nodiscard]] read_entry parse_entry(const text::field_lines& lines, int rows, entry_format format);

/// By columns, and by rows in each; linear. Columns from `first` to `first + count`, from 0.
void sort_entries(std::vector<read_entry>& entries, int first, int count);

/// Throws input_error where two sorted entries have one place.
void refuse_repeated(std::span<const read_entry> entries, std::string_view file);

/// Throws input_error for a negative entry of the diagonal.
void refuse_negative(std::span<const read_entry> entries, std::string_view file);

/// Throws input_error for an entry in a row or column that is not `stiff` [rows]: has 0 on its diagonal.
void refuse_bare(std::span<const read_entry> entries, std::span<const char> stiff, std::string_view file);

/// How a program rounded what it wrote: to as many places behind the point, or to as many digits, of which it
/// may leave out zeros at the end. Whole numbers are exact.
struct written_digits {
  int most_digits = 0;
  std::optional<int> lowest, highest;  ///< the last digits' places that there are; none: all are exact

  void include(const read_entry& e);
  /// The last digit that an entry other than 0 was rounded to, or sparse_matrix::exact_entry.
  [[nodiscard]] int last_digit_of(const read_entry& e) const;
};

}  // namespace contct::read
