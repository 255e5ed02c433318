#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

#include "app/commands.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/path/path.hpp"
#include "contct/text/strings.hpp"

namespace contct::app {
namespace {

constexpr std::int64_t most_random_cases = 1'000'000'000'000;

constexpr example all_examples[] = {
    {"contct new beam beam.toml", "a commented problem to start from"},
    {"contct new plate plate.toml", "the same for a plate"},
    {"contct run beam.toml", "the path, FORTRAN and C++ in lockstep"},
    {"contct run beam.toml --json result.json --log unit26.txt",
     "all numbers, and what the listing writes to unit 26"},
    {"contct run beam.toml --kernels corrected --strict", "the corrected rule; exit 3 if not certified"},
    {"contct run beam.toml --free-run --kernels corrected,fortran",
     "where the path of the 1989 rule differs"},
    {"contct run beam.toml --final-only", "no path: the reference solution at the end of each step"},
    {"contct run beam.toml --html beam.html", "a report as one HTML page"},
    {"contct check beam.toml", "a summary of a problem, without solving it"},
    {"contct export beam.toml --calculix beam.inp", "the end of the last step, for CalculiX to solve"},
    {"contct convert K.mtx K.petsc", "a stiffness matrix in PETSc's binary, whose doubles are equal"},
    {"contct explain beam.toml", "what the listing did, line by line, and why"},
    {"contct explain beam.toml --increment 1.1 --pair 1", "one pair in one increment"},
    {"contct explain beam.toml --all --hex", "every increment of a long run, with the bits of s"},
    {"contct explain beam.toml --exact --increment 1.1", "how far its numbers are from the exact ones"},
    {"contct explain beam.toml --quiet --json why.json", "the same as JSON"},
    {"contct exact beam.toml", "the path in rational numbers, without rounding"},
    {"contct exact beam.toml --kernels fortran,corrected", "how many of their digits are right"},
    {"contct exact beam.toml --rule 1989 --digits 30", "the 1989 rule in exact arithmetic"},
    {"contct verify", "every reference problem, compared with its numbers"},
    {"contct verify --quiet --junit verify.xml", "for a CI system"},
    {"contct fuzz --calls 20000 --seed 7", "FORTRAN against C++ on random calls"},
    {"contct fuzz --kernels fortran,plugin:./mine.so --calls 20000",
     "does a kernel of your own answer as CONTCT does?"},
    {"contct replay calls.trace", "repeat recorded calls with the 1989 code"},
    {"contct replay --kernel fortran,cpp calls.trace", "the same with two kernels"},
    {"contct kernels", "what is built in"},
    {"contct completion bash", "a script for command completion in bash"},
    {"contct man", "the manual page, for man -l -"},
    {"contct man problem", "that of problem files: every key"},
    {"contct man result", "that of the results of --json: every key"},
};

/// The option in "--json=file".
std::string name_in(const std::string& argument) {
  return argument.substr(0, argument.find('='));
}

bool is_option(const std::string& argument) {
  return argument.size() > 1 && argument[0] == '-';
}

/// `error` as the parser words it, and what may have been meant by an option or a command that `program` does
/// not have. `command` is empty when the command line names none. `unknown`: the arguments that were not
/// understood.
std::string usage_words(const program_description& program, const std::string& command,
                        const std::vector<std::string>& unknown, const std::string& error) {
  constexpr const char* advice = "\nRun with --help for more information.";
  const auto named = std::ranges::find(program.commands, command, &command_description::name);
  if (program.commands.empty() || named != program.commands.end()) {
    const std::vector<std::string> known =
        names_of(program.commands.empty() ? program.options : named->options);
    std::string meant;
    for (const std::string& argument : unknown)
      if (meant.empty() && is_option(argument)) meant = did_you_mean(name_in(argument), known);
    return error + meant + advice;
  }
  std::string words = "a command is missing";
  if (!unknown.empty()) {
    const bool option = is_option(unknown.front());
    words = fmt::format("\"{}\" is no {} of contct{}", unknown.front(), option ? "option" : "command",
                        did_you_mean(name_in(unknown.front()),
                                     option ? names_of(program.options) : names_of(program.commands)));
  }
  return fmt::format("{}; the commands are: {}{}", words, joined(names_of(program.commands), ", "), advice);
}

/// An empty name would be no file, and the output be lost without a word.
std::string a_name(const std::string& file) {
  return file.empty() ? "found no name; allowed: a file" : "";
}

/// A parser, and what it does not know of its options: the kind of argument that each takes.
class option_parser {
 public:
  option_parser(const std::string& name, const std::string& text) : program(text, name) {
    program.set_version_flag("--version", name + " " CONTCT_VERSION "\nlisting sha256 " CONTCT_LISTING_SHA256,
                             "Print the version and the listing's checksum");
  }

