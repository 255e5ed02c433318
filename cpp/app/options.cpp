#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <sstream>

#include "app/commands.hpp"
#include "contct/path/path.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

constexpr std::int64_t most_random_cases = 1'000'000'000'000;

/// An example command line, which --help shows and the tests run unchanged.
struct example {
  std::string_view line;  ///< "contct run beam.toml"
  std::string_view text;  ///< what the command line does
};

constexpr example all_examples[] = {
    {"contct new beam beam.toml", "a commented problem to start from"},
    {"contct new plate plate.toml", "a commented problem of a plate"},
    {"contct new crane", "one of the jobs of the cookbook"},
    {"contct run beam.toml", "the answer by the corrected rule, certified, and what the 1989 rule does"},
    {"contct run beam.toml --kernels fortran,cpp", "the 1989 rule alone, FORTRAN and C++ in lockstep"},
    {"contct run beam.toml --json result.json --log unit26.txt",
     "all numbers, and what the listing writes to unit 26"},
    {"contct run beam.toml --kernels corrected --strict", "the corrected rule; exit 3 if not certified"},
    {"contct run beam.toml --free-run --kernels corrected,fortran",
     "where the path of the 1989 rule differs"},
    {"contct run beam.toml --final-only", "no path: the reference solution at the end of each step"},
    {"contct run beam.toml --html beam.html", "a report as one HTML page"},
    {"contct check beam.toml", "a summary of a problem, without solving it"},
    {"contct explain beam.toml", "what the listing did, line by line, and why"},
    {"contct explain beam.toml --increment 1.1 --pair 1", "one pair in one increment"},
    {"contct explain beam.toml --all", "every increment of a long run"},
    {"contct explain beam.toml --quiet --json why.json", "the explanation as JSON"},
    {"contct exact beam.toml", "the path in rational numbers, without rounding"},
    {"contct exact beam.toml --kernels fortran,corrected", "how many digits of these kernels are right"},
    {"contct exact beam.toml --rule 1989 --digits 30", "the 1989 rule in exact arithmetic"},
    {"contct verify", "the reference problems, compared with known numbers"},
    {"contct verify --quiet --junit verify.xml", "a JUnit report for a CI system"},
    {"contct fuzz --calls 20000 --seed 7", "FORTRAN against C++ on random calls"},
    {"contct fuzz --kernels fortran,plugin:./mine.so --calls 20000",
     "whether your own kernel gives the answers of CONTCT"},
    {"contct replay calls.trace", "repeat recorded calls with the 1989 code"},
    {"contct replay --kernel fortran,cpp calls.trace", "repeat recorded calls with two kernels"},
    {"contct prove", "prove that the built-in kernels equal CONTCT for every input"},
    {"contct prove mine.so", "prove it for your own kernel"},
    {"contct kernels", "the built-in kernels"},
};

/// The name of an option, "--json" in "--json=file".
std::string name_in(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-';
}

