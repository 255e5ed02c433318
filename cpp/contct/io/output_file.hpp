// Output files that appear whole or not at all.
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

namespace contct {

/// Thrown when an output file cannot be made; what() names the file and the reason.
class output_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file under a temporary name beside its own until `finish`, which gives it its name. Without
/// `finish` nothing remains. "-" is standard output; a path that exists and is not a regular file,
/// such as a device, is written directly.
class output_file {
 public:
  explicit output_file(std::string path);
  ~output_file();
  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;

  void write(std::string_view text);
  void finish();
  [[nodiscard]] bool is_standard_output() const { return path_ == "-"; }

 private:
  [[noreturn]] void fail(int error) const;

  std::string path_;
  std::string temporary_;  // empty when written directly
  std::FILE* file_ = nullptr;
};

}  // namespace contct
