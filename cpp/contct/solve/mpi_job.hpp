// A factor that the processes of an MPI job share. The program links neither MPI nor PETSc: the module
// contct_petsc.so has both, and is loaded when it is asked for.
#pragma once

#include <memory>

#include "contct/matrix/sparse_factor.hpp"

namespace contct {

/// The job as one of its ranks sees it. Rank 0 runs the program and has the matrices; the others serve it,
/// and keep their parts of the factors. Where a rank fails, the job ends with its message.
class mpi_job {
 public:
  mpi_job() = default;
  virtual ~mpi_job() = default;
  mpi_job(const mpi_job&) = delete;
  mpi_job& operator=(const mpi_job&) = delete;

  [[nodiscard]] virtual int rank() const = 0;  ///< from 0

  /// Other ranks than 0: do what rank 0 asks for, until it leaves.
  virtual void serve() = 0;

  /// Rank 0: find the order in which all ranks factor `a` together. The result must be destroyed before
  /// `leave`. Its functions throw std::bad_alloc, and std::runtime_error for any other failure of MUMPS.
  [[nodiscard]] virtual std::unique_ptr<sparse_factor> share(const sparse_columns& a) = 0;

  /// Rank 0: end the other ranks and MPI. Nothing else may be called after it.
  virtual void leave() noexcept = 0;
};

/// The function that the module exports, with C linkage: join MPI, once a process. Null if `version`, the
/// program's, differs from the module's: the two share C++ classes.
using join_function = mpi_job*(const char* version);
inline constexpr const char* join_symbol = "contct_petsc_join";

/// The job that this process has joined; null if it has joined none.
[[nodiscard]] mpi_job* joined_job();

/// `job` must live until the process ends, or until null takes its place.
void set_joined_job(mpi_job* job);

}  // namespace contct