  /// The options of a command, which is chosen where the command line names it.
  template <class Options>
  Options& options_for(CLI::App* command) {
    const auto options = std::make_shared<Options>();
    command->callback([this, options] { chosen_ = *options; });
    return *options;
  }
  template <class Options>
  std::pair<CLI::App*, Options&> command(const std::string& name, const std::string& text) {
    CLI::App* const made = program.add_subcommand(name, text);
    return {made, options_for<Options>(made)};
  }
  /// A list of `words` belongs to an option that takes one of them.
  template <class T>
  CLI::Option* add(CLI::App* command, takes kind, const std::string& name, T& value, const std::string& text,
                   std::vector<std::string> words = {}) {
    CLI::Option* const option = command->add_option(name, value, text);
    option_description& known = arguments_[option];
    known.kind = kind;
    known.words = std::move(words);
    return option;
  }
  CLI::Option* add_file(CLI::App* command, const std::string& name, std::string& file,
                        const std::string& text) {
    return add(command, takes::file, name, file, text)->check(a_name);
  }
  CLI::Option* add_problem_file(CLI::App* command, std::string& file) {
    return add(command, takes::file, "FILE", file, "The problem (TOML); - reads standard input")->required();
  }
  void add_limits(CLI::App* command, problem_limits& limits) {
    command->add_flag("--allow-outside", limits.allow_outside,
                      "The problem may name files that are not below its own folder");
    add(command, takes::number, "--max-seconds", limits.max_seconds,
        "Stop after so many seconds, with exit status 5")
        ->check(CLI::Range(0.001, 1e9));
    add(command, takes::number, "--max-memory", limits.max_memory,
        "Stop where more memory than so many MiB is needed, with exit status 5")
        ->check(CLI::Range(std::int64_t{1}, std::int64_t{1} << 40));
  }
  CLI::Option* add_kernels(CLI::App* command, const std::string& name, std::vector<std::string>& kernels,
                           const std::string& text) {
    return add(command, takes::kernels, name, kernels, text, kernel_names())->delimiter(',');
  }
  static void add_quiet(CLI::App* command, bool& quiet) {
    command->add_flag("--quiet", quiet, "Print only warnings and errors");
  }
  void add_reports(CLI::App* command, report_options& o) {
    add_quiet(command, o.quiet);
    add_file(command, "--junit", o.junit, "Write a JUnit report to this file (- is standard output)");
    add_file(command, "--markdown", o.markdown,
             "Write a summary in Markdown to this file (- is standard output)");
  }

  command_options parse(int argc, const char* const* argv);
  [[nodiscard]] program_description description() const;

  CLI::App program;

 private:
  [[nodiscard]] option_description describe(const CLI::Option& o, const std::string& name) const;
  [[nodiscard]] std::vector<option_description> options_of(const CLI::App& command) const;

