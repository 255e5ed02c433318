// The files that a problem file names: where they are, and whether they may be there.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "contct/read/toml_reader.hpp"

namespace contct {

/// Which files a problem file may name. A problem from a stranger must not read what its user can.
enum class reach { own_folder, anywhere };

/// Finds files relative to the folder of the problem file.
class named_files {
 public:
  /// `problem_file`: its path; without a folder in it, that is where the process runs.
  named_files(std::string_view problem_file, reach allowed);

  /// The path of the file that is named, with `ending` behind it. Refuses one that is not below the folder,
  /// symbolic links followed, unless all are allowed.
  [[nodiscard]] std::string path_of(const toml_value& named, std::string_view ending = "") const;

  /// All that path_of has returned, to this object and its copies.
  [[nodiscard]] const std::vector<std::string>& all() const { return *all_; }

 private:
  [[nodiscard]] bool is_below(const std::string& path) const;

  std::string folder_;
  reach allowed_;
  std::shared_ptr<std::vector<std::string>> all_ = std::make_shared<std::vector<std::string>>();
};

}  // namespace contct
