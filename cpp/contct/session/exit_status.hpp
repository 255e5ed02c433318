// How a run ended, as results and the program's exit status have it.
#pragma once

#include <string_view>

#include "contct/path/path.hpp"

namespace contct {

/// Exit statuses of the program (what a CI job reads).
enum class exit_status {
  solved = 0,           ///< solved, and the kernels are equal
  kernels_differ = 1,   ///< kernels disagree
  bad_input = 2,        ///< a file, an option or an output path is wrong
  uncertified = 3,      ///< solved but not certified, under --strict
  mechanism = 4,        ///< no equilibrium
  iteration_limit = 5,  ///< a path that ended early, a cycle, or a limit of increments, time or memory
};

/// What the program ends with after such a path.
constexpr exit_status status_of(path_status status, bool kernels_agree = true) {
  if (!kernels_agree) return exit_status::kernels_differ;
  constexpr exit_status statuses[] = {exit_status::solved,          exit_status::mechanism,
                                      exit_status::iteration_limit, exit_status::iteration_limit,
                                      exit_status::bad_input,       exit_status::iteration_limit};
  return statuses[static_cast<int>(status)];  // in the order of path_status
}

/// As results have it.
constexpr std::string_view status_name(path_status status, bool kernels_agree = true) {
  if (!kernels_agree) return "kernels-disagree";
  if (status == path_status::solved) return "solved";
  if (status == path_status::path_ended) return "path-ended";
  return status == path_status::mechanism ? "mechanism" : "iteration-limit";
}

}  // namespace contct
