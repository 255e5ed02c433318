// What the program's parser knows, as data: the manual and the shells' completions are made of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace contct {

/// What may stand behind an option, or in a positional place.
enum class takes { nothing, number, file, kernels, engine, word };

struct described_option {
  std::string name;   ///< "--json", or "FILE" for a positional one
  std::string value;  ///< what stands behind it, for people: "TEXT"; empty for a flag
  std::string says;
  std::string usual;  ///< its default; may be empty
  takes kind = takes::nothing;
  std::vector<std::string> words;  ///< what it may be, where that is a list
  bool required = false;
};

struct described_command {
  std::string name, says;
  std::vector<described_option> options;  ///< with --help, and without positionals
  std::vector<described_option> positionals;
};

/// The commands in the program's order.
[[nodiscard]] std::vector<described_command> describe_commands(const CLI::App& program);

/// The program's own options.
[[nodiscard]] std::vector<described_option> describe_options(const CLI::App& program);

}  // namespace contct
