// The module contct_petsc: the ranks of an MPI job share a factor by PETSc and MUMPS. Rank 0 owns all rows of
// the matrices, the right-hand sides and the solutions; MUMPS distributes the factor. Rank 0 sends a command
// before each operation of all ranks.
#include <petscmat.h>
#include <petscsys.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "contct/linear/mpi_job.hpp"

namespace contct {
namespace {

static_assert(std::is_same_v<PetscInt, int> && std::is_same_v<PetscScalar, double>);

// MUMPS' parameters, numbered as in its manual.
constexpr PetscInt root_by_one_process = 13;  // ICNTL; 1: count every pivot that is not positive
constexpr PetscInt more_space_percent = 14;
constexpr PetscInt negative_pivots = 12;  // INFOG
constexpr PetscInt estimated_flops = 1;   // RINFOG

// INFOG(1) after a factorisation.
constexpr int singular = -10, not_definite_root = -40, not_allocated = -13;
constexpr int no_room[] = {-8, -9, -14, -15, -17, -20};

/// Throws std::bad_alloc, or std::runtime_error with PETSc's message, if a call to PETSc has failed.
void succeed(PetscErrorCode code) {
  if (code == 0) return;  // PETSC_SUCCESS since PETSc 3.19
  if (code == PETSC_ERR_MEM) throw std::bad_alloc();
  const char* words = nullptr;
  (void)PetscErrorMessage(code, &words, nullptr);
  throw std::runtime_error("PETSc failed: " +
                           std::string(words != nullptr ? words : "no reason was returned"));
}

/// The result of a factorisation; the same on every rank.
enum class outcome : int { factored, not_definite, no_memory, failed };

/// A rank's part of a matrix and its factor. All ranks call each function together; only the arguments of
/// rank 0 are used.
class part_of_factor {
 public:
  /// Finds the order in which the matrix is factored. `a`: null on ranks other than 0.
  part_of_factor(int order, const sparse_columns* a) : order_(order), own_(a != nullptr ? order : 0) {
    static const sparse_columns none;
    const sparse_columns& own = a != nullptr ? *a : none;
    succeed(MatCreate(PETSC_COMM_WORLD, &matrix_));
    succeed(MatSetSizes(matrix_, own_, own_, order, order));
    succeed(MatSetType(matrix_, MATSBAIJ));
    // Column j of a lower triangle is row j of the upper one, diagonal first.
    for (const auto preallocate : {MatSeqSBAIJSetPreallocationCSR, MatMPISBAIJSetPreallocationCSR})
      succeed(preallocate(matrix_, 1, own.starts.data(), own.rows.data(), own.values.data()));
    succeed(MatSetOption(matrix_, MAT_SPD, PETSC_TRUE));
    analyse();
  }
  ~part_of_factor() {
    for (Mat* m : {&factor_, &matrix_}) (void)MatDestroy(m);
  }
  part_of_factor(const part_of_factor&) = delete;
  part_of_factor& operator=(const part_of_factor&) = delete;

  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] double flops() const {
    PetscReal all = 0.0;
    succeed(MatMumpsGetRinfog(factor_, estimated_flops, &all));
    return all;
  }
  [[nodiscard]] PetscInt infog(PetscInt which) const {
    PetscInt value = 0;
    succeed(MatMumpsGetInfog(factor_, which, &value));
    return value;
  }

