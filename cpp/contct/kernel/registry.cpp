#include "contct/kernel/registry.hpp"

#include <optional>
#include <stdexcept>
#include <string>

#include "contct/kernel/child_kernel.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// What follows "plugin:" or "pipe:" in a name; nothing when it begins with something else.
std::optional<std::string> after(std::string_view prefix, std::string_view name) {
  if (!name.starts_with(prefix) || name.size() == prefix.size()) return {};
  return std::string(name.substr(prefix.size()));
}

[[noreturn]] void refuse_unknown(std::string_view name) {
  const std::vector<std::string> known = kernel_names();
  throw std::invalid_argument("no kernel is named \"" + std::string(name) + "\"" + did_you_mean(name, known) +
                              "; there are: " + joined(known, ", ") + ", plugin:LIBRARY, pipe:COMMAND");
}

}  // namespace

std::unique_ptr<kernel> make_kernel(std::string_view name) {
  if (const auto path = after("plugin:", name)) return make_plugin(*path);
  if (const auto command = after("pipe:", name)) return make_pipe(*command);
  std::unique_ptr<kernel> made = make_built_in(name);
  if (!made) refuse_unknown(name);
  return made;
}

kernel_facts facts_of_kernel(std::string_view name) {
  if (after("plugin:", name)) return facts_of_outside(std::string(name), "a shared library");
  if (after("pipe:", name)) return facts_of_outside(std::string(name), "a command");
  const std::optional<kernel_facts> facts = facts_of_built_in(name);
  if (!facts) refuse_unknown(name);
  return *facts;
}

}  // namespace contct
