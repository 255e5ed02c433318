#include "app/job.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "contct/solve/mpi_job.hpp"

namespace contct {
namespace {

namespace fs = std::filesystem;

constexpr const char* how_to_get_it =
    ". It is built with the program where PETSc with MUMPS and MPI are found; on Debian: apt-get install "
    "libpetsc-real-dev, then configure and build again";

bool asks_for_petsc(const std::vector<std::string>& arguments) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  for (auto a = arguments.begin(); a != end; ++a)
    if (*a == "--engine=petsc" || (*a == "--engine" && a + 1 != end && a[1] == "petsc")) return true;
  return false;
}

/// Beside the program, or where it is installed.
std::string file_of_module() {
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  const std::string beside = (here / "contct_petsc.so").string();
  const std::string installed = (here / CONTCT_INSTALLED_MODULES / "contct_petsc.so").lexically_normal();
  for (const std::string& file : {beside, installed})
    if (fs::exists(file)) return file;
  throw std::runtime_error("engine petsc: found no module " + beside + " or " + installed + how_to_get_it);
}

mpi_job& join_job() {
  const std::string file = file_of_module();
  void* const module = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    const char* const why = dlerror();  // NOLINT(concurrency-mt-unsafe): no other thread loads anything
    throw std::runtime_error("engine petsc: " + file + " cannot be loaded: " + why + how_to_get_it);
  }
  // NOLINTNEXTLINE(*-reinterpret-cast): dlsym has untyped addresses
  const auto join = reinterpret_cast<join_function*>(dlsym(module, join_symbol));
  mpi_job* const job = join != nullptr ? join(CONTCT_VERSION) : nullptr;
  if (job == nullptr)
    throw std::runtime_error("engine petsc: " + file +
                             ": found a module of another version; allowed: that of the program");
  return *job;
}

}  // namespace

bool runs_the_program(const std::vector<std::string>& arguments) {
  if (!asks_for_petsc(arguments)) return true;
  mpi_job& job = join_job();
  if (job.rank() != 0) {
    job.serve();
    return false;
  }
  set_joined_job(&job);
  // mpirun gives rank 0 a terminal of its own, whatever it writes to itself.
  (void)setenv("NO_COLOR", "1", 0);  // NOLINT(concurrency-mt-unsafe): there is no other thread yet
  return true;
}

void leave_job() noexcept {
  mpi_job* const job = joined_job();
  set_joined_job(nullptr);
  if (job != nullptr) job->leave();
}

}  // namespace contct