  /// Factors the matrix with `diagonal` [order] as its diagonal.
  [[nodiscard]] outcome factor(const double* diagonal) {
    for (int row = 0; row < own_; ++row)
      succeed(MatSetValue(matrix_, row, row, diagonal[row], INSERT_VALUES));
    succeed(MatAssemblyBegin(matrix_, MAT_FINAL_ASSEMBLY));
    succeed(MatAssemblyEnd(matrix_, MAT_FINAL_ASSEMBLY));
    constexpr PetscInt most_space = 1000;
    for (PetscInt space = 0;; space = std::max<PetscInt>(2 * space, 50)) {
      if (infog(1) < 0) analyse();  // after a failure of MUMPS, PETSc factors only a new object
      if (space > 0) succeed(MatMumpsSetIcntl(factor_, more_space_percent, space));
      MatFactorInfo info;
      succeed(MatFactorInfoInitialize(&info));
      succeed(MatCholeskyFactorNumeric(factor_, matrix_, &info));
      const int code = infog(1);
      if (code == singular || code == not_definite_root) return outcome::not_definite;
      if (code == not_allocated) return outcome::no_memory;
      if (code >= 0) return infog(negative_pivots) == 0 ? outcome::factored : outcome::not_definite;
      const bool lacks_room = std::find(std::begin(no_room), std::end(no_room), code) != std::end(no_room);
      if (!lacks_room || space >= most_space) return outcome::failed;
    }
  }

  /// Solves in place for `columns` right-hand sides, one after the other.
  void solve(double* b, int columns) {
    Mat right_sides = nullptr;
    Mat solutions = nullptr;
    for (const auto& [sides, data] : {std::pair(&right_sides, b), {&solutions, nullptr}})
      succeed(MatCreateDense(PETSC_COMM_WORLD, own_, PETSC_DECIDE, order_, columns, data, sides));
    succeed(MatMatSolve(factor_, right_sides, solutions));
    succeed(MatDestroy(&right_sides));
    const double* found = nullptr;
    succeed(MatDenseGetArrayRead(solutions, &found));
    if (own_ > 0) std::copy_n(found, std::int64_t{own_} * columns, b);
    succeed(MatDenseRestoreArrayRead(solutions, &found));
    succeed(MatDestroy(&solutions));
  }

 private:
  void analyse() {
    succeed(MatDestroy(&factor_));
    succeed(MatGetFactor(matrix_, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &factor_));
    succeed(MatMumpsSetIcntl(factor_, root_by_one_process, 1));
    MatFactorInfo info;
    succeed(MatFactorInfoInitialize(&info));
    succeed(MatCholeskyFactorSymbolic(factor_, matrix_, nullptr, &info));
  }

  int order_, own_;  // own_: rows of this rank
  Mat matrix_ = nullptr, factor_ = nullptr;
};

/// The commands of rank 0 to all ranks.
enum class verb : int { make, factor, solve, drop, leave };
struct command {
  verb what;
  int number = 0;  ///< number of the factor
  int count = 0;   ///< order of a new factor, or number of right-hand sides
};

class petsc_job final : public mpi_job {
 public:
  petsc_job() {
    std::string words[] = {"contct", "-no_signal_handler", "-skip_petscrc", "-options_left", "no"};
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    int argc = static_cast<int>(pointers.size());
    pointers.push_back(nullptr);
    char** argv = pointers.data();
    MPI_Init(nullptr, nullptr);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    together([&] {
      succeed(PetscInitialize(&argc, &argv, nullptr, nullptr));
      succeed(PetscPushErrorHandler(PetscReturnErrorHandler, nullptr));
    });
  }

  [[nodiscard]] int rank() const override { return rank_; }
  void serve() override {
    for (command c = next(); c.what != verb::leave; c = next())
      together([&] { (void)act(c, nullptr, nullptr); });
    end();
  }
  [[nodiscard]] std::unique_ptr<matrix_factor> share(const sparse_columns& a) override;
  void leave() noexcept override {
    tell({verb::leave});
    end();
  }

  /// On rank 0: makes all ranks execute `c`.
  outcome command_all(const command& c, double* data, const sparse_columns* a = nullptr) {
    tell(c);
    outcome came_out = outcome::factored;
    together([&] { came_out = act(c, data, a); });
    return came_out;
  }
  [[nodiscard]] part_of_factor& at(int number) { return *factors_.at(number); }

 private:
  outcome act(const command& c, double* data, const sparse_columns* a) {
    if (c.what == verb::make) factors_[c.number] = std::make_unique<part_of_factor>(c.count, a);
    if (c.what == verb::factor) return at(c.number).factor(data);
    if (c.what == verb::solve) at(c.number).solve(data, c.count);
    if (c.what == verb::drop) factors_.erase(c.number);
    return outcome::factored;
  }