  std::map<const CLI::Option*, option_description> arguments_;  // what CLI11 does not know of them
  command_options chosen_;
};

auto commands_of(auto& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

option_description option_parser::describe(const CLI::Option& o, const std::string& name) const {
  const auto found = arguments_.find(&o);
  option_description d = found == arguments_.end() ? option_description{} : found->second;  // or a flag
  d.name = name;
  d.text = o.get_description();
  d.default_value = o.get_default_str();
  d.required = o.get_required();
  if (d.kind != takes::nothing)
    d.value = o.get_type_name().substr(0, o.get_type_name().find(':'));  // without its range
  return d;
}

std::vector<option_description> option_parser::options_of(const CLI::App& command) const {
  std::vector<option_description> all;
  for (const CLI::Option* o : command.get_options())
    for (const std::string& name : o->get_lnames()) all.push_back(describe(*o, "--" + name));
  return all;
}

program_description option_parser::description() const {
  program_description d{options_of(program), {}, all_examples};
  for (const CLI::App* command : commands_of(program)) {
    command_description& c = d.commands.emplace_back(
        command_description{command->get_name(), command->get_description(), options_of(*command), {}});
    for (const CLI::Option* o : command->get_options())
      if (o->get_positional()) c.positionals.push_back(describe(*o, o->get_name(true)));
  }
  return d;
}

command_options option_parser::parse(int argc, const char* const* argv) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0) {  // otherwise a text was asked for
      const auto given = program.get_subcommands();
      throw std::invalid_argument(usage_words(description(), given.empty() ? "" : given.front()->get_name(),
                                              program.remaining(true), e.what()));
    }
    std::ostringstream text;
    program.exit(e, text, text);
    return printed_text{text.str()};
  }
  return chosen_;
}

void declare_replay(option_parser& p, CLI::App* c) {
  auto& o = p.options_for<replay_options>(c);
  p.add(c, takes::file, "TRACE", o.traces, "Recorded calls; - reads standard input")->required();
  p.add_kernels(c, "--kernel", o.kernels,
                "The kernels to check; by default the 1989 code in the trace's precision")
      ->allow_extra_args(false);  // what follows is a trace
  p.add_reports(c, o.report);
}

void declare_pictures(option_parser& p, CLI::App* c, picture_options& o) {
  p.add_file(c, "--html", o.html,
             "Write a report of the run as one HTML page to this file (- is standard output): the structure "
             "increment by increment, its events, the comparison of the kernels, the certificate. A "
             "structure given by its matrix is drawn if coordinates are known; otherwise it is a table");
  p.add_file(c, "--csv", o.csv,
             "Write a table with a row for each increment to this file (- is standard output), and beside "
             "F.csv a file F.pairs.csv with a row for each pair and increment. Columns: step, increment, "
             "kind, s, share, force, events, closed, open, at_face, smin, kernels; and step, increment, "
             "pair, node, surface, state, look, w, gap, force");
  p.add_file(c, "--vtu", o.vtu,
             "For ParaView: write the final state to this file, and beside F.vtu the files F.000.vtu, "
             "F.001.vtu, .. for the start and each kept increment, with every step's final state, and F.pvd, "
             "which lists them. A structure given by its matrix must have coordinates. With --engine petsc a "
             "name F.pvtu is allowed: it lists one file a rank, at most 256, F_0.vtu, F_1.vtu, .., of the "
             "final state");
}

