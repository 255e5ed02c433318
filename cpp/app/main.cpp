// The contct program.
#include <dlfcn.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "app/outputs.hpp"
#include "app/problem_runs.hpp"
#include "contct/number/rational.hpp"
#include "contct/solve/mpi_job.hpp"

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

/// Finds contct_petsc.so in the program's folder, or else in the folder of installed modules.
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
  set_joined_job(&job);
  // mpirun gives rank 0 a terminal even if the output of mpirun is not a terminal, so colours are turned off.
  (void)setenv("NO_COLOR", "1", 0);  // NOLINT(concurrency-mt-unsafe): there is no other thread yet
  return true;
}

/// Ends the other ranks. This is the last action of rank 0.
void leave_job() noexcept {
  mpi_job* const job = joined_job();
  set_joined_job(nullptr);
  if (job != nullptr) job->leave();
}

/// The requested command; nothing, after an error message, if the command line is invalid.
std::optional<command_options> asked_by(int argc, char** argv) {
  try {
    return parse_contct(argc, argv, engine_choices());
  } catch (const std::invalid_argument& e) {
    complain("{}", e.what());
  }
  return {};
}

exit_status status_of_program(int argc, char** argv) {
  try {
    if (!runs_the_program({argv, argv + argc})) return exit_status::solved;
    const std::optional<command_options> asked = asked_by(argc, argv);
    if (!asked) return exit_status::bad_input;
    const exit_status status = std::visit([](const auto& options) { return run_command(options); }, *asked);
    flush_standard_output();
    return status;
  } catch (const reader_gone&) {  // "contct run .. | head" ends as filters do, after writing its files
    leave_job();
    (void)std::signal(SIGPIPE, SIG_DFL);
    (void)std::raise(SIGPIPE);
  } catch (const kernel_failure& e) {
    complain("the leading kernel gave no answer: {}", whole_line(e.what()));
    return exit_status::kernels_differ;
  } catch (const std::system_error& e) {
    complain("{}{}", std::ferror(stdout) != 0 ? "standard output: " : "", whole_line(e.what()));
  } catch (const std::bad_alloc&) {
    end_for_memory();
  } catch (const std::exception& e) {
    complain("{}", whole_line(e.what()));
  }
  return exit_status::bad_input;
}

}  // namespace
}  // namespace contct

int main(int argc, char** argv) {
  std::set_new_handler(contct::end_for_memory);
  contct::allocate_as_new_does();
  contct::hold_standard_streams();
  (void)std::signal(SIGPIPE, SIG_IGN);
  const contct::exit_status status = contct::status_of_program(argc, argv);
  contct::leave_job();
  return static_cast<int>(status);
}
