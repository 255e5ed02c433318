// What a command ends with.
#pragma once

namespace contct::write {

/// Exit statuses of the program (what a CI job reads).
enum class exit_status {
  solved = 0,           ///< solved, and the kernels are equal
  kernels_differ = 1,   ///< kernels disagree
  bad_input = 2,        ///< a file, an option or an output path is wrong
  uncertified = 3,      ///< solved but not certified, under --strict
  mechanism = 4,        ///< no equilibrium
  iteration_limit = 5,  ///< a path that ended early, a cycle, or a limit of increments, time or memory
};

}  // namespace contct::write