  /// Does this rank's part of the work of all ranks. If `work` throws, prints the reason and ends the job,
  /// because the other ranks would wait for this rank for ever.
  template <class Work>
  void together(Work work) {
    std::string why = "out of memory";
    try {
      return work();
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& e) {
      why = e.what();
    }
    (void)std::fprintf(stderr, "contct: rank %d: %s\n", rank_, why.c_str());
    constexpr int bad_input = 2;
    MPI_Abort(MPI_COMM_WORLD, bad_input);
    _exit(bad_input);
  }

  static void tell(command c) {
    MPI_Request sent = MPI_REQUEST_NULL;
    MPI_Ibcast(&c, sizeof c, MPI_BYTE, 0, MPI_COMM_WORLD, &sent);
    MPI_Wait(&sent, MPI_STATUS_IGNORE);
  }

  /// Waits for a command of rank 0. The longer the wait, the less often it polls.
  static command next() {
    command c{verb::leave};
    MPI_Request coming = MPI_REQUEST_NULL;
    MPI_Ibcast(&c, sizeof c, MPI_BYTE, 0, MPI_COMM_WORLD, &coming);
    using clock = std::chrono::steady_clock;
    const auto begun = clock::now();
    for (int arrived = 0;;) {
      MPI_Test(&coming, &arrived, MPI_STATUS_IGNORE);
      if (arrived != 0) return c;
      const auto waited = std::chrono::duration_cast<std::chrono::microseconds>(clock::now() - begun).count();
      constexpr std::int64_t patience = 2000;  // microseconds
      constexpr std::int64_t longest = 1000;
      if (waited > patience) (void)usleep(static_cast<useconds_t>(std::min(waited / 64, longest)));
    }
  }

  void end() {
    factors_.clear();
    (void)PetscFinalize();
    MPI_Barrier(MPI_COMM_WORLD);  // a rank that ends first with a status other than 0 ends the job
    MPI_Finalize();
  }

  int rank_ = 0, made_ = 0;
  std::map<int, std::unique_ptr<part_of_factor>> factors_;
};

/// A factor of all ranks, as rank 0 uses it.
class shared_factor final : public matrix_factor {
 public:
  shared_factor(petsc_job& job, int number, const sparse_columns& a) : job_(job), number_(number) {
    (void)job_.command_all({verb::make, number_, a.order()}, nullptr, &a);
  }
  ~shared_factor() override { (void)job_.command_all({verb::drop, number_}, nullptr); }

  [[nodiscard]] double flops() const override { return job_.at(number_).flops(); }

  [[nodiscard]] bool factor(const sparse_columns& a) override {
    std::vector<double> data;
    data.reserve(a.order());
    for (int row = 0; row < a.order(); ++row) data.push_back(a.diagonal(row));
    const outcome came_out = job_.command_all({verb::factor, number_}, data.data());
    if (came_out == outcome::no_memory) throw std::bad_alloc();
    if (came_out == outcome::failed)
      throw std::runtime_error(
          "MUMPS cannot factor the stiffness: INFOG(1) = " + std::to_string(job_.at(number_).infog(1)) +
          ", INFOG(2) = " + std::to_string(job_.at(number_).infog(2)));
    return came_out == outcome::factored;
  }

  void solve(std::span<double> b) override {
    const int columns = static_cast<int>(b.size()) / job_.at(number_).order();
    (void)job_.command_all({verb::solve, number_, columns}, b.data());
  }

 private:
  petsc_job& job_;
  int number_;
};

std::unique_ptr<matrix_factor> petsc_job::share(const sparse_columns& a) {
  return std::make_unique<shared_factor>(*this, made_++, a);
}

}  // namespace
}  // namespace contct

extern "C" __attribute__((visibility("default"))) contct::mpi_job* contct_petsc_join(const char* version) {
  if (std::string(version) != CONTCT_VERSION) return nullptr;
  return new contct::petsc_job();  // exists until the process ends
}
