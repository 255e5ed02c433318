// Running the contct program as a person would, from a test.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

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

/// Run the program with these arguments in `directory`.
finished contct_program(const std::filesystem::path& directory, const std::vector<std::string>& arguments,
                        const process_options& options = {});

/// A directory of the test's own, gone afterwards.
class scratch_directory {
 public:
  scratch_directory();
  ~scratch_directory();
  scratch_directory(const scratch_directory&) = delete;
  scratch_directory& operator=(const scratch_directory&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Write a file and return its name.
  std::string write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string read(const std::string& name) const;
  /// Names of the files in it, sorted.
  [[nodiscard]] std::vector<std::string> files() const;

 private:
  std::filesystem::path path_;
};

}  // namespace contct
