// contct man and contct completion: the manual pages, and what makes a shell complete the words of contct.
#include <fmt/format.h>

#include <algorithm>

#include "app/commands.hpp"
#include "app/man_page.hpp"
#include "app/problem_runs.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/strings.hpp"
#include "contct/text/terminal.hpp"

namespace contct::app {

// Files of reference/, built in: embed.cmake writes them.
extern const std::string_view problem_file_md, result_file_md;

namespace {

/// A term, which may be followed by a `value` of it, and what it means.
std::string entry(std::string_view term, const std::string& meaning, const std::string& value = "") {
  const std::string behind = value.empty() ? "" : " \\fI" + roff(value) + "\\fR";
  return ".TP\n\\fB" + roff(term) + "\\fR" + behind + "\n" + filled(meaning);
}

std::string option_entry(const option_description& o) {
  std::string says = o.text + ".";
  if (!o.default_value.empty()) says += " Default: " + o.default_value + ".";
  if (!o.words.empty()) says += fmt::format(" There are: {}.", joined(o.words, ", "));
  return entry(o.name, says, o.name[0] == '-' ? o.value : "");
}

std::string command_section(const command_description& c) {
  std::string text = ".SS \"contct " + roff(c.name);
  for (const option_description& p : c.positionals) text += " " + (p.required ? p.name : "[" + p.name + "]");
  text += "\"\n" + filled(c.text + ".");
  for (const option_description& p : c.positionals) text += option_entry(p);
  for (const option_description& o : c.options) text += option_entry(o);
  return text;
}

constexpr std::pair<const char*, const char*> exit_meanings[] = {
    {"0", "solved, and the kernels are equal."},
    {"1", "the kernels disagree: the first difference is named, in hexfloat."},
    {"2",
     "bad input or usage; a result that cannot be written; a structure too ill-conditioned for double "
     "precision."},
    {"3", "solved, but a final state is not certified, under --strict."},
    {"4", "certainly no equilibrium: the structure became a mechanism."},
    {"5",
     "the path ended early, though there is an equilibrium or that is not decided; it repeats the same "
     "events in "
     "a cycle; or a limit is reached: of increments, of time or of memory."}};

constexpr std::pair<const char*, const char*> variables[] = {
    {"COLUMNS", "Width of tables in columns, from 40 to 160."},
    {"CONTCT_MEMORY_MIB",
     "The most memory, in MiB, that a structure given by its matrix, or contct exact, may take. Default: "
     "three quarters of the machine's memory."},
    {"CONTCT_PROGRESS_AFTER", "Seconds until progress is shown on a terminal. Default: 1."},
    {"NO_COLOR", "Any value turns colours off."}};

/// For single quotes: a quote ends them, stands for itself, and begins them again.
std::string shell_quoted(std::string_view text) {
  constexpr escape quote[] = {{'\'', "'\\''"}};
  return "'" + escaped(text, quote) + "'";
}

std::string quoted_words(const option_description& o) {
  return shell_quoted(joined(o.words, " "));
}

/// The bash that completes what an option takes.
std::string bash_value(const option_description& o) {
  if (o.kind == takes::file) return "_contct_files \"$cur\"";
  if (o.words.empty()) return ":";
  return fmt::format("_contct_{} \"$cur\" {}", o.kind == takes::kernels ? "list" : "words", quoted_words(o));
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

/// What zsh does behind an option: an action of _arguments.
std::string zsh_action(const option_description& o) {
  if (o.kind == takes::file) return ":file:_files";
  if (o.kind == takes::number) return ":" + o.value + ": ";
  if (o.kind == takes::kernels) return ":kernels:_values -s , kernel " + joined(o.words, " ");
  if (o.words.empty()) return "";
  return fmt::format(":{}:({})", o.name[0] == '-' ? o.name.substr(2) : o.name, joined(o.words, " "));
}

/// In a spec of zsh, brackets and colons mean something.
std::string zsh_text(std::string_view text) {
  constexpr escape escapes[] = {{'[', "\\["}, {']', "\\]"}, {':', "\\:"}, {'\\', "\\\\"}};
  return escaped(text, escapes);
}

std::string zsh_arguments(const command_description& c) {
  std::string text = "_arguments";
  for (const option_description& o : c.options)
    text += " \\\n        " + shell_quoted(fmt::format("{}[{}]{}", o.name, zsh_text(o.text), zsh_action(o)));
  for (const option_description& p : c.positionals) {  // the last may be many files
    const bool any_number = p.kind == takes::file && &p == &c.positionals.back();
    text += " \\\n        " + shell_quoted((any_number ? "*" : "1") + zsh_action(p));
  }
  return text;
}

std::string fish_option(const std::string& command, const option_description& o) {
  std::string text =
      fmt::format("complete -c contct -n '__fish_seen_subcommand_from {}' -l {}", command, o.name.substr(2));
  if (o.kind == takes::file) text += " -r -F";
  if (o.kind == takes::number) text += " -x";
  if (!o.words.empty()) text += " -x -a " + quoted_words(o);
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

std::string manual_page(const program_description& program) {
  std::string text =
      fmt::format(".TH CONTCT 1 {} \"contct {}\" \"User Commands\"\n", CONTCT_DATE, CONTCT_VERSION);
  text +=
      ".SH NAME\ncontct, contct\\-replay \\- the 1989 contact subroutine in FORTRAN and C++,\n"
      "compared bit for bit\n"
      ".SH SYNOPSIS\n.B contct\n.I COMMAND\n[\\fIOPTION\\fR]...\n.br\n.B contct\\-replay\n"
      "[\\fIOPTION\\fR]... \\fITRACE\\fR...\n.SH DESCRIPTION\n";
  text += filled(
      "CONTCT is a FORTRAN subroutine that N. J. Salamon printed in 1989. It solves contact between "
      "structures and one-sided supports. This program follows the load path of a beam or a plate with "
      "it and with a C++ reimplementation, and compares the two at every call, bit for bit. "
      "contct-replay is the command replay as a program of its own.");
  text += ".SH OPTIONS\n";
  for (const option_description& o : program.options) text += option_entry(o);
  text += ".SH COMMANDS\n";
  for (const command_description& c : program.commands) text += command_section(c);
  text += ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : exit_meanings) text += entry(status, meaning);
  text += ".SH ENVIRONMENT\n";
  for (const auto& [name, meaning] : variables) text += entry(name, meaning);
  text += ".SH EXAMPLES\n";
  for (const example& e : program.examples) text += entry(e.line, std::string(e.text) + ".");
  return text +
         ".SH SEE ALSO\n.BR contct\\-problem (5),\n.BR contct\\-result (5)\n.PP\n"
         "N. J. Salamon, Receding/advancing contact of structural elements simplified,\n.I "
         "Computers & Structures\n33(2), 509\\-512, 1989.\n";
}

std::string bash_completion(const program_description& program) {
  std::string values;
  std::string options;
  std::vector<std::string> with_files;
  for (const command_description& c : program.commands) {
    values += bash_command(c);
    options += fmt::format("    {}) words={} ;;\n", c.name, shell_quoted(joined(names_of(c.options), " ")));
    if (std::ranges::count(c.positionals, takes::file, &option_description::kind) > 0)
      with_files.push_back(c.name);
  }
  const std::string first_words =
      joined(names_of(program.commands), " ") + " " + joined(names_of(program.options), " ");
  return fmt::format(bash_script, shell_quoted(first_words), values, options, joined(with_files, "|"));
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
      const std::string what = p.kind == takes::file ? "-F" : "-a " + quoted_words(p);
      text += fmt::format("complete -c contct -n '__fish_seen_subcommand_from {}' {}\n", c.name, what);
    }
  }
  return text;
}

exit_status run_command(const manual_options& options) {
  if (options.page == "problem") {
    print_text(page_from_markdown({"contct-problem", "problem files of contct", problem_file_md}));
  } else if (options.page == "result") {
    print_text(page_from_markdown({"contct-result", "result files of contct", result_file_md}));
  } else {
    print_text(manual_page(describe_contct(engine_choices())));
  }
  return exit_status::solved;
}

exit_status run_command(const completion_options& options) {
  const program_description program = describe_contct(engine_choices());
  print_text(fmt::format("{}", options.shell == "bash"  ? bash_completion(program)
                               : options.shell == "zsh" ? zsh_completion(program)
                                                        : fish_completion(program)));
  return exit_status::solved;
}

}  // namespace contct::app
