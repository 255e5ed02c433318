// What is wrong with a command line, in words that help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace contct {

/// The names of a program's commands, in their order; those that are hidden are left out.
[[nodiscard]] std::vector<std::string> command_names(const CLI::App& program);

/// The long names of a command's options, each with its "--".
[[nodiscard]] std::vector<std::string> option_names(const CLI::App& command);

/// What CLI11 says of an error, and what may have been meant where a command or an option is not known.
[[nodiscard]] std::string usage_words(const CLI::App& program, const CLI::ParseError& error);

}  // namespace contct
