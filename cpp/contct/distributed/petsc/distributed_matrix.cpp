#include "contct/distributed/petsc/distributed_matrix.hpp"

#include <algorithm>
#include <new>
#include <stdexcept>
#include <string>

namespace contct::distributed::petsc {
namespace {

// MUMPS' parameters, numbered as in its manual.
constexpr PetscInt root_by_one_process = 13;  // ICNTL: 1 counts every pivot that is not positive
constexpr PetscInt more_space_percent = 14;
constexpr PetscInt compress_blocks = 35;
constexpr PetscInt factor_entries = 3;  // INFOG: estimated; in millions where negative
constexpr PetscInt negative_pivots = 12;
constexpr PetscInt estimated_flops = 1;  // RINFOG

// INFOG(1).
constexpr int singular = -10, not_definite_root = -40, not_allocated = -13,
              no_room[] = {-8, -9, -14, -15, -17, -20};

PetscInt infog(Mat factor, PetscInt which) {
  PetscInt value = 0;
  succeed(MatMumpsGetInfog(factor, which, &value));
  return value;
}

/// Numbers that MUMPS gives as an int, or in millions and negative.
double large(PetscInt number) {
  return number < 0 ? -1e6 * static_cast<double>(number) : static_cast<double>(number);
}

/// Unit vectors as the rows of a sparse matrix that rank 0 has whole: MUMPS then skips what stays zero.
class unit_rows {
 public:
  unit_rows(MPI_Comm job, std::span<const int> units, PetscInt order, PetscInt width) {
    int rank = 0;
    MPI_Comm_rank(job, &rank);
    const bool here = rank == 0;
    succeed(MatCreate(job, &rows_));
    succeed(MatSetSizes(rows_, here ? width : 0, here ? order : 0, width, order));
    succeed(MatSetType(rows_, MATAIJ));
    succeed(MatSeqAIJSetPreallocation(rows_, 1, nullptr));
    succeed(MatMPIAIJSetPreallocation(rows_, 1, nullptr, 0, nullptr));
    for (std::size_t i = 0; here && i < units.size(); ++i)
      if (units[i] >= 0) succeed(MatSetValue(rows_, static_cast<PetscInt>(i), units[i], 1.0, INSERT_VALUES));
    succeed(MatAssemblyBegin(rows_, MAT_FINAL_ASSEMBLY));
    succeed(MatAssemblyEnd(rows_, MAT_FINAL_ASSEMBLY));
  }
  ~unit_rows() { (void)MatDestroy(&rows_); }
  unit_rows(const unit_rows&) = delete;
  unit_rows& operator=(const unit_rows&) = delete;
  [[nodiscard]] Mat get() const { return rows_; }

