// The stiffness matrix K of a structure, in either of two storages.
#pragma once

#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "contct/matrix/band_matrix.hpp"
#include "contct/matrix/sparse_matrix.hpp"

namespace contct::matrix {

/// A spring at one row: its stiffness is added to the diagonal.
struct spring_at {
  int row;
  double stiffness;
};

/// Symmetric: a band, or, where a band would take too much memory, sparse columns.
class stiffness_matrix {
 public:
  stiffness_matrix() = default;
  stiffness_matrix(band_matrix k) : stored_(std::move(k)) {}
  stiffness_matrix(sparse_columns k) : stored_(std::move(k)) {}

  [[nodiscard]] int order() const;
  [[nodiscard]] bool is_band() const { return std::holds_alternative<band_matrix>(stored_); }
  /// Throws std::bad_variant_access when K has the other storage.
  [[nodiscard]] band_matrix& band() { return std::get<band_matrix>(stored_); }
  [[nodiscard]] const band_matrix& band() const { return std::get<band_matrix>(stored_); }
  [[nodiscard]] sparse_columns& columns() { return std::get<sparse_columns>(stored_); }
  [[nodiscard]] const sparse_columns& columns() const { return std::get<sparse_columns>(stored_); }

  [[nodiscard]] double diagonal(std::size_t row) const;
  void add_to_diagonal(std::size_t row, double value);
  /// The diagonal of K with springs [rows].
  [[nodiscard]] std::vector<double> diagonal_with(std::span<const spring_at> springs) const;
  /// Rows and columns `r` with `fixed[r]` [rows] become those of the identity.
  void fix(std::span<const char> fixed);
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

}  // namespace contct::matrix
