// The commands of the program: their options as plain data, and the functions that run them. Only options.cpp
// uses the command-line library.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "contct/harness/fuzz.hpp"
#include "contct/results/exit_status.hpp"

namespace contct {

// One structure for each command. A string is a file's name unless stated otherwise; empty if not requested.

/// The options of every command that compares or verifies.
struct report_options {
  bool quiet = false;
  std::string junit, markdown;
};

/// The options of every command that reports on a kernel.
struct kernel_report_options {
  std::string kernel_report, badge;
  report_options report = {};
};

/// The options of every command that reads a problem.
struct problem_options {
  std::string file = {};
  bool allow_outside = false;  ///< the problem may name files that are not below its own folder
};

struct run_options : problem_options {
  std::vector<std::string> kernels;  ///< the first is the leader; empty: both rules
  std::string engine;                ///< an engine's name; empty: the default engine of the leader
  std::string json, log, trace, proof, html, csv, vtu;
  report_options report;
  bool free_run = false;
  bool final_only = false;
  bool strict = false;
  bool detail = false;         ///< prints all numbers on the terminal
  bool envelope = false;       ///< the result has an envelope
  std::string compare = "20";  ///< the combinations in which the rules are compared, or "all"
  bool appendix = false;       ///< the printed page has its appendix
  bool refine = false;         ///< solves a second time with half the element size
  std::string watched;  ///< the node in the tables: its number, label or x; empty: the node that moves most
  int max_increments = 0;  ///< limit of increments in a step; 0: the default limit
};

struct check_options : problem_options {
  bool quiet = false;
};

struct explain_options : problem_options {
  std::vector<std::string> kernels = {"fortran", "cpp"};
  std::string engine = "refactor";  ///< an engine's name
  std::string increment;            ///< "3", or "2.3" for increment 3 of step 2
  std::optional<int> step, pair;
  bool all = false;  ///< shows every increment of a long run
  std::string json;
  bool quiet = false;
};

struct exact_options : problem_options {
  std::string rule = "corrected";         ///< "corrected" or "1989"
  std::vector<std::string> kernels = {};  ///< names of the kernels that are compared with the exact path
  int digits = 20;
  std::string json;
  bool quiet = false;
};

struct new_options {
  std::string kind;  ///< the kind of problem; empty: lists the kinds
  std::string file;
};

struct verify_options {
  std::string reference;  ///< a folder
  std::string json;
  report_options report;
};

struct fuzz_options : kernel_report_options {
  fuzz_request request;
  std::optional<std::int64_t> problems;  ///< default: one for every 500 calls
  std::string shard;                     ///< "I/N"
  std::string json;
  std::string out;  ///< a folder
};

struct replay_options : kernel_report_options {
  std::vector<std::string> traces;
  std::vector<std::string> kernels;
  std::string json;
};

struct prove_options {
  std::string library;  ///< a file with a kernel; empty: this program
  std::string symbol;   ///< the kernel's name in the file
  std::string json;     ///< output file for the verdicts
  std::string trace;    ///< output file for a call that is answered differently
};

struct kernels_options {};

/// Prints the text of --help or --version.
struct printed_text {
  std::string text;
};

using command_options =
    std::variant<printed_text, run_options, check_options, explain_options, exact_options, new_options,
                 verify_options, fuzz_options, replay_options, prove_options, kernels_options>;

/// An invalid command line. what() has several lines: the reason, suggestions and advice.
struct usage_error : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Parses the command line of `contct`. `engines` are the names that --engine accepts; the names are an
/// argument so that the parser needs no LAPACK. Throws usage_error.
[[nodiscard]] command_options parse_contct(int argc, const char* const* argv,
                                           const std::vector<std::string>& engines);

/// Parses the command line of `contct-replay` into printed_text or replay_options. Throws
/// usage_error.
[[nodiscard]] command_options parse_contct_replay(int argc, const char* const* argv);

// Each function runs a command and returns its exit status. Exceptions have a message for the user in what().
exit_status run_command(const run_options& options);
exit_status run_command(const check_options& options);
exit_status run_command(const explain_options& options);
exit_status run_command(const exact_options& options);
exit_status run_command(const new_options& options);
exit_status run_command(const verify_options& options);
exit_status run_command(const fuzz_options& options);
exit_status run_command(const replay_options& options);
exit_status run_command(const prove_options& options);
exit_status run_command(const kernels_options& options);
inline exit_status run_command(const printed_text& t) {
  (void)std::fputs(t.text.c_str(), stdout);
  return exit_status::solved;
}

}  // namespace contct
