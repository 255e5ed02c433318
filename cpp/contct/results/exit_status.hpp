// The exit statuses of the program and the status names in results.
#pragma once

#include <string_view>

#include "contct/path/path.hpp"

namespace contct {

enum class exit_status {
  solved = 0,  ///< solved, and the kernels agree
  kernels_differ = 1,
  bad_input = 2,        ///< a wrong file, option or output path; or K cannot be factored
  uncertified = 3,      ///< solved but not certified, under --strict
  mechanism = 4,        ///< no equilibrium
  iteration_limit = 5,  ///< a path that ended early, a cycle, or a limit on increments, time or memory
};

/// The exit status of a run whose path ended in `status`.
constexpr exit_status status_of(path_status status, bool kernels_agree = true) {
  if (!kernels_agree) return exit_status::kernels_differ;
  constexpr exit_status statuses[] = {exit_status::solved,          exit_status::mechanism,
                                      exit_status::iteration_limit, exit_status::iteration_limit,
                                      exit_status::bad_input,       exit_status::iteration_limit};
  return statuses[static_cast<int>(status)];  // in the order of path_status
}

constexpr std::string_view status_name(path_status status, bool kernels_agree = true) {
  if (!kernels_agree) return "kernels-disagree";
  if (status == path_status::solved) return "solved";
  if (status == path_status::path_ended) return "path-ended";
  return status == path_status::mechanism ? "mechanism" : "iteration-limit";
}

}  // namespace contct
