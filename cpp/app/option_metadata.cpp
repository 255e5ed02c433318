#include "app/option_metadata.hpp"

#include "contct/outside/registry.hpp"
#include "contct/solve/engine.hpp"

namespace contct {
namespace {

takes kind_of(const CLI::Option& o, const std::string& name) {
  if (o.get_type_name().empty()) return takes::nothing;  // a flag
  if (name == "--kernels" || name == "--kernel") return takes::kernels;
  if (name == "--engine") return takes::engine;
  if (name == "SHAPE" || name == "SHELL") return takes::word;
  return o.get_type_name() == "TEXT" ? takes::file : takes::number;
}

std::vector<std::string> words_of(takes kind, const std::string& name) {
  if (kind == takes::kernels) return kernel_names();
  if (kind == takes::engine) {
    std::vector<std::string> names = engine_names();
    names.insert(names.begin(), "auto");
    return names;
  }
  if (name == "SHAPE") return {"beam", "plate"};
  if (name == "SHELL") return {"bash", "zsh", "fish"};
  return {};
}

described_option describe(const CLI::Option& o, const std::string& name) {
  described_option d{name, "", o.get_description(), o.get_default_str(), kind_of(o, name), {}, false};
  if (d.kind != takes::nothing)
    d.value = o.get_type_name().substr(0, o.get_type_name().find(':'));  // what follows is its range
  d.words = words_of(d.kind, name);
  d.required = o.get_required();
  return d;
}

}  // namespace

std::vector<described_option> describe_options(const CLI::App& program) {
  std::vector<described_option> all;
  for (const CLI::Option* o : program.get_options())
    for (const std::string& name : o->get_lnames()) all.push_back(describe(*o, "--" + name));
  return all;
}

std::vector<described_command> describe_commands(const CLI::App& program) {
  std::vector<described_command> all;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    described_command c{command->get_name(), command->get_description(), describe_options(*command), {}};
    for (const CLI::Option* o : command->get_options())
      if (o->get_positional()) c.positionals.push_back(describe(*o, o->get_name(true)));
    all.push_back(std::move(c));
  }
  return all;
}

}  // namespace contct
