// Limits of time and memory: the process ends when one is reached, with a message, and leaves no part of a
// file.
#pragma once

#include "app/commands.hpp"

namespace contct::app {

/// End the process as it ends where no memory can be had.
[[noreturn]] void end_for_memory();

/// What ends a process that gets no more memory: "contct: memory does not suffice", and exit status 2. From
/// now on no allocation by new fails otherwise. Files that are written have no name until they are complete,
/// so nothing of them is left.
void end_where_memory_ends();

/// From now on the process ends with exit status 5 and a message, when so much time is over, or where it
/// needs more memory. Throws std::system_error where the system refuses.
void start_limits(const problem_limits& limits);

}  // namespace contct::app
