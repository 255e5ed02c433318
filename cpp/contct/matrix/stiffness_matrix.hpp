// Symmetric matrices in three storages (band, single entries, columns), and the stiffness matrix K of a
// structure.
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

/// Symmetric band matrix of order n with kd subdiagonals, in LAPACK's lower band storage. Column j contains
/// its diagonal entry and the entries below it; the columns follow each other. For n = 5, kd = 2 (rows and
/// columns from 0):
///
///     a00                              column 0: a00 a10 a20
///     a10 a11                          column 1: a11 a21 a31
///     a20 a21 a22                      column 2: a22 a32 a42
///         a31 a32 a33                  column 3: a33 a43  *
///             a42 a43 a44              column 4: a44  *   *
///
/// The places marked * are allocated but never read. Memory: 8 (kd + 1) bytes a row.
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
  /// The first column of `row` inside the band.
  [[nodiscard]] int first(int row) const { return row < subdiagonals_ ? 0 : row - subdiagonals_; }

  /// Adds `value` at (row, column) and, by symmetry, at (column, row).
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

/// One entry of the lower triangle, row >= column, both from 0.
struct matrix_entry {
  int row;
  int column;
  double value;
};

/// A symmetric matrix as other programs write it: single entries, each place of the lower triangle at most
/// once; all other entries are 0. 16 bytes an entry.
struct sparse_matrix {
  int order = 0;
  std::vector<matrix_entry> entries;
  /// [entries] the power of ten of each entry's last digit in the file, or exact_entry if the entry was not
  /// rounded. Empty: all are exact.
  std::vector<std::int16_t> last_digits = {};
  static constexpr std::int16_t exact_entry = -32768;
  /// Half a unit in the last digit of an entry.
  [[nodiscard]] double half_unit(std::size_t entry) const {
    if (last_digits.empty() || last_digits[entry] == exact_entry) return 0.0;
    return 0.5 * std::pow(10.0, last_digits[entry]);
  }

  /// The uncertainty of x'A x: half a unit in the last digit of each entry, plus the rounding of a program
  /// that sums each entry in doubles, two units in the last place of the diagonals.
  [[nodiscard]] double doubt(std::span<const double> x) const;

  /// y = A x in long double.
  [[nodiscard]] std::vector<long double> times(std::span<const double> x) const;
};

/// The largest distance of an entry from the diagonal, if row i of the matrix is at `rows[i]`; at i if `rows`
/// is empty.
[[nodiscard]] int subdiagonals_of(const sparse_matrix& a, std::span<const int> rows);

/// Bytes of `a` as a band in the order `rows`.
[[nodiscard]] inline std::int64_t bytes_of_band(const sparse_matrix& a, std::span<const int> rows) {
  return std::int64_t{8} * a.order * (subdiagonals_of(a, rows) + 1);
}

/// `a` as a band in the order `rows`.
[[nodiscard]] band_matrix band_of(const sparse_matrix& a, std::span<const int> rows);

/// The row of each dof, from 0, in an order with a small bandwidth, by reverse Cuthill and McKee; empty if
/// the order of `a` is as good. Linear in the entries, except for sorting neighbours by their degree. It has
/// its own source file, which needs Boost.Graph.
[[nodiscard]] std::vector<int> rows_for_small_band(const sparse_matrix& a);

/// The lower triangle by columns, from 0. Every column begins with its diagonal entry, which may be 0.
/// Memory: 12 bytes an entry.
struct sparse_columns {
  /// [order + 1] the place of each column's diagonal, then the number of entries.
  std::vector<int> starts = {0};
  std::vector<int> rows;       ///< [entries] ascending within a column
  std::vector<double> values;  ///< [entries]

  [[nodiscard]] int order() const { return static_cast<int>(starts.size()) - 1; }
  [[nodiscard]] double& diagonal(std::size_t row) { return values[starts[row]]; }
  [[nodiscard]] double diagonal(std::size_t row) const { return values[starts[row]]; }
  /// A stored entry below the diagonal. Throws std::out_of_range if the entry is not stored.
  [[nodiscard]] double& at(int row, int column);
};

/// `a` by columns. Throws std::length_error if there are more entries than an int can count.
[[nodiscard]] sparse_columns columns_of(const sparse_matrix& a);

/// `a` by columns, without its zeros.
[[nodiscard]] sparse_columns columns_of(const band_matrix& a);

/// A spring at one row: its stiffness is added to the diagonal. If `other` >= 0, a spring between two rows:
/// -stiffness is also added off the diagonal, where the matrix must have an entry.
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

/// The stiffness matrix K, stored as a band, or by columns if a band would take too much memory.
class stiffness_matrix {
 public:
  stiffness_matrix() = default;
  stiffness_matrix(band_matrix k) : stored_(std::move(k)) {}
  stiffness_matrix(sparse_columns k) : stored_(std::move(k)) {}

  [[nodiscard]] int order() const {
    return std::visit([](const auto& k) { return k.order(); }, stored_);
  }

  [[nodiscard]] bool is_band() const { return std::holds_alternative<band_matrix>(stored_); }
  /// The following throw std::bad_variant_access if K has another storage.
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

  /// [rows] the diagonal of K with springs.
  [[nodiscard]] std::vector<double> diagonal_with(std::span<const spring_at> springs) const;
  /// The entries off the diagonal, of both triangles, in the columns that are marked in `columns` [rows].
  [[nodiscard]] std::vector<matrix_entry> entries_in(std::span<const char> columns) const;
  /// Clears every row and column r with `pivots[r]` > 0 [rows], and sets its diagonal entry to this pivot.
  void fix(std::span<const double> pivots);
  /// Replaces K by D K D, where D is diagonal: `d` [rows].
  void scale(std::span<const double> d);

  /// r = r - K x, computed in long double.
  void subtract_product(std::span<const double> x, std::span<long double> r) const;
  void subtract_product(std::span<const long double> x, std::span<long double> r) const;

  /// The largest column sum of magnitudes of D K D, where D is diagonal, `d` [rows], and `diagonal` [rows] is
  /// used as the diagonal of K.
  [[nodiscard]] double one_norm(std::span<const double> diagonal, std::span<const double> d) const;

 private:
  std::variant<band_matrix, sparse_columns> stored_;
};

/// K by columns, if it is a band with more zeros than other entries, as for a plate: products with it are the
/// same to the bit and take a tenth of the time. Otherwise nothing.
[[nodiscard]] std::optional<stiffness_matrix> without_zeros(const stiffness_matrix& k);

}  // namespace contct
