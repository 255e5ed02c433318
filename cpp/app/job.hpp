// The MPI job of --engine petsc: which process runs the program, and which serve it.
#pragma once

#include <string>
#include <vector>

namespace contct::app {

/// Does this command line ask for the engine petsc? Looked at before anything is parsed: where it does, rank
/// 0 alone parses, reads, talks and writes.
[[nodiscard]] bool asks_for_petsc(const std::vector<std::string>& arguments);

/// What this process is to do.
enum class part {
  runs,     ///< the program
  is_done,  ///< nothing: it has served rank 0 until that ended, or rank 0 says why it could not join
};

/// Join the job where the command line asks for it; on other ranks than 0, serve. Throws std::runtime_error
/// on rank 0 where there is no module.
[[nodiscard]] part take_part(const std::vector<std::string>& arguments);

/// Let the other ranks go, where there are any. The last thing that rank 0 does.
void leave_job() noexcept;

}  // namespace contct::app