auto commands_of(auto& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* o : command.get_options())
    for (const std::string& name : o->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The parser's message `error`, with a suggestion for an unknown option or command of `program`.
std::string usage_words(const CLI::App& program, const std::string& error) {
  constexpr const char* advice = "\nRun with --help for more information.";
  std::vector<std::string> commands;
  for (const CLI::App* c : commands_of(program)) commands.push_back(c->get_name());
  const std::vector<CLI::App*> given = program.get_subcommands();
  const std::vector<std::string> unknown = program.remaining(true);
  if (commands.empty() || !given.empty()) {
    const std::vector<std::string> known = names_of_options(given.empty() ? program : *given.front());
    std::string meant;
    for (const std::string& argument : unknown)
      if (meant.empty() && is_option(argument)) meant = did_you_mean(name_in(argument), known);
    return error + meant + advice;
  }
  std::string words = "a command is missing";
  if (!unknown.empty() && unknown.front().ends_with(".toml"))
    return fmt::format("\"{}\" is not a command of contct; to run a problem file: contct run {}{}",
                       unknown.front(), unknown.front(), advice);
  if (!unknown.empty()) {
    const bool option = is_option(unknown.front());
    words =
        fmt::format("\"{}\" is not {} of contct{}", unknown.front(), option ? "an option" : "a command",
                    did_you_mean(name_in(unknown.front()), option ? names_of_options(program) : commands));
  }
  return fmt::format("{}; the commands are: {}{}", words, joined(commands, ", "), advice);
}

/// Returns an error message if `file` is empty, because the output would be lost silently; otherwise "".
std::string a_name(const std::string& file) {
  return file.empty() ? "found an empty name; allowed: a file name" : "";
}

void add_file(CLI::App* command, const std::string& name, std::string& file, const std::string& text) {
  command->add_option(name, file, text)->check(a_name);
}
CLI::Option* add_kernels(CLI::App* command, const std::string& name, std::vector<std::string>& kernels,
                         const std::string& text) {
  return command->add_option(name, kernels, text)->delimiter(',');
}
void add_quiet(CLI::App* command, bool& quiet) {
  command->add_flag("--quiet", quiet, "Print only warnings and errors");
}
void add_problem(CLI::App* command, problem_options& o) {
  command->add_option("FILE", o.file, "The problem (TOML); - reads standard input")->required();
  command->add_flag("--allow-outside", o.allow_outside, "The problem may name files outside its own folder");
}
void add_reports(CLI::App* command, report_options& o) {
  add_quiet(command, o.quiet);
  add_file(command, "--junit", o.junit, "Write a JUnit report to this file (- is standard output)");
  add_file(command, "--markdown", o.markdown,
           "Write a summary in Markdown to this file (- is standard output)");
}

void add_kernel_report(CLI::App* command, kernel_report_options& o) {
  add_file(command, "--report", o.kernel_report,
           "Write a report on the checked kernel to this file (- is standard output): its identity, the "
           "comparison, and how closely it equals CONTCT (bits, ulps, events or certificate)");
  add_file(command, "--badge", o.badge, "Write the result as a badge, an SVG picture, to this file");
  add_reports(command, o.report);
}

/// A parser, and the options of the chosen command.
struct option_parser {
  option_parser(const std::string& name, const std::string& text) : program(text, name) {
    program.set_version_flag("--version", name + " " CONTCT_VERSION "\nlisting sha256 " CONTCT_LISTING_SHA256,
                             "Print the version and the listing's checksum");
  }

  /// The options that `command` fills. `parse` returns these options if the command line names `command`.
  template <class Options>
  Options& options_for(CLI::App* command) {
    const auto options = std::make_shared<Options>();
    command->callback([this, options] { chosen = *options; });
    return *options;
  }

  command_options parse(int argc, const char* const* argv) {
    try {
      program.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      // The code is 0 for --help and --version.
      if (e.get_exit_code() != 0) throw usage_error(usage_words(program, e.what()));
      std::ostringstream text;
      program.exit(e, text, text);
      return printed_text{text.str()};
    }
    return chosen;
  }

  CLI::App program;
  std::vector<std::string> engines = {};
  command_options chosen;
};

void declare_replay(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<replay_options>(c);
  c->add_option("TRACE", o.traces, "Recorded calls; - reads standard input")->required();
  add_kernels(c, "--kernel", o.kernels,
              "The kernels to check; by default the 1989 code in the trace's precision")
      ->allow_extra_args(false);  // the next argument is a trace
  add_file(c, "--json", o.json, "Write the result to this file (- is standard output)");
  add_kernel_report(c, o);
}

void declare_pictures(CLI::App* c, run_options& o) {
  add_file(c, "--html", o.html,
           "Write a report of the run as one HTML page to this file (- is standard output): the structure "
           "increment by increment, its events, the comparison of the kernels, the certificate. A "
           "structure given by its matrix is drawn if coordinates are known; otherwise the page has a table");
  c->add_flag("--appendix", o.appendix,
              "Put the appendix of the report on paper too: all tables, increments, calls and certificates")
      ->needs(c->get_option("--html"));
  add_file(c, "--csv", o.csv,
           "Write a table with a row for each increment to this file (- is standard output). For F.csv also "
           "write F.pairs.csv, with a row for each pair and increment, and F.states.csv, with w, slope, "
           "moment, shear, bearing pressure and stress at the end of each step, along a beam or at the nodes "
           "of a plate, and F.supports.csv, with reactions, contact forces, gaps and beds. Columns of F.csv: "
           "step, increment, kind, s, share, force, events, closed, open, "
           "at_face, smin, kernels; of F.pairs.csv: step, increment, pair, node, surface, state, look, w, "
           "gap, force, face, x, y, label, name");
  add_file(c, "--vtu", o.vtu,
           "For ParaView: write the final state to this file, F.vtu. Also write F.000.vtu, F.001.vtu, .. for "
           "the start, each kept increment and every step's final state, and F.pvd, which lists these "
           "files. A structure given by its matrix must have coordinates");
}

void declare_run(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<run_options>(c);
  add_problem(c, o);
  add_kernels(c, "--kernels", o.kernels,
              "Kernels to run; the first one leads [corrected for the answer, and also fortran and cpp in "
              "lockstep on the 1989 path; if --free-run is given: fortran,cpp]");
  c->add_option("--engine", o.engine,
                fmt::format("How the stiffness equations are solved: {} [refactor for the 1989 rule, auto "
                            "for the corrected rule]",
                            joined(p.engines, ", ")));
  c->add_flag("--free-run", o.free_run,
              "Free run: each kernel follows its own path; events, shares of the step and D are compared");
  CLI::Option* const final_only = c->add_flag("--final-only", o.final_only,
                                              "Do not follow the path: find only the reference solution at "
                                              "the end of each step, and its certificate");
  CLI::Option* const compare = c->add_option(
      "--compare", o.compare,
      "Where there are more than 20 combinations: compare the 1989 rule with the answer in 20 of them, "
      "the governing ones first, or in all [20]");
  compare->check(CLI::IsMember({"20", "all"}));
  for (const char* of_other_rules : {"--kernels", "--free-run"})
    compare->excludes(c->get_option(of_other_rules));
  c->add_flag("--strict", o.strict, "Exit with status 3 if a final state is not certified");
  c->add_flag("--detail", o.detail,
              "Print every event, and after each step all pairs, reactions, and moments and shears at the "
              "ends of elements");
  c->add_flag("--envelope", o.envelope,
              "Add the least and largest values over all increments to --json; with --csv F.csv also write "
              "F.envelope.csv, with these values along a beam. This takes one more solve for each increment");
  c->add_flag(
      "--refine", o.refine,
      "Solve once more with half the element size, and print the largest changes of w, moments, shears, "
      "forces, reactions and bearing pressures");
  c->add_option(
       "--node", o.watched,
       "The node whose deflection --csv writes: its number, \"x = 4.5\" along a beam, or a dof's label [the "
       "node that deflects most at the ends of steps]")
      ->type_name("NODE");
  c->add_option("--max-increments", o.max_increments, "Largest number of increments in a step")
      ->check(CLI::Range(1, most_increments));
  add_file(c, "--json", o.json, "Write the result to this file (- is standard output)");
  add_file(c, "--trace", o.trace,
           "Write every call of the leader, inputs and answers, to this file [without --kernels: fortran's "
           "calls]");
  declare_pictures(c, o);
  add_reports(c, o.report);
  add_file(c, "--log", o.log, "Write the leader's unit 26 to this file [without --kernels: fortran's]");
  add_file(c, "--proof", o.proof,
           "Write the proof of the error bounds to this file; reference/check_proof.py checks it");
  for (const char* of_a_path : {"--free-run", "--kernels", "--engine", "--trace", "--log", "--max-increments",
                                "--html", "--csv", "--vtu", "--envelope", "--node", "--compare"})
    final_only->excludes(c->get_option(of_a_path));
}

void declare_explain(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<explain_options>(c);
  add_problem(c, o);
  c->add_option("--increment", o.increment,
                "Only this increment, from 1, or STEP.INCREMENT, such as 2.1; for a trace, only this call")
      ->type_name("INCREMENT");
  c->add_option("--step", o.step, "Only this step, from 1");
  c->add_option("--pair", o.pair, "Only this pair, from 1");
  c->add_flag(
      "--all", o.all,
      "Explain every increment. Without --all, --increment and --step, a run of more than 20 increments "
      "gets one line for each");
  add_kernels(c, "--kernels", o.kernels, "The kernels to compare; the first one leads")
      ->capture_default_str();
  c->add_option("--engine", o.engine, "How the stiffness equations are solved")->capture_default_str();
  add_file(c, "--json", o.json, "Write the explanation to this file (- is standard output)");
  add_quiet(c, o.quiet);
}

void declare_check(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<check_options>(c);
  add_problem(c, o);
  add_quiet(c, o.quiet);
}

void declare_exact(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<exact_options>(c);
  add_problem(c, o);
  const std::vector<std::string> rules = {"corrected", "1989"};
  c->add_option("--rule", o.rule,
                "The rule: corrected gives the true path, 1989 the path of the listing without rounding")
      ->check(CLI::IsMember(rules))
      ->capture_default_str();
  add_kernels(c, "--kernels", o.kernels, "Kernels to compare with the exact path, each in free run");
  c->add_option("--digits", o.digits,
                "Print a rational number of more digits than this as a decimal with this many digits")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  add_file(c, "--json", o.json, "Write every number as \"p/q\" to this file (- is standard output)");
  add_quiet(c, o.quiet);
}

void declare_new(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<new_options>(c);
  c->add_option("KIND", o.kind,
                "What to start from, such as beam or crane; without KIND the kinds are listed");
  add_file(
      c, "FILE", o.file,
      "The file to write; by default KIND.toml. Files that the problem names are written to the same folder. "
      "Existing files are not overwritten. - writes only the problem file, to standard output");
}

void declare_verify(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<verify_options>(c);
  add_file(c, "--reference", o.reference, "The folder with verification.toml and problems/");
  add_file(c, "--json", o.json, "Write all numbers to this file (- is standard output)");
  add_reports(c, o.report);
}

void declare_fuzz(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<fuzz_options>(c);
  add_kernels(c, "--kernels", o.request.kernels, "Kernels to compare; the first one leads")
      ->capture_default_str();
  c->add_option("--calls", o.request.calls, "Number of calls, in all shards together")
      ->check(CLI::Range(std::int64_t{1}, most_random_cases))
      ->capture_default_str();
  c->add_option("--problems", o.problems, "Number of whole problems; by default one for every 500 calls")
      ->check(CLI::Range(std::int64_t{0}, most_random_cases));
  c->add_option("--seed", o.request.seed, "Seed of the random numbers")->capture_default_str();
  c->add_option("--shard", o.shard, "Only calls and problems I, I + N, ...")->type_name("I/N");
  add_file(c, "--json", o.json, "Write the result to this file (- is standard output)");
  add_file(c, "--out", o.out, "Write each mismatch to this folder, reduced, as a trace");
  add_kernel_report(c, o);
}

void declare_prove(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<prove_options>(c);
  add_file(c, "LIBRARY", o.library, "A file with a kernel, such as mine.so; by default this program");
  c->add_option("--symbol", o.symbol, "The kernel's name, if it is not contct_kernel");
  add_file(c, "--json", o.json, "Write the verdicts to this file (- is standard output)");
  add_file(c, "--trace", o.trace,
           "If the kernel and the 1989 code answer a call differently, write this call to this file");
}

/// Adds examples: all of a command to its --help, and the first of each command to the program's --help.
void add_examples(CLI::App& program) {
  std::string first_ones;
  for (CLI::App* c : commands_of(program)) {
    std::string own;
    for (const example& e : all_examples) {
      if (!(std::string(e.line) + " ").starts_with("contct " + c->get_name() + " ")) continue;
      const std::string shown = fmt::format("\n  {}\n      {}", e.line, e.text);
      if (own.empty()) first_ones += shown;
      own += shown;
    }
    c->footer("Examples:" + own);
  }
  program.footer("Examples:" + first_ones + "\ncontct COMMAND --help explains a command.");
}

struct command {
  const char *name, *text;
  void (*declare)(option_parser& p, CLI::App* c);
};

constexpr command all_commands[] = {
    {"run", "Follow the path of a problem by the corrected rule, and also by the 1989 rule", declare_run},
    {"check", "Read a problem without solving it, and print a summary", declare_check},
    {"explain", "What the listing did in each increment, line by line, and why", declare_explain},
    {"exact", "The path in rational arithmetic, and how many digits of each kernel are right", declare_exact},
    {"new", "Write a commented problem file to start from", declare_new},
    {"verify",
     "Solve every problem in reference/ and compare it with published, closed-form and recomputed numbers",
     declare_verify},
    {"fuzz", "Compare kernels on random calls (ISEP -2 to 2, ISURF 1 or -1) and problems", declare_fuzz},
    {"replay", "Repeat recorded calls, with their ISEP and ISURF; needs no LAPACK", declare_replay},
    {"prove",
     "Prove that kernels equal CONTCT for every ISEP, ISURF and other input; needs Python's capstone and z3",
     declare_prove},
    {"kernels", "List the built-in kernels, and the floating-point properties of this machine",
     [](option_parser& p, CLI::App* c) { p.options_for<kernels_options>(c); }},
};

}  // namespace

command_options parse_contct(int argc, const char* const* argv, const std::vector<std::string>& engines) {
  option_parser p("contct", "CONTCT: the 1989 contact subroutine in FORTRAN and C++, compared bit for bit.");
  p.engines = engines;
  p.program.require_subcommand(1);
  for (const auto& [name, text, declare] : all_commands) declare(p, p.program.add_subcommand(name, text));
  add_examples(p.program);
  return p.parse(argc, argv);
}

command_options parse_contct_replay(int argc, const char* const* argv) {
  option_parser p("contct-replay", "Repeat recorded calls of CONTCT with a kernel, and compare to the bit.");
  declare_replay(p, &p.program);
  return p.parse(argc, argv);
}

}  // namespace contct