void declare_run(option_parser& p, const std::vector<std::string>& engines) {
  const auto [c, o] = p.command<run_options>("run", "Follow the path of a problem, all kernels in lockstep");
  p.add_problem_file(c, o.file);
  p.add_kernels(c, "--kernels", o.kernels, "Kernels to run, the first one leads")->capture_default_str();
  p.add(
      c, takes::word, "--engine", o.engine,
      fmt::format("How the stiffness equations are solved: {} [refactor for the 1989 rule, auto for others]",
                  joined(engines, ", ")),
      engines);
  c->add_flag("--free-run", o.free_run,
              "Free run: each kernel follows its own path; events, shares of the step and D are compared");
  CLI::Option* const final_only = c->add_flag(
      "--final-only", o.final_only,
      "Do not follow the path: give the reference solution at the end of each step, with its certificate");
  c->add_flag("--strict", o.strict, "Exit 3 when a final state is not certified");
  c->add_flag("--detail", o.detail,
              "Print every event, and after each step all pairs, reactions, and moments and shears at the "
              "ends of elements");
  c->add_flag("--envelope", o.envelope,
              "Add to the result of --json the least and largest values over all increments; this takes one "
              "more solve for each increment");
  c->add_flag("--displacement", o.displacement,
              "With --engine petsc: add the displacement of every dof to the result of --json, which has w "
              "alone then; results of other engines always have it");
  p.add(c, takes::number, "--node", o.watched,
        "The node whose deflection --csv writes: its number, \"x = 4.5\" along a beam, or a dof's label [the "
        "one that deflects most at the ends of steps]")
      ->type_name("NODE");
  p.add(c, takes::number, "--max-increments", o.max_increments, "Limit of increments in a step")
      ->check(CLI::Range(1, most_increments));
  p.add_file(c, "--json", o.json, "Write the result to this file (- is standard output)");
  p.add_file(c, "--trace", o.trace, "Write every call of the leader, inputs and answers, to this file");
  declare_pictures(p, c, o.pictures);
  p.add_reports(c, o.report);
  p.add_file(c, "--log", o.log, "Write the leader's unit 26 to this file");
  p.add_file(c, "--proof", o.proof,
             "Write the proof of the error bounds to this file; reference/check_proof.py checks it");
  p.add_limits(c, o.limits);
  for (const char* of_a_path : {"--free-run", "--kernels", "--engine", "--trace", "--log", "--max-increments",
                                "--html", "--csv", "--vtu", "--envelope", "--node"})
    final_only->excludes(c->get_option(of_a_path));
}

void declare_explain(option_parser& p, const std::vector<std::string>& engines) {
  const auto [c, o] =
      p.command<explain_options>("explain", "What the listing did in each increment, line by line, and why");
  p.add_problem_file(c, o.file);
  p.add(c, takes::number, "--increment", o.increment,
        "Only this increment, from 1; STEP.INCREMENT as in 2.1 names its step too")
      ->type_name("INCREMENT");
  p.add(c, takes::number, "--step", o.step, "Only this step, from 1");
  p.add(c, takes::number, "--pair", o.pair, "Only this pair, from 1");
  c->add_flag("--all", o.all,
              "Explain every increment; otherwise a run of more than 20 has one line for each, unless "
              "--increment or --step chooses some");
  c->add_flag("--hex", o.hex, "Add the bits of s and SMIN, as hexadecimal numbers");
  p.add_kernels(c, "--kernels", o.kernels, "The kernels to compare, the first one leads")
      ->capture_default_str();
  c->add_flag("--exact", o.exact,
              "Add the exact s, from the numbers of each call and on the exact path of the 1989 rule, and "
              "the error of each kernel's s in ULP");
  p.add(c, takes::word, "--engine", o.engine, "How the stiffness equations are solved", engines)
      ->capture_default_str();
  p.add_file(c, "--json", o.json, "Write the explanation to this file (- is standard output)");
  option_parser::add_quiet(c, o.quiet);
  p.add_limits(c, o.limits);
}

void declare_check(option_parser& p) {
  const auto [c, o] =
      p.command<check_options>("check", "Read a problem without solving it, and print a summary");
  p.add_problem_file(c, o.file);
  option_parser::add_quiet(c, o.quiet);
  p.add_limits(c, o.limits);
}