 private:
  Mat rows_ = nullptr;
};

}  // namespace

void succeed(PetscErrorCode code) {
  if (code == 0) return;  // PETSC_SUCCESS since PETSc 3.19
  if (code == PETSC_ERR_MEM) throw std::bad_alloc();
  const char* words = nullptr;
  (void)PetscErrorMessage(code, &words, nullptr);
  throw std::runtime_error("PETSc failed: " + std::string(words != nullptr ? words : "it does not say why"));
}

own_rows::own_rows(MPI_Comm job, int order) {
  PetscInt all = order;
  PetscInt own = PETSC_DECIDE;
  succeed(PetscSplitOwnership(job, &own, &all));
  int end = 0;
  count = static_cast<int>(own);
  MPI_Scan(&count, &end, 1, MPI_INT, MPI_SUM, job);
  first = end - count;
}

distributed_matrix::distributed_matrix(MPI_Comm job, int order, const upper_rows& own)
    : job_(job), rows_(job, order) {
  succeed(MatCreate(job, &matrix_));
  succeed(MatSetSizes(matrix_, rows_.count, rows_.count, order, order));
  succeed(MatSetType(matrix_, MATSBAIJ));
  succeed(
      MatSeqSBAIJSetPreallocationCSR(matrix_, 1, own.starts.data(), own.columns.data(), own.values.data()));
  succeed(
      MatMPISBAIJSetPreallocationCSR(matrix_, 1, own.starts.data(), own.columns.data(), own.values.data()));
  succeed(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
  succeed(MatCreateVecs(matrix_, &x_, &b_));
  analyse();
}

distributed_matrix::~distributed_matrix() {
  (void)VecDestroy(&x_);
  (void)VecDestroy(&b_);
  for (Mat* m : {&solutions_, &factor_, &matrix_}) (void)MatDestroy(m);
}

void distributed_matrix::analyse() {
  succeed(MatDestroy(&factor_));
  succeed(MatGetFactor(matrix_, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor_));
  succeed(MatMumpsSetIcntl(factor_, root_by_one_process, 1));
  succeed(MatMumpsSetIcntl(factor_, compress_blocks, 0));
  MatFactorInfo info;
  succeed(MatFactorInfoInitialize(&info));
  succeed(MatCholeskyFactorSymbolic(factor_, matrix_, nullptr, &info));
  succeed(MatMumpsGetRinfog(factor_, estimated_flops, &flops_));
  bytes_ = sizeof(double) * large(infog(factor_, factor_entries));
}

factored distributed_matrix::factor(std::span<const double> diagonal) {
  for (int i = 0; i < rows_.count; ++i)
    succeed(MatSetValue(matrix_, rows_.first + i, rows_.first + i, diagonal[static_cast<std::size_t>(i)],
                        INSERT_VALUES));
  succeed(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
  succeed(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
  constexpr PetscInt most_space = 1000;
  for (PetscInt space = 0;; space = std::max<PetscInt>(2 * space, 50)) {
    if (mumps_said().first < 0) analyse();  // PETSc factors no more once MUMPS has failed
    if (space > 0) succeed(MatMumpsSetIcntl(factor_, more_space_percent, space));
    MatFactorInfo info;
    succeed(MatFactorInfoInitialize(&info));
    succeed(MatCholeskyFactorNumeric(factor_, matrix_, &info));
    const int code = mumps_said().first;
    if (code == singular || code == not_definite_root) return factored::not_definite;
    if (code == not_allocated) return factored::no_memory;
    if (code >= 0) return infog(factor_, negative_pivots) == 0 ? factored::yes : factored::not_definite;
    const bool lacks_room = std::find(std::begin(no_room), std::end(no_room), code) != std::end(no_room);
    if (!lacks_room || space >= most_space) return factored::failed;
  }
}

std::pair<int, int> distributed_matrix::mumps_said() const {
  return {static_cast<int>(infog(factor_, 1)), static_cast<int>(infog(factor_, 2))};
}

void distributed_matrix::solve(std::span<double> b) {
  double* entries = nullptr;
  succeed(VecGetArray(b_, &entries));
  std::copy(b.begin(), b.end(), entries);
  succeed(VecRestoreArray(b_, &entries));
  succeed(MatSolve(factor_, b_, x_));
  const double* solution = nullptr;
  succeed(VecGetArrayRead(x_, &solution));
  std::copy_n(solution, b.size(), b.begin());
  succeed(VecRestoreArrayRead(x_, &solution));
}

std::vector<double> distributed_matrix::solve_units(std::span<const int> units, std::span<const int> at,
                                                    int width) {
  PetscInt order = 0;
  succeed(MatGetSize(matrix_, &order, nullptr));
  if (solutions_ == nullptr)
    succeed(MatCreateDense(job_, rows_.count, PETSC_DECIDE, order, width, nullptr, &solutions_));
  const unit_rows right_sides(job_, units, order, width);
  succeed(MatMatTransposeSolve(factor_, right_sides.get(), solutions_));
  const double* columns = nullptr;
  PetscInt length = 0;
  succeed(MatDenseGetLDA(solutions_, &length));
  succeed(MatDenseGetArrayRead(solutions_, &columns));
  std::vector<double> found;
  for (const int row : at)
    for (int i = 0; has(row) && i < width; ++i) found.push_back(columns[i * length + row - rows_.first]);
  succeed(MatDenseRestoreArrayRead(solutions_, &columns));
  return found;
}

}  // namespace contct::distributed::petsc
