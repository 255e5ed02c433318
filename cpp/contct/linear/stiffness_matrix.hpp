// Symmetric matrices as bands, single entries and columns, and the stiffness matrix K of a structure.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
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
/// The places marked * are allocated but never read. Memory for doubles: 8 (kd + 1) bytes a row.
template <class Number>
class band_of_numbers {
 public:
  band_of_numbers() = default;
  band_of_numbers(int order, int subdiagonals)
      : order_(order), subdiagonals_(subdiagonals), entries_(std::size_t{1} * order * (subdiagonals + 1)) {}

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] int subdiagonals() const { return subdiagonals_; }

  /// Entry (row, column), where row >= column and row - column <= kd.
  [[nodiscard]] Number& at(std::size_t row, std::size_t column) { return entries_[place(row, column)]; }
  [[nodiscard]] const Number& at(std::size_t row, std::size_t column) const {
    return entries_[place(row, column)];
  }
  /// The first column that the band has in `row`.
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

/// An entry of a symmetric matrix; row and column count from 0. In a sparse_matrix, row >= column.
struct matrix_entry {
  int row;
  int column;
  double value;
};

/// A symmetric matrix as other programs write it: entries of the lower triangle, each place at most once. All
/// other places of this triangle are 0. Memory: 16 bytes an entry.
struct sparse_matrix {
  int order = 0;
  std::vector<matrix_entry> entries;
  std::size_t stored = 0;  ///< number of entries in the file, zeros included

  /// The uncertainty of x'A x if a program summed each entry a_ij in doubles: two units in the last place of
  /// sqrt(a_ii a_jj).
  [[nodiscard]] double doubt(std::span<const double> x) const;

  /// Returns A x, computed in long double.
  [[nodiscard]] std::vector<long double> times(std::span<const double> x) const;
};

/// The number of subdiagonals of `a` as a band, where row i of `a` is row rows[i], or i if `rows` is empty.
[[nodiscard]] int subdiagonals_of(const sparse_matrix& a, std::span<const int> rows);

/// The bytes of `a` as a band.
[[nodiscard]] inline std::int64_t bytes_of_band(const sparse_matrix& a, std::span<const int> rows) {
  return std::int64_t{8} * a.order * (subdiagonals_of(a, rows) + 1);
}

/// [order] for each row of `a` the row, from 0, in a band with few subdiagonals, by reverse Cuthill and
/// McKee; empty if the given order is as good. Takes time linear in the entries, except that neighbours are
/// sorted by degree.
[[nodiscard]] std::vector<int> rows_for_small_band(const sparse_matrix& a);

/// The lower triangle of a symmetric matrix, by columns; rows and columns count from 0. Every column begins
/// with its diagonal entry, which may be 0. Memory: 12 bytes an entry.
struct sparse_columns {
  /// [order + 1] the index of each column's diagonal entry in `rows` and `values`; last, their size.
  std::vector<int> starts = {0};
  std::vector<int> rows;       ///< [entries] ascending within a column
  std::vector<double> values;  ///< [entries]

  [[nodiscard]] int order() const { return static_cast<int>(starts.size()) - 1; }
  [[nodiscard]] double& diagonal(std::size_t row) { return values[starts[row]]; }
  [[nodiscard]] double diagonal(std::size_t row) const { return values[starts[row]]; }
  /// The stored entry (row, column), where row >= column. Throws std::out_of_range if there is none.
  [[nodiscard]] double& at(int row, int column);
};

/// Calls visit(row, column, value) for every stored entry, column by column. `Columns`: sparse_columns, const
/// or not.
template <class Columns, class Visit>
void each_entry(Columns& a, Visit visit) {
  for (int column = 0; column < a.order(); ++column)
    for (int i = a.starts[column]; i < a.starts[column + 1]; ++i) visit(a.rows[i], column, a.values[i]);
}

/// Converts `a` to columns, where row i of `a` becomes row rows[i], or i if `rows` is empty. Throws
/// std::length_error if there are more entries than an int can count.
[[nodiscard]] sparse_columns columns_of(const sparse_matrix& a, std::span<const int> rows = {});

/// Converts `a` to columns, without zeros off the diagonal; a beam's band keeps them, and is copied quicker.
[[nodiscard]] sparse_columns columns_of(const band_matrix& a);

/// Overwrites `band` with `a`, which has the same order and no entries outside the band.
void put_in(const sparse_columns& a, band_matrix& band);

/// A spring at one row: `stiffness` is added to the diagonal. If `other` >= 0, a spring between two rows:
/// `stiffness` is added to both diagonal entries, and subtracted from the entry off the diagonal, which the
/// matrix must have.
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

/// The stiffness matrix K by columns. LAPACK factors K as a band if `subdiagonals` are known; otherwise
/// CHOLMOD factors it, because a band would take too much memory.
class stiffness_matrix : public sparse_columns {
 public:
  stiffness_matrix() = default;
  stiffness_matrix(sparse_columns k, std::optional<int> width = {})
      : sparse_columns(std::move(k)), subdiagonals(width) {}
  stiffness_matrix(const band_matrix& k) : stiffness_matrix(columns_of(k), k.subdiagonals()) {}

  std::optional<int> subdiagonals;

  [[nodiscard]] bool is_band() const { return subdiagonals.has_value(); }
  /// A copy of K as a band. Throws std::bad_optional_access if `subdiagonals` are not known.
  [[nodiscard]] band_matrix band() const {
    band_matrix all(order(), subdiagonals.value());
    put_in(*this, all);
    return all;
  }

  /// K with `springs`, and its diagonal [rows].
  [[nodiscard]] stiffness_matrix with(std::span<const spring_at> springs) const;
  [[nodiscard]] std::vector<double> diagonal_with(std::span<const spring_at> springs) const;
  /// The entries off the diagonal other than 0, of both triangles, in the columns marked in `columns` [rows].
  [[nodiscard]] std::vector<matrix_entry> entries_in(std::span<const char> columns) const;
  /// Where pivots[r] > 0 [rows]: clears row r and column r, and sets their diagonal entry to pivots[r].
  void fix(std::span<const double> pivots);
  /// Replaces K by D K D, where D is the diagonal matrix of `d` [rows].
  void scale(std::span<const double> d);

  /// Subtracts K x from r, in long double. `x`: doubles or long doubles [rows].
  template <class Vector>
  void subtract_product(const Vector& x, std::span<long double> r) const {
    each_entry(*this, [&](int row, int column, double value) {
      if (value == 0.0) return;  // as in the rows of fixed dofs
      r[row] -= value * static_cast<long double>(x[column]);
      if (row != column) r[column] -= value * static_cast<long double>(x[row]);
    });
  }

  /// The 1-norm (largest column sum of magnitudes) of D K D, where D is the diagonal matrix of `d` [rows],
  /// and K has `diagonal` [rows] as its diagonal.
  [[nodiscard]] double one_norm(std::span<const double> diagonal, std::span<const double> d) const;
};

}  // namespace contct
