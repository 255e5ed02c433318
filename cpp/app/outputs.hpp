// The outputs that all commands share: files, reports, progress and error messages.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
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

/// Open closed standard streams, so that no file of ours gets their descriptor and receives printed text.
void hold_standard_streams();

/// Ends the process with a message and exit status 2, without destructors: where memory has ended, they may
/// need some. The new handler of both programs.
[[noreturn]] void end_for_memory();

/// "contct: ..." on standard error, escaped by `terminal_text`. If it cannot be written, the exit status
/// still reports the error.
template <class... Arguments>
void complain(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
  const std::string line =
      "contct: " + terminal_text(fmt::format(words, std::forward<Arguments>(arguments)...)) + "\n";
  (void)std::fputs(line.c_str(), stderr);
}

/// A text whose line ends are escaped too: no file name can begin a new line.
[[nodiscard]] inline std::string whole_line(std::string_view text) {
  return printable(text, std::string_view::npos);
}

/// The same, a line each.
void complain_of(const std::vector<std::string>& lines);

/// Print `items` in lines of the terminal's width; see wrap.
void print_wrapped(const terminal& t, paint p, const std::vector<std::string>& items);

enum class outcome { passed, failed, skipped };
constexpr outcome passed_if(bool good) {
  return good ? outcome::passed : outcome::failed;
}

/// One thing that was checked.
struct check_result {
  std::string name;  ///< "pb07.trace: cpp"
  outcome what = outcome::passed;
  std::string summary;  ///< one line: "8 calls, 64 values, 0 mismatches"
  std::string details;  ///< of a failure, lines
};

/// The checks of one command.
struct check_report {
  std::string command;             ///< "contct replay"
  std::vector<std::string> facts;  ///< "floating point: strict", ...
  std::vector<check_result> results;
  double seconds = 0.0;

  [[nodiscard]] std::int64_t count(outcome o) const;
};

/// The report for CI systems, as JUnit XML: a test suite with a test case for each result.
[[nodiscard]] std::string junit_xml(const check_report& r);

/// The report as a Markdown summary: the verdict, a table, the details of what failed.
[[nodiscard]] std::string markdown(const check_report& r);

/// The facts about the program that every report has: its version, the listing's checksum, the floating-point
/// probe.
[[nodiscard]] std::vector<std::string> common_facts();

/// "2026-11-22 13:16 UTC": now, or the time that SOURCE_DATE_EPOCH in the environment names in seconds since
/// 1970, so that the same input gives the same file. Throws std::invalid_argument if it is not such a
/// number.
[[nodiscard]] std::string utc_now();

/// A requested file; an empty path: not requested.
struct output_option {
  const char* name;  ///< "--json"
  std::string path;
  bool opens_later = false;
};

/// `others` and the outputs of `options`.
[[nodiscard]] std::vector<output_option> with_reports(std::vector<output_option> others,
                                                      const report_options& options);

/// Throws std::invalid_argument when two of these would be one file, when one is the file that standard
/// output goes to, when more than one is "-", or when one would replace one of `inputs`, whose names describe
/// them: "the problem".
void refuse_shared_outputs(const std::vector<output_option>& outputs,
                           const std::vector<output_option>& inputs = {});

/// The description of the files that a problem names.
inline constexpr const char* named_by_problem = "the problem's stiffness, loads, labels or places";

/// Is one of these files "-"? Then nothing else is printed.
[[nodiscard]] bool takes_standard_output(const std::vector<output_option>& outputs);

/// All of a file at once. Throws as output_file does.
void write_file(const std::string& name, std::string_view text);

/// The files of a command, open before any work is done.
class output_files {
 public:
  explicit output_files(const std::vector<output_option>& outputs);

  /// The file of an option; null where it was not asked for.
  [[nodiscard]] output_file* operator[](std::string_view name) const;

  /// Write all of an option's file and give it its name. Does nothing if the file was not requested.
  void write(std::string_view name, std::string_view text) const;
  /// The same for --junit and --markdown.
  void write(const check_report& report) const;

 private:
  std::map<std::string_view, std::unique_ptr<output_file>> files_;
};

/// The progress of long work: one line on standard error, overwritten and finally erased. Nothing is shown in
/// the first second, if standard error is not a terminal, or if it must be quiet.
class progress {
 public:
  /// `what`: the name of the counted items, "problems". Throws std::invalid_argument if CONTCT_PROGRESS_AFTER
  /// is not a number of seconds.
  progress(std::int64_t all, std::string what, bool quiet);
  ~progress() { erase(); }
  progress(const progress&) = delete;
  progress& operator=(const progress&) = delete;

  void reached(std::int64_t done);

  /// Show a text instead of a count.
  void say(std::string_view words);

  /// Erase the line, so that something else can be printed; the next count shows it again.
  void erase();

 private:
  using clock = std::chrono::steady_clock;
  [[nodiscard]] bool is_due() const;

  bool wanted_;
  std::chrono::duration<double> after_, between_;
  bool shown_ = false;
  std::int64_t all_;
  std::string what_;
  clock::time_point begun_ = clock::now(), last_ = begun_;
};

}  // namespace contct
