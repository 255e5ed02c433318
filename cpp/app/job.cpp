#include "app/job.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "contct/distributed/module.hpp"

namespace contct::app {

bool asks_for_petsc(const std::vector<std::string>& arguments) {
  const auto end = std::find(arguments.begin(), arguments.end(), "--");
  for (auto a = arguments.begin(); a != end; ++a)
    if (*a == "--engine=petsc" || (*a == "--engine" && a + 1 != end && a[1] == "petsc")) return true;
  return false;
}

part take_part(const std::vector<std::string>& arguments) {
  if (!asks_for_petsc(arguments)) return part::runs;
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  try {
    distributed::ranks& all = distributed::join_ranks(
        distributed::module_places(here.string(), CONTCT_INSTALLED_MODULES), CONTCT_VERSION);
    if (all.own() == 0) {
      // mpirun gives rank 0 a terminal of its own, whatever it writes to itself.
      (void)setenv("NO_COLOR", "1", 0);  // NOLINT(concurrency-mt-unsafe): there is no other thread yet
      return part::runs;
    }
    distributed::set_joined_ranks(nullptr);  // it leaves when rank 0 does
    all.serve();
  } catch (const std::runtime_error&) {
    if (distributed::rank_by_environment() == 0) throw;
  }
  return part::is_done;
}

void leave_job() noexcept {
  distributed::ranks* const all = distributed::joined_ranks();
  distributed::set_joined_ranks(nullptr);
  if (all != nullptr) all->leave();
}

}  // namespace contct::app
