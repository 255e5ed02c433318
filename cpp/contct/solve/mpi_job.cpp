#include "contct/solve/mpi_job.hpp"

namespace contct::solve {
namespace {

mpi_job* joined = nullptr;  // MPI has no more than one for a process

}  // namespace

mpi_job* joined_job() {
  return joined;
}

void set_joined_job(mpi_job* job) {
  joined = job;
}

}  // namespace contct::solve
