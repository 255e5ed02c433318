// The MPI job of --engine petsc: which process runs the program, and which serve it.
#pragma once

#include <string>
#include <vector>

namespace contct {

/// Join the job where the command line asks for it, through the module contct_petsc.so. This is looked at
/// before anything is parsed: rank 0 alone parses, reads, talks and writes. False on the other ranks, when
/// they have served it. Throws std::runtime_error where there is no module, where what it needs cannot be
/// loaded, and where it was made for another version.
[[nodiscard]] bool runs_the_program(const std::vector<std::string>& arguments);

/// Let the other ranks go, where there are any. The last thing that rank 0 does.
void leave_job() noexcept;

}  // namespace contct
