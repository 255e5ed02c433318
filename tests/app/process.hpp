// Running the contct program as a person would, from a test.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "support/scratch_folder.hpp"

namespace contct {

struct finished {
  int exit = -1;         ///< exit status; -1 when a signal ended it
  std::string out, err;  ///< standard output and error
  long peak_kib = 0;     ///< largest resident memory
};

struct process_options {
  std::string input;                                             ///< standard input
  std::vector<std::pair<std::string, std::string>> environment;  ///< on top of a bare one
  bool terminal = false;        ///< standard output is a terminal (of 80 columns)
  std::string output = {};      ///< standard output goes to this file instead; "closed" for none at all
  bool error_terminal = false;  ///< standard error is a terminal; the same one where both are
};

/// The project's folder.
inline const std::filesystem::path root = CONTCT_ROOT;

/// Run a line by the shell; both of its streams are `out`.
finished shell(const std::string& line);

/// Run the program with these arguments in `directory`.
finished contct_program(const std::filesystem::path& directory, const std::vector<std::string>& arguments,
                        const process_options& options = {});

}  // namespace contct
