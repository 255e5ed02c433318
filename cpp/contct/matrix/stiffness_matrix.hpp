// Symmetric matrices without their zeros, in three storages; and the stiffness matrix K of a structure.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace contct {

/// Symmetric band matrix of order n with kd subdiagonals, in LAPACK's lower band storage. Column j has its
/// diagonal entry and those below it, one column after the other; for n = 5, kd = 2 (rows and columns from
/// 0):
///
///     a00                              column 0: a00 a10 a20
///     a10 a11                          column 1: a11 a21 a31
///     a20 a21 a22                      column 2: a22 a32 a42
///         a31 a32 a33                  column 3: a33 a43  *
///             a42 a43 a44              column 4: a44  *   *
///
/// The places marked * exist and are never read. Memory: 8 (kd + 1) bytes a row.
template <class Number>
class band_of_numbers {
 public:
  band_of_numbers() = default;
  band_of_numbers(int order, int subdiagonals)
      : order_(order), subdiagonals_(subdiagonals), entries_(std::size_t{1} * order * (subdiagonals + 1)) {}

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] int subdiagonals() const { return subdiagonals_; }

  /// Entry (row, column), row >= column, row - column <= kd.
  [[nodiscard]] Number& at(std::size_t row, std::size_t column) { return entries_[place(row, column)]; }
  [[nodiscard]] const Number& at(std::size_t row, std::size_t column) const {
    return entries_[place(row, column)];
  }
  /// The first column of a row in the band.
  [[nodiscard]] int first(int row) const { return row < subdiagonals_ ? 0 : row - subdiagonals_; }

  /// Add `value` at (row, column) and, by symmetry, at (column, row); any order of the two.
  void add(std::size_t row, std::size_t column, const Number& value) {
    at(std::max(row, column), std::min(row, column)) += value;
  }

  [[nodiscard]] Number* data() { return entries_.data(); }
  [[nodiscard]] const Number* data() const { return entries_.data(); }
  [[nodiscard]] std::span<const Number> entries() const { return entries_; }

 private:
  [[nodiscard]] std::size_t place(std::size_t row, std::size_t column) const {
    return column * (subdiagonals_ + 1) + (row - column);
  }

  int order_ = 0;
  int subdiagonals_ = 0;
  std::vector<Number> entries_;
};

using band_matrix = band_of_numbers<double>;

/// One entry of the lower triangle, row >= column; from 0.
struct matrix_entry {
  int row;
  int column;
  double value;
};

/// Symmetric, by single entries, as other programs write it: each place of the lower triangle at most once,
/// and the others are 0. 16 bytes an entry.
struct sparse_matrix {
  int order = 0;
  std::vector<matrix_entry> entries;
  /// [entries] the power of ten of each entry's last digit in the file; exact_entry if the entry was not
  /// rounded. Empty: all are exact.
  std::vector<std::int16_t> last_digits = {};
  static constexpr std::int16_t exact_entry = -32768;
  /// Half a unit in the last digit of an entry.
  [[nodiscard]] double half_unit(std::size_t entry) const {
    if (last_digits.empty() || last_digits[entry] == exact_entry) return 0.0;
    return 0.5 * std::pow(10.0, last_digits[entry]);
  }

  /// The uncertainty of x'A x: half a unit in the last digits of the entries, and the rounding of a program
  /// that sums an entry in doubles, two units in the last place of the diagonals.
  [[nodiscard]] double doubt(std::span<const double> x) const;

  /// y = A x in long double.
  [[nodiscard]] std::vector<long double> times(std::span<const double> x) const;
};

/// The largest distance of an entry from the diagonal, with row i of the matrix at `rows[i]`; at i where
/// `rows` is empty.
[[nodiscard]] int subdiagonals_of(const sparse_matrix& a, std::span<const int> rows);

/// Bytes of the band that holds it in that order.
[[nodiscard]] inline std::int64_t bytes_of_band(const sparse_matrix& a, std::span<const int> rows) {
  return std::int64_t{8} * a.order * (subdiagonals_of(a, rows) + 1);
}

/// As a band in that order.
[[nodiscard]] band_matrix band_of(const sparse_matrix& a, std::span<const int> rows);

/// The order that makes it a narrow band, by reverse Cuthill and McKee: the row of each dof, from 0; empty if
/// the order of `a` is as good. Linear in the entries, except for sorting neighbours by their degree. Needs
/// Boost.Graph, and has a source of its own.
[[nodiscard]] std::vector<int> rows_for_small_band(const sparse_matrix& a);

