// contct completion: what makes a shell complete the words of contct.
#include <fmt/format.h>

#include <algorithm>

#include "app/commands.hpp"
#include "contct/solve/engine.hpp"
#include "contct/text/joined.hpp"

namespace contct::app {
namespace {

/// For single quotes: a quote ends them, stands for itself, and begins them again.
std::string shell_quoted(std::string_view text) {
  std::string out = "'";
  for (const char ch : text) out += ch == '\'' ? "'\\''" : std::string(1, ch);
  return out + "'";
}

std::vector<std::string> names_of(const std::vector<option_description>& options) {
  std::vector<std::string> names;
  names.reserve(options.size());
  for (const option_description& o : options) names.push_back(o.name);
  return names;
}

/// The bash that completes what an option takes.
std::string bash_value(const option_description& o) {
  switch (o.kind) {
    case takes::kernels:
      return "_contct_list \"$cur\" " + shell_quoted(joined(o.words, " "));
    case takes::engine:
    case takes::word:
      return "_contct_words \"$cur\" " + shell_quoted(joined(o.words, " "));
    case takes::file:
      return "_contct_files \"$cur\"";
    default:
      return ":";
  }
}

std::string bash_command(const command_description& c) {
  std::string text;
  for (const option_description& o : c.options) {
    if (o.kind != takes::nothing)
      text += fmt::format("    {}:{}) {}; return ;;\n", c.name, o.name, bash_value(o));
  }
  for (const option_description& p : c.positionals) {
    if (p.kind == takes::word)
      text += fmt::format("    {}:{}) {}; return ;;\n", c.name, c.name, bash_value(p));
  }
  return text;
}

bool takes_files(const command_description& c) {
  return std::any_of(c.positionals.begin(), c.positionals.end(),
                     [](const option_description& p) { return p.kind == takes::file; });
}

/// What zsh does behind an option: an action of _arguments.
std::string zsh_action(const option_description& o) {
  switch (o.kind) {
    case takes::kernels:
      return ":kernels:_values -s , kernel " + joined(o.words, " ");
    case takes::engine:
    case takes::word:
      return fmt::format(":{}:({})", o.name[0] == '-' ? o.name.substr(2) : o.name, joined(o.words, " "));
    case takes::file:
      return ":file:_files";
    case takes::number:
      return ":" + o.value + ": ";
    default:
      return "";
  }
}

/// In a spec of zsh, brackets and colons mean something.
std::string zsh_text(std::string_view text) {
  std::string out;
  for (const char ch : text) {
    if (ch == '[' || ch == ']' || ch == ':' || ch == '\\') out += '\\';
    out += ch;
  }
  return out;
}

std::string zsh_arguments(const command_description& c) {
  std::string text = "_arguments";
  for (const option_description& o : c.options)
    text += " \\\n        " + shell_quoted(fmt::format("{}[{}]{}", o.name, zsh_text(o.text), zsh_action(o)));
  for (const option_description& p : c.positionals) {
    const char* const any_number = p.kind == takes::file ? "*" : "1";
    text += " \\\n        " + shell_quoted(any_number + zsh_action(p));
  }
  return text;
}

std::string fish_option(const std::string& command, const option_description& o) {
  std::string text =
      fmt::format("complete -c contct -n '__fish_seen_subcommand_from {}' -l {}", command, o.name.substr(2));
  if (o.kind == takes::file) text += " -r -F";
  if (o.kind == takes::number) text += " -x";
  if (!o.words.empty()) text += " -x -a " + shell_quoted(joined(o.words, " "));
  return text + " -d " + shell_quoted(o.text) + "\n";
}

/// {0}: what may stand first; {1} and {2}: cases for the values and the names of options; {3}: commands that
/// take files.
constexpr const char* bash_script = R"(# Completion of contct for bash; made by: contct completion bash
_contct_words() {{ mapfile -t COMPREPLY < <(compgen -W "$2" -- "$1"); }}
_contct_files() {{ compopt -o filenames 2>/dev/null; mapfile -t COMPREPLY < <(compgen -f -- "$1"); }}
# A list with commas: its last word.
_contct_list() {{
  local before=''
  [[ $1 != *,* ]] || before=${{1%,*}},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$2" -- "${{1##*,}}")
}}
_contct() {{
  local cur=${{COMP_WORDS[COMP_CWORD]}} prev=${{COMP_WORDS[COMP_CWORD-1]}} command='' words='' i
  COMPREPLY=()
  # bash takes --json=f for three words.
  if [[ $cur == '=' ]]; then cur=''; elif [[ $prev == '=' ]]; then prev=${{COMP_WORDS[COMP_CWORD-2]}}; fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    [[ ${{COMP_WORDS[i]}} == -* ]] || {{ command=${{COMP_WORDS[i]}}; break; }}
  done
  if [[ -z $command ]]; then
    _contct_words "$cur" {0}
    return
  fi
  case $command:$prev in
{1}  esac
  case $command in
{2}  esac
  if [[ $cur == -* ]]; then _contct_words "$cur" "$words"; return; fi
  case $command in
    {3}) _contct_files "$cur" ;;
    *) _contct_words "$cur" "$words" ;;
  esac
}}
complete -F _contct contct
)";

/// {0}: the commands; {1}: a case for each.
constexpr const char* zsh_script = R"(#compdef contct
# Completion of contct for zsh; made by: contct completion zsh
_contct() {{
  local -a commands
  commands=(
{0}  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  local command=$words[2]
  shift words
  (( CURRENT-- ))
  case $command in
{1}  esac
}}
if [[ $zsh_eval_context[-1] == loadautofunc ]]; then _contct "$@"; else compdef _contct contct; fi
)";

}  // namespace

