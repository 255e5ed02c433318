// Output files that appear complete or not at all.
#pragma once

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

namespace contct {

/// Blocks every signal to this thread except SIGKILL while this object lives, so that a file with a temporary
/// name is not left behind.
class signals_wait {
 public:
  signals_wait() {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before_);
  }
  ~signals_wait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  signals_wait(const signals_wait&) = delete;
  signals_wait& operator=(const signals_wait&) = delete;

 private:
  sigset_t before_{};
};

/// Thrown when an output file cannot be made; what() names the file and the reason.
class output_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that has no name until `finish` gives it one: if the process ends before, nothing remains. A
/// symbolic link is followed, and its target replaced. "-" is standard output; a path that exists and is not
/// a regular file, such as a device, is written directly.
class output_file {
 public:
  explicit output_file(std::string path);
  /// No file: output is appended to `kept`, which must outlive this object.
  explicit output_file(std::string* kept) : path_("a text"), kept_(kept) {}
  ~output_file();
  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;

  void write(std::string_view text);
  void finish();

 private:
  [[nodiscard]] bool is_standard_output() const { return path_ == "-"; }
  void give_name() const;
  [[noreturn]] void fail(int error) const;

  std::string path_;
  std::string target_;  // path_ with links followed; empty when written directly
  std::string* kept_ = nullptr;
  std::FILE* file_ = nullptr;
};

/// Standard output is a pipe whose reader has ended.
struct reader_gone : output_error {
  using output_error::output_error;
};

/// Print to standard output, escaped by `terminal_text`; on a terminal colours stay. A failure is reported by
/// flush_standard_output, after the files are written.
void print_text(std::string_view raw);

/// Flush standard output. Throws output_error when anything printed, now or before, could not be written;
/// reader_gone if it is a pipe without a reader.
void flush_standard_output();

/// Would writing to one of these paths change what the other names? True for two names of one file, whether
/// it exists or not; false for devices, pipes and terminals.
[[nodiscard]] bool same_file(const std::string& a, const std::string& b);

}  // namespace contct
