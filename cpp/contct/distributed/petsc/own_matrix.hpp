// The rows that one rank has of a stiffness, in doubles and in numbers of 32 digits. Every function is
// collective, and takes whole vectors.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contct/distributed/petsc/distributed_matrix.hpp"
#include "contct/matrix/remote_matrix.hpp"
#include "contct/matrix/stiffness_matrix.hpp"
#include "contct/numeric/double_double.hpp"
#include "contct/structure/problem.hpp"

namespace contct::distributed::petsc {

using numeric::double_double;

/// D K D for own rows of K; only the upper triangle, for MUMPS.
template <class Number>
[[nodiscard]] upper_rows upper_of(const matrix::full_rows<Number>& k, std::span<const double> d);

/// A stiffness as the decimals of a problem give it.
struct own_truth {
  matrix::full_rows<double_double> rows;

  /// These are of own rows.
  [[nodiscard]] std::vector<double_double> diagonal() const;
  [[nodiscard]] std::vector<double_double> times(std::span<const double_double> x) const;
  [[nodiscard]] std::vector<double> sums(std::span<const double> x) const;
  [[nodiscard]] int widest_row() const;
};

/// A stiffness in doubles.
struct own_matrix {
  matrix::full_rows<double> rows;
  /// [entries] the last digits that a file has of them, as matrix::sparse_matrix; empty: all are exact
  std::vector<std::int16_t> last_digits;
  std::shared_ptr<const structure::plate> from;  ///< null: from a file

  void scale(std::span<const double> d);
  [[nodiscard]] std::vector<double> diagonal() const;
  [[nodiscard]] std::vector<matrix::matrix_entry> entries_in(std::span<const char> columns) const;
  /// Without the diagonal, as the next.
  [[nodiscard]] std::vector<long double> times(std::span<const long double> x) const;
  [[nodiscard]] std::vector<double> magnitudes(std::span<const double> d) const;
  [[nodiscard]] std::vector<double> half_units(std::span<const double> x) const;
  [[nodiscard]] std::vector<double> sums(std::span<const double> x) const;
  [[nodiscard]] own_truth truth() const;
  /// What the rigid-body motions of a plate do at own rows of D K D; none of a matrix, whose dofs are
  /// nowhere.
  [[nodiscard]] own_motions rigid_motions(std::span<const double> d) const;
};

/// The rows of a plate's stiffness that a rank has.
[[nodiscard]] own_matrix matrix_of(const std::shared_ptr<const structure::plate>& p, const own_rows& own);

}  // namespace contct::distributed::petsc
