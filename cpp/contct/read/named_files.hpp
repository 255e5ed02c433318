// The files that a problem file names: where they are, and whether they may be there.
#pragma once

#include <string>
#include <string_view>

#include "contct/read/toml_reader.hpp"

namespace contct::read {

/// Which files a problem file may name. A problem from a stranger must not read what its user can.
enum class reach { own_folder, anywhere };

/// Finds files relative to the folder of the problem file.
class named_files {
 public:
  /// `problem_file`: its path; without a folder in it, that is where the process runs.
  named_files(std::string_view problem_file, reach allowed);

  /// The path of the file that the key of `t` names, with `ending` behind it. Refuses one that is not below
  /// the folder, symbolic links followed, unless all are allowed.
  [[nodiscard]] std::string path_of(const table_reader& t, std::string_view key,
                                    std::string_view ending = "") const;

 private:
  [[nodiscard]] bool is_below(const std::string& path) const;

  std::string folder_;
  reach allowed_;
};

}  // namespace contct::read
