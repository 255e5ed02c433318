#include "app/usage.hpp"

#include <fmt/format.h>

#include "contct/text/did_you_mean.hpp"

namespace contct {
namespace {

/// The option in "--json=file".
std::string name_in(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-';
}

/// What may have been meant by an option that `command` does not have.
std::string meant_option(const CLI::App& command) {
  for (const std::string& argument : command.remaining(true)) {
    if (!is_option(argument)) continue;
    if (std::string meant = did_you_mean(name_in(argument), option_names(command)); !meant.empty())
      return meant;
  }
  return "";
}

}  // namespace

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_group().empty()) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string usage_words(const CLI::App& program, const CLI::ParseError& error) {
  const auto commands = program.get_subcommands();
  if (!commands.empty()) return error.what() + meant_option(*commands.front());
  const bool has_commands = !command_names(program).empty();
  if (!has_commands) return error.what() + meant_option(program);
  const std::vector<std::string> unknown = program.remaining();
  std::string words = "a command is missing";
  if (!unknown.empty()) {
    const bool option = is_option(unknown.front());
    words = fmt::format("\"{}\" is no {} of contct", unknown.front(), option ? "option" : "command") +
            did_you_mean(name_in(unknown.front()), option ? option_names(program) : command_names(program));
  }
  return fmt::format("{}; the commands are: {}", words, fmt::join(command_names(program), ", "));
}

}  // namespace contct