std::string bash_completion(const program_description& program) {
  std::vector<std::string> names;
  std::string values;
  std::string options;
  std::string with_files;
  for (const command_description& c : program.commands) {
    names.push_back(c.name);
    values += bash_command(c);
    options += fmt::format("    {}) words={} ;;\n", c.name, shell_quoted(joined(names_of(c.options), " ")));
    if (takes_files(c)) with_files += (with_files.empty() ? "" : "|") + c.name;
  }
  const std::string first_words = joined(names, " ") + " " + joined(names_of(program.options), " ");
  return fmt::format(bash_script, shell_quoted(first_words), values, options, with_files);
}

std::string zsh_completion(const program_description& program) {
  std::string commands;
  std::string arguments;
  for (const command_description& c : program.commands) {
    commands += "    " + shell_quoted(c.name + ":" + zsh_text(c.text)) + "\n";
    arguments += fmt::format("    {})\n      {} ;;\n", c.name, zsh_arguments(c));
  }
  return fmt::format(zsh_script, commands, arguments);
}

std::string fish_completion(const program_description& program) {
  std::string text =
      "# Completion of contct for fish; made by: contct completion fish\n"
      "complete -c contct -f\n";
  for (const option_description& o : program.options)
    text += fmt::format("complete -c contct -n __fish_use_subcommand -l {} -d {}\n", o.name.substr(2),
                        shell_quoted(o.text));
  for (const command_description& c : program.commands) {
    text += fmt::format("complete -c contct -n __fish_use_subcommand -a {} -d {}\n", c.name,
                        shell_quoted(c.text));
    for (const option_description& o : c.options) text += fish_option(c.name, o);
    for (const option_description& p : c.positionals) {
      const std::string what = p.kind == takes::file ? "-F" : "-a " + shell_quoted(joined(p.words, " "));
      text += fmt::format("complete -c contct -n '__fish_seen_subcommand_from {}' {}\n", c.name, what);
    }
  }
  return text;
}

exit_status run_command(const completion_options& options) {
  const program_description program = describe_contct(engine_names());
  fmt::print("{}", options.shell == "bash"  ? bash_completion(program)
                   : options.shell == "zsh" ? zsh_completion(program)
                                            : fish_completion(program));
  return exit_status::solved;
}

}  // namespace contct::app
