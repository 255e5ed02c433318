#include "contct/read/named_files.hpp"

#include <algorithm>
#include <filesystem>

namespace contct {

namespace fs = std::filesystem;

named_files::named_files(std::string_view problem_file, reach allowed)
    : folder_(fs::path(problem_file).parent_path().string()), allowed_(allowed) {}

std::string named_files::path_of(const toml_value& named, std::string_view ending) const {
  const std::string name = named.text().append(ending);
  if (name.find('\0') != std::string::npos)  // where the system's functions end a name
    named.refuse(in_quotes(name), "the name of a file, which has no character \\u0000");
  const std::string path = (fs::path(folder_) / name).string();
  if (allowed_ == reach::own_folder && !is_below(path))
    named.refuse(in_quotes(name) + ", which is not below the folder of the problem file",
                 "a file below it, or any with --allow-outside (\"allow_outside\" in the library)");
  // A file named "-" is one: standard input holds the problem, if anything.
  return all_->emplace_back(path == "-" ? "./-" : path);
}

/// A path that cannot be resolved is not below it.
bool named_files::is_below(const std::string& path) const {
  std::error_code wrong;
  const auto resolved = [&wrong](const fs::path& p) {
    const fs::path absolute = wrong ? p : fs::absolute(p, wrong);
    return wrong ? p : fs::weakly_canonical(absolute, wrong);
  };
  const fs::path folder = resolved(folder_.empty() ? "." : folder_);
  const fs::path file = resolved(path);
  return !wrong &&
         std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

}  // namespace contct
