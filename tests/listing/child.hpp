// A program run in a child process, so that whatever it does is an outcome.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/scratch_folder.hpp"

namespace contct_test {

/// How a child ended, and what it said.
struct child_end {
  bool exited;  ///< false: ended by a signal, or by running out of time
  int status;   ///< exit status, or the number of the signal
  std::string out;
  std::string err;

  [[nodiscard]] bool well() const { return exited && status == 0; }
};

/// Run `command` (its first word is a path) in `folder`, for a minute at most and for so many
/// seconds of processor time: a loop is cut short early, a busy machine is not mistaken for one.
/// What it prints is kept in the folder as well, as files.
child_end run_child(const std::vector<std::string>& command, const std::filesystem::path& folder,
                    unsigned cpu_seconds = 60);

using contct::app::scratch_folder;

/// All of a file; empty when there is none.
std::string file_text(const std::filesystem::path& file);

}  // namespace contct_test
