// The commands of the contct program, a file each.
#pragma once

#include <CLI/CLI.hpp>

namespace contct {

/// Exit statuses of the program (what a CI job reads).
enum class exit_status {
  solved = 0,           ///< solved, and the kernels are equal
  kernels_differ = 1,   ///< kernels disagree
  bad_input = 2,        ///< a file, an option or an output path is wrong
  uncertified = 3,      ///< solved but not certified, under --strict
  mechanism = 4,        ///< no equilibrium
  iteration_limit = 5,  ///< cycle or iteration limit
};

/// Add `contct run` to the program; `status` receives what it comes to.
void add_run(CLI::App& program, exit_status& status);

/// Add `contct explain`.
void add_explain(CLI::App& program, exit_status& status);

/// Add `contct verify`.
void add_verify(CLI::App& program, exit_status& status);

/// Add `contct new`.
void add_new(CLI::App& program, exit_status& status);

/// Add `contct kernels`.
void add_kernels(CLI::App& program, exit_status& status);

/// Add `contct atlas`.
void add_atlas(CLI::App& program, exit_status& status);

/// Add `contct fuzz`.
void add_fuzz(CLI::App& program, exit_status& status);

/// Add `contct export`.
void add_export(CLI::App& program, exit_status& status);

/// Add `contct replay`; describe_replay gives the same to a program of its own.
void add_replay(CLI::App& program, exit_status& status);
void describe_replay(CLI::App& command, exit_status& status);

}  // namespace contct
