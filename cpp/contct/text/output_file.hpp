// Output files that appear complete or not at all.
#pragma once

#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>

namespace contct {

/// Blocks the signals of this thread while this object exists, so that no signal but SIGKILL can end the
/// process between making and removing a temporary file.
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

/// Thrown if an output file cannot be written; what() names the file and the reason.
class output_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that gets its name in `finish`: if the process ends before `finish`, no file remains. Of a symbolic
/// link, the target is replaced. "-" is standard output. A path that exists and is not a regular file, such
/// as a device, is written directly. Constructor, `write` and `finish` throw output_error.
class output_file {
 public:
  explicit output_file(std::string path);
  /// Appends the output to `kept`, which must outlive this object, instead of writing a file.
  explicit output_file(std::string* kept) : path_("a text"), kept_(kept) {}
  ~output_file();
  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;

  void write(std::string_view text);
  void finish();

 private:
  [[nodiscard]] bool is_standard_output() const { return path_ == "-"; }
  void give_name() const;

  std::string path_;
  std::string target_;  // path_ with links followed; empty: path_ is written directly
  std::string* kept_ = nullptr;
  std::FILE* file_ = nullptr;
};

/// Thrown if standard output is a pipe whose reader has ended.
struct reader_gone : output_error {
  using output_error::output_error;
};

/// Prints `raw` to standard output, escaped by `terminal_text`; on a terminal, colour codes are kept. If
/// printing fails, flush_standard_output throws later.
void print_text(std::string_view raw);

/// Flushes standard output. Throws output_error if anything printed so far could not be written; reader_gone
/// if standard output is a pipe without a reader.
void flush_standard_output();

/// True if both paths are names of one file, so that writing to one path would change the file at the other.
/// The file need not exist. False for devices, pipes and terminals.
[[nodiscard]] bool same_file(const std::string& a, const std::string& b);

}  // namespace contct
