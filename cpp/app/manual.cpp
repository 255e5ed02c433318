// contct man: the manual page, from the declarations of the options.
#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/examples.hpp"
#include "contct/solve/engine.hpp"
#include "contct/text/joined.hpp"
#include "contct/text/terminal.hpp"

namespace contct::app {
namespace {

constexpr const char* page_date = "2026-11-21";

/// A word or a line as roff takes it: a hyphen that is typed is a minus, and no line begins a request.
std::string roff(std::string_view text) {
  std::string out;
  for (const char ch : text) {
    if (out.empty() && (ch == '.' || ch == '\'')) out += "\\&";
    if (ch == '\\') {
      out += "\\e";
    } else if (ch == '-') {
      out += "\\-";
    } else {
      out += ch;
    }
  }
  return out;
}

/// A paragraph in short lines.
std::string filled(const std::string& text) {
  constexpr int source_width = 72;
  std::string out;
  for (const std::string& line : wrap({text}, source_width)) out += roff(line) + "\n";
  return out;
}

std::string option_entry(const option_description& o) {
  std::string text = ".TP\n\\fB" + roff(o.name) + "\\fR";
  if (!o.value.empty() && o.name[0] == '-') text += " \\fI" + roff(o.value) + "\\fR";
  std::string says = o.text + ".";
  if (!o.default_value.empty()) says += " Usually " + o.default_value + ".";
  if (!o.words.empty()) says += fmt::format(" There are: {}.", joined(o.words, ", "));
  return text + "\n" + filled(says);
}

std::string command_section(const command_description& c) {
  std::string text = ".SS \"contct " + roff(c.name);
  for (const option_description& p : c.positionals) text += " " + (p.required ? p.name : "[" + p.name + "]");
  text += "\"\n" + filled(c.text + ".");
  for (const option_description& p : c.positionals) text += option_entry(p);
  for (const option_description& o : c.options) text += option_entry(o);
  return text;
}

std::string exit_section() {
  constexpr std::pair<int, const char*> meanings[] = {
      {0, "solved, and the kernels are equal"},
      {1, "the kernels disagree: the first difference is named, in hexfloat"},
      {2,
       "bad input or usage; a result that cannot be written; a structure too ill-conditioned for double "
       "precision"},
      {3, "solved, but a final state is not certified, under --strict"},
      {4, "no equilibrium: the structure became a mechanism"},
      {5, "the same pairs toggle for ever, or the limit of increments is reached"}};
  std::string text = ".SH EXIT STATUS\n";
  for (const auto& [status, meaning] : meanings)
    text += fmt::format(".TP\n\\fB{}\\fR\n", status) + filled(std::string(meaning) + ".");
  return text;
}

std::string environment_section() {
  constexpr std::pair<const char*, const char*> variables[] = {
      {"COLUMNS", "How wide tables are, from 40 to 160."},
      {"CONTCT_MEMORY_MIB",
       "The most memory, in MiB, that a matrix from elsewhere may take; otherwise three quarters of the "
       "machine's."},
      {"CONTCT_PROGRESS_AFTER", "Seconds before a terminal is shown how far the work has come; otherwise 1."},
      {"NO_COLOR", "No colours, whatever it is set to."}};
  std::string text = ".SH ENVIRONMENT\n";
  for (const auto& [name, meaning] : variables)
    text += fmt::format(".TP\n\\fB{}\\fR\n", name) + filled(meaning);
  return text;
}

std::string examples_section() {
  std::string text = ".SH EXAMPLES\n";
  for (const example& e : examples_of())
    text += ".TP\n\\fB" + roff(line_of(e)) + "\\fR\n" + filled(std::string(e.text) + ".");
  return text;
}

}  // namespace

std::string manual_page(const program_description& program) {
  std::string text =
      fmt::format(".TH CONTCT 1 {} \"contct {}\" \"User Commands\"\n", page_date, CONTCT_VERSION);
  text += ".SH NAME\ncontct \\- the 1989 contact subroutine, in FORTRAN and in C++, side by side\n";
  text += ".SH SYNOPSIS\n.B contct\n.I COMMAND\n[\\fIOPTION\\fR]...\n";
  text +=
      ".SH DESCRIPTION\n" +
      filled(
          "CONTCT is a FORTRAN subroutine that N. J. Salamon printed in 1989. It solves contact between "
          "structures and one-sided supports. This program follows the load path of a beam or a plate with "
          "it and with a C++ reimplementation, and compares the two at every call, bit for bit.");
  text += ".SH OPTIONS\n";
  for (const option_description& o : program.options) text += option_entry(o);
  text += ".SH COMMANDS\n";
  for (const command_description& c : program.commands) text += command_section(c);
  text += exit_section();
  text += environment_section();
  text += examples_section();
  text +=
      ".SH SEE ALSO\nN. J. Salamon, Receding/advancing contact of structural elements simplified,\n.I "
      "Computers & Structures\n33(2), 509\\-512, 1989.\n";
  return text;
}

exit_status run_command(const manual_options& /*options*/) {
  fmt::print("{}", manual_page(describe_contct(engine_names())));
  return exit_status::solved;
}

}  // namespace contct::app
