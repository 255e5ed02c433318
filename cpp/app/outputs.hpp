// What every command prints and writes: its files and reports, how far it has come, and what is wrong.
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

/// Take the place of closed standard streams, so that no file of ours gets their number
/// and, with it, what is printed.
void hold_standard_streams();

/// Ends the process with a message and exit status 2, without destructors: where memory has ended, they may
/// need some. The new handler of both programs.
[[noreturn]] void end_for_memory();

/// "contct: ..." on standard error, as `terminal_text` has it. Where nobody can be told, the exit status
/// still tells.
template <class... Arguments>
void complain(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
  const std::string line =
      "contct: " + terminal_text(fmt::format(words, std::forward<Arguments>(arguments)...)) + "\n";
  (void)std::fputs(line.c_str(), stderr);
}

/// A text whose line ends are escaped too: no name of a file begins a line of its own.
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

/// What one command checked.
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

/// What every report says of the program: its version, the listing's checksum, the floating-point probe.
[[nodiscard]] std::vector<std::string> common_facts();

/// "2026-11-22 13:16 UTC": now, or the time that SOURCE_DATE_EPOCH in the environment names in seconds since
/// 1970, so that the same input gives the same file. Throws std::invalid_argument if it is not such a
/// number.
[[nodiscard]] std::string utc_now();

/// A file as it was asked for; an empty path is one that was not.
struct output_option {
  const char* name;  ///< "--json"
  std::string path;
  bool opens_later = false;
};

/// `others` and the outputs of `options`.
[[nodiscard]] std::vector<output_option> with_reports(std::vector<output_option> others,
                                                      const report_options& options);

/// Throws std::invalid_argument when two of these would be one file, when one is the file that
/// standard output goes to, when more than one is "-", or when one would replace one of `inputs`, whose
/// names say what they are: "the problem".
void refuse_shared_outputs(const std::vector<output_option>& outputs,
                           const std::vector<output_option>& inputs = {});

/// What the files that a problem names are called there.
inline constexpr const char* named_by_problem = "the problem's stiffness, loads, labels or places";

/// Is one of them "-"? Then nothing else is printed.
[[nodiscard]] bool takes_standard_output(const std::vector<output_option>& outputs);

/// All of a file at once. Throws as output_file does.
void write_file(const std::string& name, std::string_view text);

/// The files of a command, open before any work is done.
class output_files {
 public:
  explicit output_files(const std::vector<output_option>& outputs);

  /// The file of an option; null where it was not asked for.
  [[nodiscard]] output_file* operator[](std::string_view name) const;

  /// Write all of an option's file and give it its name. Does nothing where it was not asked for.
  void write(std::string_view name, std::string_view text) const;
  /// The same for --junit and --markdown.
  void write(const check_report& report) const;

 private:
  std::map<std::string_view, std::unique_ptr<output_file>> files_;
};

/// How far a long piece of work has come: one line on standard error, written over and over and gone in the
/// end. Nothing at all in the first second, where standard error is not a terminal, or where it is to be
/// quiet.
class progress {
 public:
  /// `what` is counted: "problems". Throws std::invalid_argument when CONTCT_PROGRESS_AFTER is no time.
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
