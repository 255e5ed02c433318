#include "app/usage.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "contct/text/did_you_mean.hpp"
#include "contct/text/joined.hpp"

namespace contct::app {
namespace {

/// The option in "--json=file".
std::string name_in(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-';
}

template <class Described>
std::vector<std::string> names_of(const std::vector<Described>& all) {
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const Described& d : all) names.push_back(d.name);
  return names;
}

/// What may have been meant by the first of `unknown` that looks like one of `options`.
std::string meant_option(const std::vector<std::string>& unknown,
                         const std::vector<option_description>& options) {
  for (const std::string& argument : unknown) {
    if (!is_option(argument)) continue;
    if (std::string meant = did_you_mean(name_in(argument), names_of(options)); !meant.empty()) return meant;
  }
  return "";
}

std::string missing_command(const program_description& program, const std::vector<std::string>& unknown) {
  if (unknown.empty()) return "a command is missing";
  const bool option = is_option(unknown.front());
  const std::vector<std::string> known = option ? names_of(program.options) : names_of(program.commands);
  return fmt::format("\"{}\" is no {} of contct", unknown.front(), option ? "option" : "command") +
         did_you_mean(name_in(unknown.front()), known);
}

}  // namespace

std::string usage_words(const program_description& program, const std::string& command,
                        const std::vector<std::string>& unknown, const std::string& error) {
  constexpr const char* advice = "\nRun with --help for more information.";
  if (program.commands.empty()) return error + meant_option(unknown, program.options) + advice;
  const auto named = std::find_if(program.commands.begin(), program.commands.end(),
                                  [&](const command_description& c) { return c.name == command; });
  if (named != program.commands.end()) return error + meant_option(unknown, named->options) + advice;
  return fmt::format("{}; the commands are: {}{}", missing_command(program, unknown),
                     joined(names_of(program.commands), ", "), advice);
}

}  // namespace contct::app