void declare_exact(option_parser& p) {
  const auto [c, o] = p.command<exact_options>(
      "exact", "The path in rational arithmetic, and how many digits of each kernel are right");
  p.add_problem_file(c, o.file);
  const std::vector<std::string> rules = {"corrected", "1989"};
  p.add(c, takes::word, "--rule", o.rule,
        "The rule: corrected gives the true path, 1989 that of the listing without rounding", rules)
      ->check(CLI::IsMember(rules))
      ->capture_default_str();
  p.add_kernels(c, "--kernels", o.kernels, "Kernels to compare with it, each in free run");
  p.add(c, takes::number, "--digits", o.digits,
        "Rational numbers of more digits than this are printed as decimals with this many")
      ->check(CLI::Range(1, 100'000))
      ->capture_default_str();
  p.add_file(c, "--json", o.json, "Write every number as \"p/q\" to this file (- is standard output)");
  option_parser::add_quiet(c, o.quiet);
  p.add_limits(c, o.limits);
}

void declare_new(option_parser& p) {
  const auto [c, o] = p.command<new_options>("new", "Write a commented problem file to start from");
  p.add(c, takes::word, "SHAPE", o.shape, "beam or plate", {"beam", "plate"})->required();
  p.add_file(c, "FILE", o.file,
             "The file to write; by default beam.toml or plate.toml. An existing file is not overwritten. - "
             "is standard output");
}

void declare_verify(option_parser& p) {
  const auto [c, o] = p.command<verify_options>(
      "verify",
      "Solve every problem in reference/ and compare it with published, closed-form and recomputed numbers");
  p.add_file(c, "--reference", o.reference, "The folder with verification.toml and problems/");
  p.add_file(c, "--json", o.json, "Write all numbers to this file (- is standard output)");
  p.add_reports(c, o.report);
}

void declare_fuzz(option_parser& p) {
  const auto [c, o] = p.command<fuzz_options>(
      "fuzz", "Compare kernels to the bit on random and adversarial calls and problems");
  p.add_kernels(c, "--kernels", o.request.kernels, "Kernels to compare, the first one leads")
      ->capture_default_str();
  p.add(c, takes::number, "--calls", o.request.calls, "Number of calls, in all shards together")
      ->check(CLI::Range(std::int64_t{1}, most_random_cases))
      ->capture_default_str();
  p.add(c, takes::number, "--problems", o.problems, "Number of whole problems; by default one for 500 calls")
      ->check(CLI::Range(std::int64_t{0}, most_random_cases));
  p.add(c, takes::number, "--seed", o.request.seed, "Seed of the random numbers")->capture_default_str();
  p.add(c, takes::number, "--shard", o.shard, "Only calls and problems I, I + N, ...")->type_name("I/N");
  p.add_file(c, "--json", o.json, "Write the result to this file (- is standard output)");
  p.add_file(c, "--out", o.out,
             "Write each mismatch to this folder, reduced: a trace and a FORTRAN main program");
  p.add_reports(c, o.report);
}

void declare_export(option_parser& p) {
  const auto [c, o] = p.command<export_options>("export", "Write a beam or a plate as input for CalculiX");
  p.add_problem_file(c, o.file);
  p.add_file(c, "--calculix", o.calculix,
             "Write CalculiX's input to this file, JOB.inp (- is standard output)")
      ->required();
  p.add(c, takes::number, "--step", o.choice.step, "The load step whose end is written [the last]")
      ->check(CLI::Range(1, 1'000'000'000));
  p.add(c, takes::number, "--refine", o.choice.refine, "Elements for each of the problem's, along each side")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  p.add(c, takes::number, "--slenderness", o.choice.slenderness, "The structure's length over its thickness")
      ->check(CLI::Range(10.0, 10'000.0))
      ->capture_default_str();
  p.add_limits(c, o.limits);
}

void declare_convert(option_parser& p) {
  const auto [c, o] = p.command<convert_options>(
      "convert", "Turn a stiffness matrix in Matrix Market into PETSc's binary, or back");
  p.add_file(c, "INPUT", o.input,
             "The matrix in either format, told by its first bytes; - reads standard input")
      ->required();
  p.add_file(c, "OUTPUT", o.output, "The file to write, in the other format (- is standard output)")
      ->required();
  option_parser::add_quiet(c, o.quiet);
}

void declare_completion(option_parser& p) {
  const auto [c, o] =
      p.command<completion_options>("completion", "Print a script for command completion in bash");
  const std::vector<std::string> shells = {"bash", "zsh", "fish"};
  p.add(c, takes::word, "SHELL", o.shell, "bash, zsh or fish", shells)
      ->required()
      ->check(CLI::IsMember(shells));
}

void declare_manual(option_parser& p) {
  const auto [c, o] = p.command<manual_options>("man", "Print a manual page");
  const std::vector<std::string> pages = {"problem", "result"};
  p.add(c, takes::word, "PAGE", o.page,
        "problem: the page of problem files; result: that of --json; without it that of the program", pages)
      ->check(CLI::IsMember(pages));
}

/// Each command's examples stand under its --help, and the first of each under the program's.
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
  program.footer("Examples:" + first_ones + "\ncontct COMMAND --help says more of each.");
}

using declare_command = void (*)(option_parser& p, const std::vector<std::string>& engines);

constexpr std::pair<const char*, declare_command> all_commands[] = {
    {"run", declare_run},
    {"check", [](option_parser& p, const auto&) { declare_check(p); }},
    {"explain", declare_explain},
    {"exact", [](option_parser& p, const auto&) { declare_exact(p); }},
    {"new", [](option_parser& p, const auto&) { declare_new(p); }},
    {"verify", [](option_parser& p, const auto&) { declare_verify(p); }},
    {"fuzz", [](option_parser& p, const auto&) { declare_fuzz(p); }},
    {"replay",
     [](option_parser& p, const auto&) {
       declare_replay(
           p, p.program.add_subcommand("replay", "Repeat recorded calls with a kernel; needs no LAPACK"));
     }},
    {"export", [](option_parser& p, const auto&) { declare_export(p); }},
    {"convert", [](option_parser& p, const auto&) { declare_convert(p); }},
    {"kernels",
     [](option_parser& p, const auto&) {
       p.command<kernels_options>("kernels", "What is built in, and how this machine computes");
     }},
    {"completion", [](option_parser& p, const auto&) { declare_completion(p); }},
    {"man", [](option_parser& p, const auto&) { declare_manual(p); }},
};

/// It stays where it is made: the callbacks of its commands refer to it. With `only` it has that one command:
/// the options of all take longer to declare than most paths to follow.
std::unique_ptr<option_parser> contct_parser(std::vector<std::string> engines, std::string_view only = "") {
  auto made = std::make_unique<option_parser>(
      "contct", "CONTCT: the 1989 contact subroutine in FORTRAN and C++, compared bit for bit.");
  option_parser& p = *made;
  engines.insert(engines.begin(), "auto");
  p.program.require_subcommand(1);
  for (const auto& [name, declare] : all_commands)
    if (only.empty() || only == name) declare(p, engines);
  add_examples(p.program);
  return made;
}

bool is_command(std::string_view word) {
  return std::ranges::any_of(all_commands, [&](const auto& c) { return word == c.first; });
}

}  // namespace

command_options parse_contct(int argc, const char* const* argv, const std::vector<std::string>& engines) {
  if (argc > 1 && is_command(argv[1])) {
    try {
      return contct_parser(engines, argv[1])->parse(argc, argv);
    } catch (const std::invalid_argument&) {  // the message may name other commands
    }
  }
  return contct_parser(engines)->parse(argc, argv);
}

command_options parse_contct_replay(int argc, const char* const* argv) {
  option_parser p("contct-replay", "Repeat recorded calls of CONTCT with a kernel, and compare to the bit.");
  declare_replay(p, &p.program);
  return p.parse(argc, argv);
}

program_description describe_contct(const std::vector<std::string>& engines) {
  return contct_parser(engines)->description();
}

}  // namespace contct::app
