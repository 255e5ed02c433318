#include "app/program.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/outputs.hpp"
#include "app/problem_runs.hpp"
#include "contct/linear/mpi_job.hpp"
#include "contct/number/rational.hpp"

namespace contct {
namespace {

namespace fs = std::filesystem;

constexpr const char* how_to_get_it =
    ". The module is built if PETSc with MUMPS and MPI is installed; on Debian: apt-get install "
    "libpetsc-real-dev, then configure and build again";

bool asks_for_petsc(const std::vector<std::string>& arguments) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  for (auto a = arguments.begin(); a != end; ++a)
    if (*a == "--engine=petsc" || (*a == "--engine" && a + 1 != end && a[1] == "petsc")) return true;
  return false;
}

mpi_job& join_job() {
  const std::vector<std::string> places = beside_program("contct_petsc.so", {".", CONTCT_INSTALLED_MODULES});
  const auto file = std::ranges::find_if(places, [](const std::string& p) { return fs::exists(p); });
  if (file == places.end())
    throw std::runtime_error("engine petsc: found no module " + joined(places, " or ") + how_to_get_it);
  void* const module = dlopen(file->c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    const char* const why = dlerror();  // NOLINT(concurrency-mt-unsafe): no other thread loads anything
    throw std::runtime_error("engine petsc: " + *file + " cannot be loaded: " + why + how_to_get_it);
  }
  // NOLINTNEXTLINE(*-reinterpret-cast): dlsym has untyped addresses
  const auto join = reinterpret_cast<join_function*>(dlsym(module, join_symbol));
  mpi_job* const job = join != nullptr ? join(CONTCT_VERSION) : nullptr;
  if (job == nullptr)
    throw std::runtime_error("engine petsc: " + *file +
                             ": found a module of another version; allowed: the version of the program");
  return *job;
}

/// Joins the MPI job of --engine petsc, if requested, through the module contct_petsc.so. Runs before the
/// command line is parsed, because only rank 0 parses, reads and writes. Returns false on the other ranks,
/// after they have served rank 0. Throws std::runtime_error if the module is missing, if its libraries cannot
/// be loaded, or if it was built for another version.
bool runs_the_program(const std::vector<std::string>& arguments) {
  if (!asks_for_petsc(arguments)) return true;
  mpi_job& job = join_job();
  if (job.rank() != 0) {
    job.serve();
    return false;
  }
  joined_job() = &job;
  // mpirun gives rank 0 a terminal even if the output of mpirun is not a terminal, so colours are turned off.
  (void)setenv("NO_COLOR", "1", 0);  // NOLINT(concurrency-mt-unsafe): there is no other thread yet
  return true;
}

/// Ends the other ranks. This is the last action of rank 0.
void leave_job() noexcept {
  mpi_job* const job = std::exchange(joined_job(), nullptr);
  if (job != nullptr) job->leave();
}

exit_status run_asked(int argc, char** argv) {
  if (!runs_the_program({argv, argv + argc})) return exit_status::solved;
  const command_options asked = parse_contct(argc, argv, engine_choices());
  return std::visit([](const auto& options) { return run_command(options); }, asked);
}

}  // namespace

int run_contct(int argc, char** argv) {
  allocate_as_new_does();
  return run_program([argc, argv] { return run_asked(argc, argv); }, leave_job);
}

}  // namespace contct
