// Symmetric matrices whose rows other processes have; vectors are whole here. The room `distributed` has
// them.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "contct/numeric/double_double.hpp"
#include "contct/rooms.hpp"

namespace contct::matrix {

class sparse_factor;
struct matrix_entry;

/// Some neighbouring rows of a symmetric matrix, all entries of each, of both triangles.
template <class Number>
struct full_rows {
  int first = 0;                          ///< the number of the first, from 0
  std::vector<std::size_t> starts = {0};  ///< [rows + 1]
  std::vector<int> columns;               ///< [entries] ascending in each row
  std::vector<Number> values;             ///< [entries]

  [[nodiscard]] int count() const { return static_cast<int>(starts.size()) - 1; }
};

/// A stiffness as the decimals of its problem give it, in numbers of 32 digits.
class remote_truth {
 public:
  remote_truth() = default;
  virtual ~remote_truth() = default;
  remote_truth(const remote_truth&) = delete;
  remote_truth& operator=(const remote_truth&) = delete;

  [[nodiscard]] virtual std::vector<numeric::double_double> diagonal() = 0;
  /// K x, each row summed from its first column on.
  [[nodiscard]] virtual std::vector<numeric::double_double> times(
      std::span<const numeric::double_double> x) = 0;
  /// Of each row, the sum of x_j over the columns j in which it has an entry.
  [[nodiscard]] virtual std::vector<double> sums(std::span<const double> x) = 0;
  /// The most entries that a row has.
  [[nodiscard]] virtual int widest_row() = 0;
  /// The factor of D K D, its entries rounded once; D diagonal: `d` [rows].
  [[nodiscard]] virtual std::unique_ptr<sparse_factor> make_factor(std::span<const double> d) = 0;
};

/// A stiffness in doubles. Its diagonal is changed here alone: nothing below counts what the others have on
/// it.
class remote_matrix {
 public:
  remote_matrix() = default;
  virtual ~remote_matrix() = default;
  remote_matrix(const remote_matrix&) = delete;
  remote_matrix& operator=(const remote_matrix&) = delete;

  [[nodiscard]] virtual std::unique_ptr<remote_matrix> copy() = 0;
  [[nodiscard]] virtual int order() const = 0;
  /// As it was made.
  [[nodiscard]] virtual std::vector<double> diagonal() = 0;
  /// K becomes D K D, D diagonal: `d` [rows].
  virtual void scale(std::span<const double> d) = 0;
  /// The entries off the diagonal that are not 0, in the columns that are marked [rows].
  [[nodiscard]] virtual std::vector<matrix_entry> entries_in(std::span<const char> columns) = 0;
  /// K x.
  [[nodiscard]] virtual std::vector<long double> times(std::span<const long double> x) = 0;
  /// The sums of the magnitudes of each row of D K D [rows].
  [[nodiscard]] virtual std::vector<double> magnitudes(std::span<const double> d) = 0;
  /// Of each row, the sum of x_j times the half unit in the last digit that its entry in column j was written
  /// with, the diagonal among them; and the same without that unit.
  [[nodiscard]] virtual std::vector<double> half_units(std::span<const double> x) = 0;
  [[nodiscard]] virtual std::vector<double> sums(std::span<const double> x) = 0;
  [[nodiscard]] virtual std::unique_ptr<sparse_factor> make_factor() = 0;
  /// What it was made from.
  [[nodiscard]] virtual std::unique_ptr<remote_truth> truth() = 0;
};

/// A remote matrix with its diagonal, which is here.
class remote_rows {
 public:
  explicit remote_rows(std::unique_ptr<remote_matrix> others)
      : others_(std::move(others)), diagonal_(others_->diagonal()) {}
  remote_rows(const remote_rows& r) : others_(r.others_->copy()), diagonal_(r.diagonal_) {}
  remote_rows(remote_rows&&) = default;
  remote_rows& operator=(const remote_rows& r) { return *this = remote_rows(r); }
  remote_rows& operator=(remote_rows&&) = default;
  ~remote_rows() = default;

  [[nodiscard]] int order() const { return static_cast<int>(diagonal_.size()); }
  [[nodiscard]] double& diagonal(std::size_t row) { return diagonal_[row]; }
  [[nodiscard]] double diagonal(std::size_t row) const { return diagonal_[row]; }
  [[nodiscard]] remote_matrix& others() const { return *others_; }

 private:
  std::unique_ptr<remote_matrix> others_;
  std::vector<double> diagonal_;
};

}  // namespace contct::matrix
