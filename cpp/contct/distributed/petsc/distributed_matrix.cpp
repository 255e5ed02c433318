#include "contct/distributed/petsc/distributed_matrix.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "contct/text/memory.hpp"

namespace contct::distributed::petsc {
namespace {

// MUMPS' parameters, numbered as in its manual.
constexpr PetscInt root_by_one_process = 13;  // ICNTL: 1 counts every pivot that is not positive
constexpr PetscInt more_space_percent = 14;
constexpr PetscInt scaling = 8;
constexpr PetscInt compress_blocks = 35;
constexpr PetscInt most_mib_of_a_rank = 16;  // INFOG, estimated
constexpr PetscInt factor_entries = 3;       // INFOG: estimated; in millions where negative
constexpr PetscInt space_of_factor = 9, entries_of_factor = 29;  // INFOG, after a factorisation; likewise
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

/// Of this process; 0 where the system does not tell.
double bytes_in_use() {
  long pages = 0;
  std::ifstream("/proc/self/statm").ignore(std::numeric_limits<std::streamsize>::max(), ' ') >> pages;
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

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

distributed_matrix::distributed_matrix(MPI_Comm job, int order, const upper_rows& own,
                                       const own_motions& motions)
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
  if (!fits()) prepare_multigrid(motions);
}

distributed_matrix::~distributed_matrix() {
  (void)VecDestroy(&x_);
  (void)VecDestroy(&b_);
  (void)KSPDestroy(&iterative_);
  (void)MatNullSpaceDestroy(&motions_);
  for (Mat* m : {&solutions_, &factor_, &all_entries_, &matrix_}) (void)MatDestroy(m);
}

/// In the memory of the machine, of which all its ranks have taken some: for the engine's factor, when this
/// is the certificate's.
bool distributed_matrix::fits() const {
  const double takes = 0x1p20 * static_cast<double>(infog(factor_, most_mib_of_a_rank));
  double all = takes + bytes_in_use();
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(job_, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_DOUBLE, MPI_SUM, machine);
  MPI_Comm_free(&machine);
  int fits = all <= static_cast<double>(text::memory_limit()) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &fits, 1, MPI_INT, MPI_MIN, job_);
  if (fits == 0 && rows_.first == 0 && rows_.count > 0)
    (void)std::fprintf(
        stderr,
        "contct: warning: a factor would take %s a rank: conjugate gradients with multigrid solve "
        "instead, to a residual of %.0e of the load, and prove nothing\n",
        text::bytes_words(static_cast<std::int64_t>(takes)).c_str(), residual_share);
  return fits != 0;
}

void distributed_matrix::prepare_multigrid(const own_motions& motions) {
  succeed(MatDestroy(&factor_));
  std::vector<Vec> all(motions.size());
  for (std::size_t m = 0; m < motions.size(); ++m) {
    succeed(VecDuplicate(x_, &all[m]));
    double* entries = nullptr;
    succeed(VecGetArray(all[m], &entries));
    std::copy(motions[m].begin(), motions[m].end(), entries);
    succeed(VecRestoreArray(all[m], &entries));
    for (std::size_t before = 0; before < m; ++before) {
      PetscScalar share = 0.0;
      succeed(VecDot(all[m], all[before], &share));
      succeed(VecAXPY(all[m], -share, all[before]));
    }
    succeed(VecNormalize(all[m], nullptr));
  }
  if (!motions.empty())
    succeed(MatNullSpaceCreate(job_, PETSC_FALSE, static_cast<PetscInt>(all.size()), all.data(), &motions_));
  for (Vec& v : all) succeed(VecDestroy(&v));
  succeed(KSPCreate(job_, &iterative_));
  succeed(KSPSetType(iterative_, KSPCG));
  PC multigrid = nullptr;
  succeed(KSPGetPC(iterative_, &multigrid));
  succeed(PCSetType(multigrid, PCGAMG));
  constexpr PetscInt most_iterations = 20000;
  succeed(KSPSetNormType(iterative_, KSP_NORM_UNPRECONDITIONED));
  succeed(KSPSetTolerances(iterative_, residual_share, PETSC_DEFAULT, PETSC_DEFAULT, most_iterations));
}

bool distributed_matrix::set_up_multigrid() {
  succeed(MatDestroy(&all_entries_));
  succeed(MatConvert(matrix_, MATAIJ, MAT_INITIAL_MATRIX, &all_entries_));
  succeed(MatSetOption(all_entries_, MAT_SPD, PETSC_TRUE));
  if (motions_ != nullptr) succeed(MatSetNearNullSpace(all_entries_, motions_));
  succeed(KSPSetOperators(iterative_, all_entries_, all_entries_));
  succeed(KSPSetUp(iterative_));
  Vec diagonal = nullptr;
  PetscReal least = 0.0;
  succeed(VecDuplicate(x_, &diagonal));
  succeed(MatGetDiagonal(all_entries_, diagonal));
  succeed(VecMin(diagonal, nullptr, &least));
  succeed(VecDestroy(&diagonal));
  return least > 0.0;
}

void distributed_matrix::analyse() {
  succeed(MatDestroy(&factor_));
  succeed(MatGetFactor(matrix_, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor_));
  succeed(MatMumpsSetIcntl(factor_, root_by_one_process, 1));
  succeed(MatMumpsSetIcntl(factor_, compress_blocks, 0));
  succeed(MatMumpsSetIcntl(factor_, scaling, 0));  // a bound on its rounding is of the matrix as it is
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
  if (iterative_ != nullptr) return set_up_multigrid() ? factored::yes : factored::not_definite;
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

double distributed_matrix::entries() const {
  if (iterative_ != nullptr) return std::numeric_limits<double>::infinity();
  constexpr double to_be_sure = 1.1;  // what it counts is not said to the last entry
  return to_be_sure *
         std::max(large(infog(factor_, space_of_factor)), large(infog(factor_, entries_of_factor)));
}

std::pair<int, int> distributed_matrix::mumps_said() const {
  return {static_cast<int>(infog(factor_, 1)), static_cast<int>(infog(factor_, 2))};
}

void distributed_matrix::solve(std::span<double> b) {
  double* entries = nullptr;
  succeed(VecGetArray(b_, &entries));
  std::copy(b.begin(), b.end(), entries);
  succeed(VecRestoreArray(b_, &entries));
  if (iterative_ != nullptr) {
    solve_iteratively();
  } else {
    succeed(MatSolve(factor_, b_, x_));
  }
  const double* solution = nullptr;
  succeed(VecGetArrayRead(x_, &solution));
  std::copy_n(solution, b.size(), b.begin());
  succeed(VecRestoreArrayRead(x_, &solution));
}

/// From b_ to x_.
void distributed_matrix::solve_iteratively() {
  succeed(KSPSolve(iterative_, b_, x_));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  PetscReal left = 0.0;
  PetscReal load = 0.0;
  PetscInt iterations = 0;
  succeed(KSPGetConvergedReason(iterative_, &reason));
  if (reason > 0) return;
  succeed(KSPGetResidualNorm(iterative_, &left));
  succeed(KSPGetIterationNumber(iterative_, &iterations));
  succeed(VecNorm(b_, NORM_2, &load));
  char words[200];
  (void)std::snprintf(words, sizeof words,
                      "conjugate gradients with multigrid came to a residual of %.1e of the load in %d "
                      "iterations; allowed: at most %.0e",
                      left / load, static_cast<int>(iterations), residual_share);
  throw std::runtime_error(words);
}

std::vector<double> distributed_matrix::solve_units_iteratively(std::span<const int> units,
                                                                std::span<const int> at, int width) {
  std::vector<std::vector<double>> columns;
  for (const int unit : units) {
    std::vector<double>& x = columns.emplace_back(static_cast<std::size_t>(rows_.count), 0.0);
    if (unit < 0) continue;
    if (has(unit)) x[static_cast<std::size_t>(unit - rows_.first)] = 1.0;
    solve(x);
  }
  columns.resize(static_cast<std::size_t>(width),
                 std::vector<double>(static_cast<std::size_t>(rows_.count), 0.0));
  std::vector<double> found;
  for (const int row : at)
    for (int i = 0; has(row) && i < width; ++i)
      found.push_back(columns[static_cast<std::size_t>(i)][static_cast<std::size_t>(row - rows_.first)]);
  return found;
}

std::vector<double> distributed_matrix::solve_units(std::span<const int> units, std::span<const int> at,
                                                    int width) {
  if (iterative_ != nullptr) return solve_units_iteratively(units, at, width);
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
