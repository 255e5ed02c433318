// The options of every command as plain data. Only options.cpp knows the command-line library.
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "contct/lab/atlas.hpp"
#include "contct/lab/fuzz.hpp"
#include "contct/write/calculix_deck.hpp"

namespace contct::app {

// One structure a command. A string is a file's name where nothing else is said; empty: not asked for.

/// What every comparing command has.
struct report_options {
  bool quiet = false;
  std::string junit, markdown;
};

/// What `contct run` draws and tabulates.
struct picture_options {
  std::string html, svg, csv, vtu;

  [[nodiscard]] bool wants_frames() const { return !html.empty() || !svg.empty() || !vtu.empty(); }
};

struct run_options {
  std::string file;
  std::vector<std::string> kernels = {"fortran", "cpp"};  ///< the first leads
  std::string engine;                                     ///< empty: what suits the leader
  std::string json, log, trace;
  report_options report;
  picture_options pictures;
  bool free_run = false;
  bool final_only = false;
  bool strict = false;
  int max_increments = 0;  ///< in a step; 0: the default limit
};

struct explain_options {
  std::string file;
  std::vector<std::string> kernels = {"fortran", "cpp"};
  std::string engine = "refactor";
  std::string increment;  ///< "3", or "2.3" with its step
  std::optional<int> step, pair;
  std::string json;
  bool quiet = false;
};

struct new_options {
  std::string shape, file;
};

struct verify_options {
  std::string reference;  ///< a folder
  std::string json;
  report_options report;
};

struct fuzz_options {
  fuzz_request request;
  std::optional<std::int64_t> problems;  ///< by default one for 500 calls
  std::string shard;                     ///< "I/N"
  std::vector<std::string> merge;
  std::string json;
  std::string out;  ///< a folder
  report_options report;
};

struct replay_options {
  std::vector<std::string> traces;
  std::vector<std::string> kernels;
  report_options report;
};

struct atlas_options {
  atlas_request request;
  std::string csv, json, svg;
  bool quiet = false;
};

struct export_options {
  std::string file;
  std::string calculix;
  calculix_choice choice;
};

struct kernels_options {};
struct manual_options {};

struct completion_options {
  std::string shell;  ///< "bash", "zsh" or "fish"
};

/// What --help and --version print.
struct printed_text {
  std::string text;
};

/// What a command line asks for: one command, or a text.
using command_options = std::variant<printed_text, run_options, explain_options, new_options, verify_options,
                                     fuzz_options, replay_options, atlas_options, export_options,
                                     kernels_options, completion_options, manual_options>;

/// A command line that has no meaning; what() says why, and what may have been meant.
class usage_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The command line of `contct`. `engines` are the names that --engine takes: the parser itself needs no
/// LAPACK. Throws usage_error.
[[nodiscard]] command_options parse_contct(int argc, const char* const* argv,
                                           const std::vector<std::string>& engines);

/// The command line of `contct-replay`: printed_text or replay_options. Throws usage_error.
[[nodiscard]] command_options parse_contct_replay(int argc, const char* const* argv);

/// What an option or a positional argument takes: the shells complete it accordingly.
enum class takes { nothing, number, file, kernels, engine, word };

struct option_description {
  std::string name;   ///< "--json", or "FILE" for a positional one
  std::string value;  ///< what follows it, for people: "TEXT"; empty for a flag
  std::string text;
  std::string default_value;  ///< may be empty
  takes kind = takes::nothing;
  std::vector<std::string> words;  ///< all that it takes, where that is a list
  bool required = false;
};

struct command_description {
  std::string name, text;
  std::vector<option_description> options;  ///< with --help, and without positionals
  std::vector<option_description> positionals;
};

/// What the manual and the shells' completions are made of.
struct program_description {
  std::vector<option_description> options;    ///< before any command
  std::vector<command_description> commands;  ///< in the program's order
};

/// `engines` as in parse_contct.
[[nodiscard]] program_description describe_contct(const std::vector<std::string>& engines);

}  // namespace contct::app
