// The commands of the program: their options as plain data, and what runs them. Only options.cpp knows the
// command-line library.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "contct/lab/fuzz.hpp"
#include "contct/session/exit_status.hpp"

namespace contct {

// One structure a command. A string is a file's name unless stated otherwise; empty: not requested.

/// The options of every comparing command.
struct report_options {
  bool quiet = false;
  std::string junit, markdown;
};

/// The options of every command with a problem.
struct problem_options {
  std::string file = {};
  bool allow_outside = false;  ///< the problem may name files that are not below its own folder
};

struct run_options : problem_options {
  std::vector<std::string> kernels;  ///< the first leads; none: both rules
  std::string engine;                ///< empty: what suits the leader
  std::string json, log, trace, proof, html, csv, vtu;
  report_options report;
  bool free_run = false;
  bool final_only = false;
  bool strict = false;
  bool detail = false;    ///< all numbers on the terminal
  bool envelope = false;  ///< in the result
  bool refine = false;    ///< also on half the element size
  std::string
      watched;  ///< the node that tables follow: its number or label, or x; empty: the one that moves most
  int max_increments = 0;  ///< in a step; 0: the default limit
};

struct check_options : problem_options {
  bool quiet = false;
};

struct explain_options : problem_options {
  std::vector<std::string> kernels = {"fortran", "cpp"};
  std::string engine = "refactor";
  std::string increment;  ///< "3", or "2.3" with its step
  std::optional<int> step, pair;
  bool all = false;  ///< every increment of a long run
  std::string json;
  bool quiet = false;
};

struct exact_options : problem_options {
  std::string rule = "corrected";         ///< or "1989"
  std::vector<std::string> kernels = {};  ///< compared with it
  int digits = 20;
  std::string json;
  bool quiet = false;
};

struct new_options {
  std::string kind;  ///< empty: the kinds are listed
  std::string file;
};

struct verify_options {
  std::string reference;   ///< a folder
  std::string results;     ///< another program's, which are judged instead of this build's
  std::size_t least = 10;  ///< of them must be there
  std::string json;
  report_options report;
};

struct fuzz_options {
  fuzz_request request;
  std::optional<std::int64_t> problems;  ///< by default one for 500 calls
  std::string shard;                     ///< "I/N"
  std::string json;
  std::string out;  ///< a folder
  std::string kernel_report, badge;
  report_options report;
};

struct replay_options {
  std::vector<std::string> traces;
  std::vector<std::string> kernels;
  std::string kernel_report, badge;
  report_options report;
};

struct prove_options {
  std::string library;  ///< a file with kernels; empty: this program
  std::string symbol;
};

struct kernels_options {};

/// The text that --help or --version prints.
struct printed_text {
  std::string text;
};

/// The meaning of a command line: one command, or a text.
using command_options =
    std::variant<printed_text, run_options, check_options, explain_options, exact_options, new_options,
                 verify_options, fuzz_options, replay_options, prove_options, kernels_options>;

/// The command line of `contct`. `engines` are the names that --engine takes: the parser itself needs no
/// LAPACK. Throws std::invalid_argument for an invalid command line; what() has the reason and a suggestion.
[[nodiscard]] command_options parse_contct(int argc, const char* const* argv,
                                           const std::vector<std::string>& engines);

/// The command line of `contct-replay`: printed_text or replay_options. Throws likewise.
[[nodiscard]] command_options parse_contct_replay(int argc, const char* const* argv);

// Each runs one command and returns its exit status. All throw a std::exception whose what() is a message for
// the user.
exit_status run_command(const run_options& options);
exit_status run_command(const check_options& options);
exit_status run_command(const explain_options& options);
exit_status run_command(const exact_options& options);
exit_status run_command(const new_options& options);
exit_status run_command(const verify_options& options);
/// The same for another program's results; `table` is reference/verification.toml.
exit_status judge_foreign(const verify_options& options, const std::string& table);
exit_status run_command(const fuzz_options& options);
exit_status run_command(const replay_options& options);
exit_status run_command(const prove_options& options);
exit_status run_command(const kernels_options& options);
inline exit_status run_command(const printed_text& t) {
  (void)std::fputs(t.text.c_str(), stdout);
  return exit_status::solved;
}

}  // namespace contct
