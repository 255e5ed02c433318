// The outputs that all commands share: files, reports, progress and error messages.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/commands.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/strings.hpp"
#include "contct/text/terminal.hpp"

namespace contct {

/// Runs the command that a program's command line requests, prints the messages of exceptions, and returns
/// the exit status. `leave` is called last. If standard output is a pipe without a reader, ends the process
/// by SIGPIPE, as filters do.
[[nodiscard]] int run_program(
    const std::function<exit_status()>& command, const std::function<void()>& leave = [] {});

/// Prints "contct: ..." on standard error, escaped by `terminal_text`. A failure to print is ignored, because
/// the exit status reports the error.
template <class... Arguments>
void complain(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
  const std::string line =
      "contct: " + terminal_text(fmt::format(words, std::forward<Arguments>(arguments)...)) + "\n";
  (void)std::fputs(line.c_str(), stderr);
}

/// Escapes a text, line ends included, so that a file name in a message cannot begin a new line.
[[nodiscard]] inline std::string whole_line(std::string_view text) {
  return printable(text, std::string_view::npos);
}

/// Prints each line as complain does.
void complain_of(const std::vector<std::string>& lines);

/// Prints `items` in lines of the terminal's width, each line behind `indent` blanks. See wrap.
void print_wrapped(const terminal& t, paint p, const std::vector<std::string>& items, int indent = 0);

enum class outcome { passed, failed, skipped };
constexpr outcome passed_if(bool good) {
  return good ? outcome::passed : outcome::failed;
}

struct check_result {
  std::string name;  ///< for example "pb07.trace: cpp"
  outcome what = outcome::passed;
  std::string summary;  ///< one line, for example "8 calls, 64 values, 0 mismatches"
  std::string details;  ///< lines about a failure
};

/// The checks of one command.
struct check_report {
  std::string command;             ///< for example "contct replay"
  std::vector<std::string> facts;  ///< for example "floating point: strict"
  std::vector<check_result> results;
  double seconds = 0.0;

  [[nodiscard]] std::int64_t count(outcome o) const;
};

/// The report for CI systems, as JUnit XML: a test suite with a test case for each result.
[[nodiscard]] std::string junit_xml(const check_report& r);

/// The report as a Markdown summary: the verdict, a table, and the details of failures.
[[nodiscard]] std::string markdown(const check_report& r);

/// The facts in every report: the program's version, the listing's checksum, and the floating-point probe.
[[nodiscard]] std::vector<std::string> common_facts();

/// The time now, as "2026-11-22 13:16 UTC". If the environment variable SOURCE_DATE_EPOCH is set, returns
/// the time in this variable (seconds since 1970), so that files are reproducible. Throws
/// std::invalid_argument if the variable is invalid.
[[nodiscard]] std::string utc_now();

/// An output file and its option. The path is empty if the file is not requested.
struct output_option {
  const char* name;  ///< for example "--json"
  std::string path;
  bool opens_later = false;  ///< output_files does not open the file
};

[[nodiscard]] std::vector<output_option> with_reports(std::vector<output_option> others,
                                                      const report_options& options);

/// Throws std::invalid_argument if two outputs are the same file, if an output is the file to which standard
/// output goes, if several outputs are "-", or if an output would replace an input. An input has a
/// description as its name, for example "the problem".
void refuse_shared_outputs(const std::vector<output_option>& outputs,
                           const std::vector<output_option>& inputs = {});

/// The description of an input file that a problem names.
inline constexpr const char* named_by_problem = "a file that the problem names";

/// True if an output is "-". Then nothing else is printed on standard output.
[[nodiscard]] bool takes_standard_output(const std::vector<output_option>& outputs);

/// Writes a whole file. Throws as output_file does.
void write_file(const std::string& name, std::string_view text);

/// The output files of a command. The constructor opens the files, so that errors are found before the work.
class output_files {
 public:
  explicit output_files(const std::vector<output_option>& outputs);

  /// The file of an option; null if the file was not requested or opens later.
  [[nodiscard]] output_file* operator[](std::string_view name) const;

  /// Writes `text` as the whole file of an option. Does nothing if the file was not requested.
  void write(std::string_view name, std::string_view text) const;
  /// Writes the files of --junit and --markdown.
  void write(const check_report& report) const;

 private:
  std::map<std::string_view, std::unique_ptr<output_file>> files_;
};

/// Shows the progress of long work in one line on standard error, which is overwritten and finally erased.
/// Shows nothing in the first second (CONTCT_PROGRESS_AFTER in the environment sets another time), if
/// standard error is not a terminal, or if `quiet` is true.
class progress {
 public:
  /// Throws std::invalid_argument if CONTCT_PROGRESS_AFTER is not a number of seconds.
  explicit progress(bool quiet);
  ~progress() { erase(); }
  progress(const progress&) = delete;
  progress& operator=(const progress&) = delete;

  /// Shows a count. `what` names the counted items, for example "problems".
  void reached(std::int64_t done, std::int64_t all, const char* what);

  /// Shows a text.
  void say(std::string_view words);

  /// Erases the line before other text is printed. The next text shows it again.
  void erase();

 private:
  using clock = std::chrono::steady_clock;
  [[nodiscard]] bool is_due() const;

  bool wanted_;
  std::chrono::duration<double> after_, between_;
  bool shown_ = false;
  clock::time_point begun_ = clock::now(), last_ = begun_;
};

}  // namespace contct
