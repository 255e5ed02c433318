// A factor that the processes of an MPI job share. The program links neither MPI nor PETSc: the module
// contct_petsc.so, which is loaded on demand, links both.
#pragma once

#include <memory>

#include "contct/linear/sparse_factor.hpp"

namespace contct {

/// An MPI job, as one rank uses it. Rank 0 runs the program and has the matrices; the other ranks execute its
/// commands and keep parts of the factors. If a rank fails, it prints a message and ends the job.
class mpi_job {
 public:
  mpi_job() = default;
  virtual ~mpi_job() = default;
  mpi_job(const mpi_job&) = delete;
  mpi_job& operator=(const mpi_job&) = delete;

  [[nodiscard]] virtual int rank() const = 0;  ///< from 0

  /// On ranks other than 0: executes the commands of rank 0 until rank 0 leaves.
  virtual void serve() = 0;

  /// On rank 0: makes a factor that all ranks share, for matrices that differ from `a` only on the diagonal,
  /// and finds its order of rows. The factor must be destroyed before `leave`. Its functions throw
  /// std::bad_alloc, or std::runtime_error if MUMPS fails for another reason.
  [[nodiscard]] virtual std::unique_ptr<matrix_factor> share(const sparse_columns& a) = 0;

  /// On rank 0: ends the other ranks and MPI. No function may be called afterwards.
  virtual void leave() noexcept = 0;
};

/// The function that the module exports with C linkage. Joins MPI, once in a process, and returns the job.
/// Returns null if the `version` of the program differs from that of the module, because program and module
/// share C++ classes.
using join_function = mpi_job*(const char* version);
inline constexpr const char* join_symbol = "contct_petsc_join";

/// The job that this process has joined; null if it has joined none.
[[nodiscard]] mpi_job*& joined_job();

}  // namespace contct
