// Functions that run the contct program in a test.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "support/scratch_folder.hpp"

namespace contct {

struct finished {
  int exit = -1;         ///< exit status, or -1 if a signal ended the program
  std::string out, err;  ///< standard output and error
  long peak_kib = 0;     ///< largest resident memory
};

struct process_options {
  std::string input;                                             ///< standard input
  std::vector<std::pair<std::string, std::string>> environment;  ///< added to an otherwise empty environment
  bool terminal = false;        ///< standard output is a terminal of 80 columns
  std::string output = {};      ///< file for standard output, or "closed"
  bool error_terminal = false;  ///< standard error is a terminal; if `terminal`, the same terminal
};

/// The project's folder.
inline const std::filesystem::path root = CONTCT_ROOT;

/// Runs a shell command; `out` has its standard output and standard error.
finished shell(const std::string& line);

/// Runs contct with these arguments in `directory`.
finished contct_program(const std::filesystem::path& directory, const std::vector<std::string>& arguments,
                        const process_options& options = {});

}  // namespace contct
