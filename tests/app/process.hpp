// Runs the contct program in a test.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "nlohmann/json.hpp"
#include "support/json_parts.hpp"
#include "support/scratch_folder.hpp"
#include "support/words.hpp"

namespace contct {

using texts = std::vector<std::string>;

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

/// A problem in which pair 1 separates at once, and the beam is then a mechanism.
inline const std::string freed =
    "[beam]\nx = [0, 1, 2, 3, 4]\nEI = 100\n[[contact]]\nnodes = [2, 4]\nsurface = 'below'\nface = 0\n"
    "stiffness = 10\n[[step]]\npoint = [ { node = 3, w = -4 }, { node = 5, w = -6 } ]\n";

/// Runs a shell command; `out` has its standard output and standard error.
finished shell(const std::string& line);

/// Runs contct with these arguments in `directory`.
finished contct_program(const std::filesystem::path& directory, const texts& arguments,
                        const process_options& options = {});

/// Returns the words of a line. '..' encloses a word, "@" stands for the folder reference/, and "$" for the
/// beginning of the path of a plug-in of tests/kernel/plugins/variant.c, as in "plugin:$less_equal.so".
texts words_of(const std::string& line);

/// A scratch folder with files, in which contct runs.
class workplace : public scratch_folder {
 public:
  struct file {
    std::string name, text;
  };
  workplace() = default;
  explicit workplace(std::initializer_list<file> files) {
    for (const file& f : files) write(f.name, f.text);
  }
  /// Runs contct with the words of a line.
  [[nodiscard]] finished contct(const std::string& line, const process_options& options = {}) const {
    return contct_program(path(), words_of(line), options);
  }
  /// Returns the JSON in a file.
  [[nodiscard]] nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(read(name));
  }
  /// Returns the JSON that contct prints with exit status 0.
  [[nodiscard]] nlohmann::json printed_json(const std::string& line) const;
  /// Runs contct, and checks its exit status and words on standard output and standard error, as check_words
  /// does. Without words for them, standard error must be empty after exit status 0, and standard output
  /// after exit status
  /// 2. After exit status 2 there must be no new file.
  void check(const std::string& line, int exit, const texts& out = {}, const texts& err = {},
             const process_options& options = {}) const;
  /// Checks that contct refuses a command with each of these further words, with these words in its message.
  void check_refusals(const std::string& command,
                      const std::vector<std::pair<std::string, std::string>>& rows,
                      const process_options& options = {}) const;
};

}  // namespace contct
