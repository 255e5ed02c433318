// A symmetric positive definite matrix that is distributed by rows, and its factor by MUMPS; or, where that
// is too large, conjugate gradients with algebraic multigrid. Every function
// is collective: all ranks call it, each for its own rows.
#pragma once

#include <petscksp.h>

#include <span>
#include <vector>

namespace contct::distributed::petsc {

/// Throws std::bad_alloc or std::runtime_error, with PETSc's words, where a call to PETSc has failed.
void succeed(PetscErrorCode code);

/// Which rows a rank has: neighbouring ones, as many as any other rank, or one more.
struct own_rows {
  own_rows(MPI_Comm job, int order);
  int first = 0;  ///< from 0
  int count = 0;
};

/// The upper triangle of some rows: row i has the columns `columns[starts[i]]` up to `starts[i + 1]`,
/// ascending, its diagonal first. Columns are those of the whole matrix, from 0.
struct upper_rows {
  std::vector<PetscInt> starts = {0};
  std::vector<PetscInt> columns;
  std::vector<double> values;
};

/// What motions that a structure has without its supports do at own rows [motions][own rows].
using own_motions = std::vector<std::vector<double>>;

/// How a factorisation came out; the same on every rank.
enum class factored : int { yes, not_definite, no_memory, failed };

class distributed_matrix {
 public:
  /// Analyses the matrix: finds the order in which it is factored. Where the factor would take more memory
  /// than there is, no factor is made: `solve` takes conjugate gradients with algebraic multigrid.
  distributed_matrix(MPI_Comm job, int order, const upper_rows& own, const own_motions& motions = {});
  ~distributed_matrix();
  distributed_matrix(const distributed_matrix&) = delete;
  distributed_matrix& operator=(const distributed_matrix&) = delete;

  [[nodiscard]] const own_rows& rows() const { return rows_; }

  /// Products and sums that a factorisation takes, and the bytes of the factor, both as MUMPS estimates them.
  [[nodiscard]] double flops() const { return flops_; }
  [[nodiscard]] double bytes() const { return bytes_; }

  /// Factor the matrix with `diagonal` for its own [own rows].
  [[nodiscard]] factored factor(std::span<const double> diagonal);
  /// No fewer than the entries of the last factor; infinite where there is none.
  [[nodiscard]] double entries() const;
  /// MUMPS' INFOG(1) and INFOG(2) of the last factorisation.
  [[nodiscard]] std::pair<int, int> mumps_said() const;

  /// Solve in place [own rows]. By conjugate gradients, until the residual is `residual_share` of b; throws
  /// std::runtime_error where it does not become so small.
  void solve(std::span<double> b);
  static constexpr double residual_share = 1e-10;

  /// Solve for the unit vectors of `units`, rows of the whole matrix; one of -1 leaves zeros. The solutions
  /// at those rows of `at` that this rank has, in their order, for all units each: [own of at][width].
  [[nodiscard]] std::vector<double> solve_units(std::span<const int> units, std::span<const int> at,
                                                int width);

 private:
  void analyse();
  [[nodiscard]] bool fits() const;
  void prepare_multigrid(const own_motions& motions);
  [[nodiscard]] bool set_up_multigrid();
  void solve_iteratively();
  [[nodiscard]] std::vector<double> solve_units_iteratively(std::span<const int> units,
                                                            std::span<const int> at, int width);
  [[nodiscard]] bool has(int row) const { return row >= rows_.first && row < rows_.first + rows_.count; }

  MPI_Comm job_;
  own_rows rows_;
  double flops_ = 0.0, bytes_ = 0.0;
  Mat matrix_ = nullptr;
  Mat factor_ = nullptr;     // by MUMPS
  KSP iterative_ = nullptr;  // in its place
  Mat all_entries_ = nullptr;
  MatNullSpace motions_ = nullptr;
  Mat solutions_ = nullptr;  // of a block of unit vectors; made when first asked for
  Vec b_ = nullptr, x_ = nullptr;
};

}  // namespace contct::distributed::petsc
