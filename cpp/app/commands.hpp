// The commands of the contct program, a file each.
#pragma once

#include <cstdio>

#include "app/options.hpp"

namespace contct::app {

/// Exit statuses of the program (what a CI job reads).
enum class exit_status {
  solved = 0,           ///< solved, and the kernels are equal
  kernels_differ = 1,   ///< kernels disagree
  bad_input = 2,        ///< a file, an option or an output path is wrong
  uncertified = 3,      ///< solved but not certified, under --strict
  mechanism = 4,        ///< no equilibrium
  iteration_limit = 5,  ///< cycle or iteration limit
};

// Each runs one command and returns its exit status. All throw a std::exception whose what() is a message for
// the user.
exit_status run_command(const run_options& options);
exit_status run_command(const explain_options& options);
exit_status run_command(const new_options& options);
exit_status run_command(const verify_options& options);
exit_status run_command(const fuzz_options& options);
exit_status run_command(const replay_options& options);
exit_status run_command(const atlas_options& options);
exit_status run_command(const export_options& options);
exit_status run_command(const kernels_options& options);
exit_status run_command(const completion_options& options);
exit_status run_command(const manual_options& options);
inline exit_status run_command(const printed_text& t) {
  (void)std::fputs(t.text.c_str(), stdout);
  return exit_status::solved;
}

/// contct(1), in the man macros of roff.
[[nodiscard]] std::string manual_page(const program_description& program);

// Scripts that make a shell complete the words of contct.
[[nodiscard]] std::string bash_completion(const program_description& program);
[[nodiscard]] std::string zsh_completion(const program_description& program);
[[nodiscard]] std::string fish_completion(const program_description& program);

}  // namespace contct::app
