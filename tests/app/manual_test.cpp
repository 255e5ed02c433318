// The shells' completions and the manual, made of the description of a small program.
#include <iterator>
#include <string>

#include "app/commands.hpp"
#include "catch.hpp"

using namespace contct::app;
using Catch::Matchers::Contains;

namespace {

/// One command, "pull", with an option of every kind and two positional arguments.
program_description small_program() {
  program_description p;
  p.options = {{"--version", "", "Print the version", "", takes::nothing, {}, false}};
  p.commands = {{"pull",
                 "Pull [hard]: it's a test",
                 {{"--quiet", "", "Print nothing", "", takes::nothing, {}, false},
                  {"--out", "TEXT", "Write to this file", "", takes::file, {}, false},
                  {"--force", "FLOAT", "How much", "3", takes::number, {}, false},
                  {"--kernels", "TEXT", "Which", "", takes::kernels, {"fortran", "cpp"}, false},
                  {"--engine", "TEXT", "How", "", takes::word, {"auto", "refactor"}, false}},
                 {{"SHAPE", "TEXT", "beam or plate", "", takes::word, {"beam", "plate"}, true},
                  {"FILE", "TEXT", "Where to", "", takes::file, {}, false}}}};
  static constexpr example examples[] = {{"contct pull beam -", "what it is good for"}};
  p.examples = examples;
  return p;
}

}  // namespace

TEST_CASE("bash completes commands, options, and what an option takes by its kind") {
  const std::string text = bash_completion(small_program());
  CHECK_THAT(text, Contains("_contct_words \"$cur\" 'pull --version'"));
  CHECK_THAT(text, Contains("pull) words='--quiet --out --force --kernels --engine' ;;"));
  CHECK_THAT(text, Contains("pull:--out) _contct_files \"$cur\"; return ;;"));
  CHECK_THAT(text, Contains("pull:--kernels) _contct_list \"$cur\" 'fortran cpp'; return ;;"));
  CHECK_THAT(text, Contains("pull:--engine) _contct_words \"$cur\" 'auto refactor'; return ;;"));
  CHECK_THAT(text, Contains("pull:--force) :; return ;;"));
  CHECK_THAT(text, Contains("pull:pull) _contct_words \"$cur\" 'beam plate'; return ;;"));
  CHECK_THAT(text, !Contains("pull:--quiet)"));
  CHECK_THAT(text, Contains("    pull) _contct_files \"$cur\" ;;"));
}

TEST_CASE("what zsh reads in a description is escaped") {
  const std::string text = zsh_completion(small_program());
  CHECK_THAT(text, Contains(R"('pull:Pull \[hard\]\: it'\''s a test')"));
  CHECK_THAT(text, Contains("'--out[Write to this file]:file:_files'"));
  CHECK_THAT(text, Contains("'--force[How much]:FLOAT: '"));
  CHECK_THAT(text, Contains("'--kernels[Which]:kernels:_values -s , kernel fortran cpp'"));
  CHECK_THAT(text, Contains("'--quiet[Print nothing]'"));
  CHECK_THAT(text, Contains("'1:SHAPE:(beam plate)'"));
  CHECK_THAT(text, Contains("'*:file:_files'"));
}

TEST_CASE("of several files zsh takes any number for the last alone") {
  program_description p = small_program();
  p.commands[0].positionals = {{"INPUT", "TEXT", "From where", "", takes::file, {}, true},
                               {"OUTPUT", "TEXT", "Where to", "", takes::file, {}, true}};
  CHECK_THAT(zsh_completion(p), Contains("'1:file:_files' \\\n        '*:file:_files'"));
}

TEST_CASE("fish knows which option takes a file, a word, or nothing") {
  const std::string text = fish_completion(small_program());
  const std::string seen = "complete -c contct -n '__fish_seen_subcommand_from pull' ";
  CHECK_THAT(text,
             Contains("complete -c contct -n __fish_use_subcommand -l version -d 'Print the version'\n"));
  CHECK_THAT(text, Contains(seen + "-l quiet -d 'Print nothing'\n"));
  CHECK_THAT(text, Contains(seen + "-l out -r -F -d 'Write to this file'\n"));
  CHECK_THAT(text, Contains(seen + "-l force -x -d 'How much'\n"));
  CHECK_THAT(text, Contains(seen + "-l engine -x -a 'auto refactor' -d 'How'\n"));
  CHECK_THAT(text, Contains(seen + "-F\n"));
}

TEST_CASE("the manual has every command with its arguments, in the macros of roff") {
  const std::string text = manual_page(small_program());
  CHECK_THAT(text, Contains(".SS \"contct pull SHAPE [FILE]\"\n"));
  CHECK_THAT(text, Contains(".TP\n\\fB\\-\\-force\\fR \\fIFLOAT\\fR\nHow much. Default: 3.\n"));
  CHECK_THAT(text, Contains(".TP\n\\fB\\-\\-kernels\\fR \\fITEXT\\fR\nWhich. There are: fortran, cpp.\n"));
  CHECK_THAT(text, Contains(".TP\n\\fBFILE\\fR\nWhere to.\n"));
  CHECK_THAT(text, Contains(".TP\n\\fBcontct pull beam \\-\\fR\nwhat it is good for.\n"));
  for (const char* section :
       {".SH OPTIONS", ".SH COMMANDS", ".SH EXIT STATUS", ".SH ENVIRONMENT", ".SH EXAMPLES"})
    CHECK_THAT(text, Contains(section));
  CHECK_THAT(text, Contains(".SH SEE ALSO\n.BR contct\\-problem (5),\n.BR contct\\-result (5)"));
}

TEST_CASE("the manual has every exit status and no other") {
  const std::string text = manual_page(small_program());
  const std::size_t from = text.find(".SH EXIT STATUS\n");
  const std::string section = text.substr(from, text.find(".SH ENVIRONMENT") - from);
  constexpr exit_status all[] = {exit_status::solved,    exit_status::kernels_differ,
                                 exit_status::bad_input, exit_status::uncertified,
                                 exit_status::mechanism, exit_status::iteration_limit};
  std::size_t entries = 0;
  for (std::size_t at = section.find(".TP\n"); at != std::string::npos; at = section.find(".TP\n", at + 1))
    ++entries;
  CHECK(entries == std::size(all));
  for (const exit_status status : all)
    CHECK_THAT(section, Contains(".TP\n\\fB" + std::to_string(static_cast<int>(status)) + "\\fR\n"));
}
