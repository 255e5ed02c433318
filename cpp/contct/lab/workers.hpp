// Tasks on all cores. COMMON /DOF/ and unit 26 of the listing belong to a process, so workers are processes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "contct/rooms.hpp"

namespace contct::lab {

/// Does task `number`, from 0, and returns its result as bytes (lab/packed.hpp). It must depend on nothing
/// that other tasks do.
using task_work = std::function<std::string(std::int64_t number)>;
using task_taker = std::function<void(std::int64_t number, const std::string& result)>;

/// Do `tasks` tasks in `jobs` forked processes (0: one for each processor), and take their results here, in
/// the order of tasks: what is taken does not depend on `jobs`. With one job, or one task, all is done in
/// this process.
///
/// No kernel of this process may be alive: it would share its unit 26 with all workers. What `work` throws
/// is thrown here in its turn: a kernel_failure as that, any other exception as std::runtime_error with its
/// words. At once come std::bad_alloc, where a worker had too little memory, and a std::runtime_error, where
/// one was killed. No worker is left in any case.
void do_tasks(int jobs, std::int64_t tasks, const task_work& work, const task_taker& take);

}  // namespace contct::lab