/// The lower triangle by columns, from 0. Every column begins with its diagonal entry, even if it is 0.
/// Memory: 12 bytes an entry.
struct sparse_columns {
  /// [order + 1] place of each column's diagonal; the last is the number of entries.
  std::vector<int> starts = {0};
  std::vector<int> rows;       ///< [entries] ascending within a column
  std::vector<double> values;  ///< [entries]

  [[nodiscard]] int order() const { return static_cast<int>(starts.size()) - 1; }
  [[nodiscard]] double& diagonal(std::size_t row) { return values[starts[row]]; }
  [[nodiscard]] double diagonal(std::size_t row) const { return values[starts[row]]; }
  /// An entry below the diagonal that has a place, which may be 0. Throws std::out_of_range for any other.
  [[nodiscard]] double& at(int row, int column);
};

/// Throws std::length_error when there are more entries than an int counts.
[[nodiscard]] sparse_columns columns_of(const sparse_matrix& a);

/// The same for a band, without its zeros.
[[nodiscard]] sparse_columns columns_of(const band_matrix& a);

/// A spring at one row: its stiffness is added to the diagonal. Or between two rows: then -stiffness is also
/// added off the diagonal, where the matrix must have an entry.
struct spring_at {
  int row = 0;
  double stiffness = 0.0;
  int other = -1;

  bool operator==(const spring_at&) const = default;
  template <class Vector>
  [[nodiscard]] auto stretch(const Vector& x) const {
    return other < 0 ? x[row] : x[row] - x[other];
  }
};

/// K: a band, or, where a band would take too much memory, sparse columns.
class stiffness_matrix {
 public:
  stiffness_matrix() = default;
  stiffness_matrix(band_matrix k) : stored_(std::move(k)) {}
  stiffness_matrix(sparse_columns k) : stored_(std::move(k)) {}

  [[nodiscard]] int order() const {
    return std::visit([](const auto& k) { return k.order(); }, stored_);
  }

  [[nodiscard]] bool is_band() const { return std::holds_alternative<band_matrix>(stored_); }
  /// These throw std::bad_variant_access when K has another storage.
  [[nodiscard]] band_matrix& band() { return std::get<band_matrix>(stored_); }
  [[nodiscard]] const band_matrix& band() const { return std::get<band_matrix>(stored_); }
  [[nodiscard]] sparse_columns& columns() { return std::get<sparse_columns>(stored_); }
  [[nodiscard]] const sparse_columns& columns() const { return std::get<sparse_columns>(stored_); }

  [[nodiscard]] double diagonal(std::size_t row) const {
    return is_band() ? band().at(row, row) : columns().diagonal(row);
  }
  [[nodiscard]] double& diagonal(std::size_t row) {
    return is_band() ? band().at(row, row) : columns().diagonal(row);
  }
  void add_to_diagonal(std::size_t row, double value) { diagonal(row) += value; }

  /// The diagonal of K with springs [rows].
  [[nodiscard]] std::vector<double> diagonal_with(std::span<const spring_at> springs) const;
  /// The entries off the diagonal in the columns that are marked [rows], of both triangles.
  [[nodiscard]] std::vector<matrix_entry> entries_in(std::span<const char> columns) const;
  /// Rows and columns `r` with `pivots[r]` > 0 [rows] keep nothing but that on the diagonal.
  void fix(std::span<const double> pivots);
  /// K becomes D K D, D diagonal: `d` [rows].
  void scale(std::span<const double> d);

  /// r = r - K x, with every product and sum in long double.
  void subtract_product(std::span<const double> x, std::span<long double> r) const;
  void subtract_product(std::span<const long double> x, std::span<long double> r) const;

  /// The largest sum of magnitudes of a column of D K D, D diagonal: `d` [rows], and with `diagonal` [rows]
  /// for K's own.
  [[nodiscard]] double one_norm(std::span<const double> diagonal, std::span<const double> d) const;

 private:
  std::variant<band_matrix, sparse_columns> stored_;
};

/// K by columns where it is a band of which more than half is zeros, as a plate's: its products are the same
/// to the bit, and take a tenth of the time. Nothing of other matrices.
[[nodiscard]] std::optional<stiffness_matrix> without_zeros(const stiffness_matrix& k);

}  // namespace contct
