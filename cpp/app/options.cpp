#include "app/options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>
#include <sstream>

#include "app/examples.hpp"
#include "app/usage.hpp"
#include "contct/kernel/kernel.hpp"
#include "contct/path/path.hpp"
#include "contct/text/joined.hpp"

namespace contct::app {
namespace {

constexpr std::int64_t most_random_cases = 1'000'000'000'000;
constexpr int most_atlas_problems = 1'000'000;
constexpr int most_steps = 1'000'000'000;
constexpr int most_refinement = 64;
constexpr const char* checksum_line = "\nlisting sha256 " CONTCT_LISTING_SHA256;

/// A parser and what it does not know of its options: the kind of argument that each takes.
class option_parser {
 public:
  option_parser(const std::string& text, const std::string& name) : program_(text, name) {
    program_.set_version_flag("--version", name + " " CONTCT_VERSION + checksum_line,
                              "Print the version and the listing's checksum");
  }

  command_options parse(int argc, const char* const* argv);
  [[nodiscard]] program_description description() const;

 protected:
  /// A list of `words` belongs to an option that takes one of them.
  template <class T>
  CLI::Option* add(CLI::App* command, takes kind, const std::string& name, T& value, const std::string& text,
                   std::vector<std::string> words = {}) {
    CLI::Option* const option = command->add_option(name, value, text);
    arguments_[option] = {kind, std::move(words)};
    return option;
  }
  CLI::Option* add_file(CLI::App* command, const std::string& name, std::string& file,
                        const std::string& text) {
    return add(command, takes::file, name, file, text);
  }
  CLI::Option* add_problem_file(CLI::App* command, std::string& file) {
    return add_file(command, "FILE", file, "The problem (TOML); - reads standard input")->required();
  }
  CLI::Option* add_kernels(CLI::App* command, const std::string& name, std::vector<std::string>& kernels,
                           const std::string& text) {
    return add(command, takes::kernels, name, kernels, text, kernel_names())->delimiter(',');
  }
  static void add_quiet(CLI::App* command, bool& quiet) {
    command->add_flag("--quiet", quiet, "Print nothing but what is wrong");
  }
  void add_reports(CLI::App* command, report_options& o);
  void declare_replay(CLI::App* command);

  CLI::App program_;
  command_options chosen_;

 private:
  struct argument {
    takes kind;
    std::vector<std::string> words;
  };
  [[nodiscard]] option_description describe(const CLI::Option& o, const std::string& name) const;
  [[nodiscard]] std::vector<option_description> options_of(const CLI::App& command) const;

  std::map<const CLI::Option*, argument> arguments_;
  replay_options replay_;
};

void option_parser::add_reports(CLI::App* command, report_options& o) {
  add_quiet(command, o.quiet);
  add_file(command, "--junit", o.junit, "Write a JUnit report to this file (- is standard output)");
  add_file(command, "--markdown", o.markdown,
           "Write a summary in Markdown to this file (- is standard output)");
}

void option_parser::declare_replay(CLI::App* command) {
  add(command, takes::file, "TRACE", replay_.traces, "Recorded calls; - reads standard input")->required();
  add_kernels(command, "--kernel", replay_.kernels,
              "The kernels to check; by default the 1989 code in the trace's precision")
      ->allow_extra_args(false);  // what follows is a trace
  add_reports(command, replay_.report);
  command->callback([this] { chosen_ = replay_; });
}

auto commands_of(auto& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

option_description option_parser::describe(const CLI::Option& o, const std::string& name) const {
  option_description d;
  d.name = name;
  d.text = o.get_description();
  d.default_value = o.get_default_str();
  d.required = o.get_required();
  const auto found = arguments_.find(&o);
  if (found == arguments_.end()) return d;  // a flag
  d.kind = found->second.kind;
  d.words = found->second.words;
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
  program_description d{options_of(program_), {}};
  for (const CLI::App* command : commands_of(program_)) {
    command_description& c = d.commands.emplace_back(
        command_description{command->get_name(), command->get_description(), options_of(*command), {}});
    for (const CLI::Option* o : command->get_options())
      if (o->get_positional()) c.positionals.push_back(describe(*o, o->get_name(true)));
  }
  return d;
}

command_options option_parser::parse(int argc, const char* const* argv) {
  try {
    program_.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    const bool asked_for_text = e.get_exit_code() == 0;
    if (!asked_for_text) {
      const auto given = program_.get_subcommands();
      throw std::invalid_argument(usage_words(description(), given.empty() ? "" : given.front()->get_name(),
                                              program_.remaining(true), e.what()));
    }
    std::ostringstream text;
    program_.exit(e, text, text);
    return printed_text{text.str()};
  }
  return chosen_;
}

class replay_parser : public option_parser {
 public:
  replay_parser()
      : option_parser("Put recorded calls of CONTCT to a kernel, and compare to the bit.", "contct-replay") {
    declare_replay(&program_);
  }
};

class contct_parser : public option_parser {
 public:
  explicit contct_parser(const std::vector<std::string>& engines);

 private:
  CLI::App* command(const std::string& name, const std::string& text) {
    return program_.add_subcommand(name, text);
  }
  void declare_run();
  void declare_pictures(CLI::App* c);
  void declare_explain();
  void declare_new();
  void declare_verify();
  void declare_fuzz();
  void declare_atlas();
  void declare_export();
  void declare_texts();
  void add_examples();

  std::vector<std::string> engines_;
  run_options run_;
  explain_options explain_;
  new_options new_;
  verify_options verify_;
  fuzz_options fuzz_;
  atlas_options atlas_;
  export_options export_;
  completion_options completion_;
};

contct_parser::contct_parser(const std::vector<std::string>& engines)
    : option_parser("CONTCT: the 1989 contact subroutine, in FORTRAN and in C++, side by side.", "contct"),
      engines_(engines) {
  engines_.insert(engines_.begin(), "auto");
  program_.require_subcommand(1);
  declare_run();
  declare_explain();
  declare_new();
  declare_verify();
  declare_fuzz();
  declare_replay(command("replay", "Put recorded calls to a kernel; needs no LAPACK"));
  declare_atlas();
  declare_export();
  declare_texts();
  add_examples();
}

void contct_parser::declare_run() {
  CLI::App* const c = command("run", "Follow the path of a problem, all kernels in lockstep");
  add_problem_file(c, run_.file);
  add_kernels(c, "--kernels", run_.kernels, "Kernels to run, the first one leads")->capture_default_str();
  add(c, takes::engine, "--engine", run_.engine,
      fmt::format("How the stiffness equations are solved: {} [refactor for the 1989 rule, auto for others]",
                  joined(engines_, ", ")),
      engines_);
  CLI::Option* const free_run =
      c->add_flag("--free-run", run_.free_run,
                  "Drive each kernel on a path of its own; compare events, load fractions and D");
  CLI::Option* const final_only =
      c->add_flag("--final-only", run_.final_only,
                  "No path: the equilibrium under each step's load by the oracle, certified");
  c->add_flag("--strict", run_.strict, "Exit 3 when a final state is not certified");
  add(c, takes::number, "--max-increments", run_.max_increments, "Limit of increments in a step")
      ->check(CLI::Range(1, most_increments));
  add_file(c, "--json", run_.json, "Write the result to this file (- is standard output)");
  add_file(c, "--trace", run_.trace, "Write every call of the leader, inputs and answers, to this file");
  declare_pictures(c);
  add_reports(c, run_.report);
  add_file(c, "--log", run_.log, "Write what the leader writes to unit 26 to this file");
  final_only->excludes(free_run);
  for (const char* of_a_path :
       {"--kernels", "--engine", "--trace", "--log", "--max-increments", "--html", "--svg", "--csv", "--vtu"})
    final_only->excludes(c->get_option(of_a_path));
  c->callback([this] { chosen_ = run_; });
}

void contct_parser::declare_pictures(CLI::App* c) {
  picture_options& o = run_.pictures;
  add_file(
      c, "--html", o.html,
      "Write the run as one page to this file: the structure increment by increment, its events, "
      "kernel against kernel, the certificate (- is standard output). A structure given by its matrix is "
      "drawn where coordinates are known, and is a table otherwise");
  add_file(c, "--svg", o.svg,
           "Draw the final state and the load-deflection path to this file (- is standard output)");
  add_file(c, "--csv", o.csv,
           "Write a table, an increment a row, to this file (- is standard output); F.csv has "
           "F.pairs.csv beside it, a row for each pair and increment. Columns: step, increment, kind, s, "
           "share, force, events, closed, open, at_face, smin, kernels; and step, increment, pair, node, "
           "surface, state, look, w, gap, force");
  add_file(c, "--vtu", o.vtu,
           "For ParaView: write the final state to this file; F.vtu has beside it F.000.vtu, F.001.vtu, "
           ".. for the start and each kept increment, every step's final state among them, and F.pvd, "
           "which collects these. A structure given by its matrix must have coordinates");
}

void contct_parser::declare_explain() {
  CLI::App* const c = command("explain", "What the listing did in each increment, line by line, and why");
  add_problem_file(c, explain_.file);
  add(c, takes::number, "--increment", explain_.increment,
      "Only this increment, from 1; STEP.INCREMENT as in 2.1 names its step too")
      ->type_name("INCREMENT");
  add(c, takes::number, "--step", explain_.step, "Only this step, from 1");
  add(c, takes::number, "--pair", explain_.pair, "Only this pair, from 1");
  add_kernels(c, "--kernels", explain_.kernels, "The kernels to put side by side, the first one leads")
      ->capture_default_str();
  add(c, takes::engine, "--engine", explain_.engine, "How the stiffness equations are solved", engines_)
      ->capture_default_str();
  add_file(c, "--json", explain_.json, "Write the explanation to this file (- is standard output)");
  add_quiet(c, explain_.quiet);
  c->callback([this] { chosen_ = explain_; });
}

void contct_parser::declare_new() {
  CLI::App* const c = command("new", "Write a commented problem file to start from");
  add(c, takes::word, "SHAPE", new_.shape, "beam or plate", {"beam", "plate"})->required();
  add_file(c, "FILE", new_.file,
           "Where to; by default beam.toml or plate.toml. Nothing is overwritten. - is standard output");
  c->callback([this] { chosen_ = new_; });
}

void contct_parser::declare_verify() {
  CLI::App* const c =
      command("verify", "Every problem in reference/ against published, closed-form and recomputed numbers");
  add_file(c, "--reference", verify_.reference, "The folder with verification.toml and problems/");
  add_file(c, "--json", verify_.json, "Write all numbers to this file (- is standard output)");
  add_reports(c, verify_.report);
  c->callback([this] { chosen_ = verify_; });
}

void contct_parser::declare_fuzz() {
  CLI::App* const c =
      command("fuzz", "Random and adversarial calls and problems, kernels against each other, to the bit");
  add_kernels(c, "--kernels", fuzz_.request.kernels, "Kernels to compare, the first one leads")
      ->capture_default_str();
  add(c, takes::number, "--calls", fuzz_.request.calls, "Calls, of all shards together")
      ->check(CLI::Range(std::int64_t{1}, most_random_cases))
      ->capture_default_str();
  add(c, takes::number, "--problems", fuzz_.problems, "Whole problems; by default one for 500 calls")
      ->check(CLI::Range(std::int64_t{0}, most_random_cases));
  add(c, takes::number, "--seed", fuzz_.request.seed, "Another seed, other calls")->capture_default_str();
  add(c, takes::number, "--shard", fuzz_.shard, "Only calls and problems I, I + N, ...")->type_name("I/N");
  add(c, takes::file, "--merge", fuzz_.merge, "Add up the --json files of all shards instead of running");
  add_file(c, "--json", fuzz_.json, "Write the result to this file (- is standard output)");
  add_file(c, "--out", fuzz_.out, "Write what is found to this folder: trace, Catch2 test, FORTRAN main");
  add_reports(c, fuzz_.report);
  c->callback([this] { chosen_ = fuzz_; });
}

/// CLI11 would take -1 for the largest unsigned number.
std::string not_negative(const std::string& number) {
  return number.rfind('-', 0) == 0 ? "found " + number + "; allowed: a whole number, at least 0" : "";
}

void contct_parser::declare_atlas() {
  CLI::App* const c = command("atlas", "Where the 1989 code goes wrong, measured on random problems");
  add(c, takes::number, "--problems", atlas_.request.problems,
      "Problems in each cell; the default takes a minute")
      ->check(CLI::Range(1, most_atlas_problems))
      ->capture_default_str();
  add(c, takes::number, "--seed", atlas_.request.seed, "Another seed, other problems")
      ->check(not_negative)
      ->capture_default_str();
  add_file(c, "--csv", atlas_.csv, "Write the cells to this file (- is standard output)");
  add_file(c, "--json", atlas_.json, "Write the cells to this file (- is standard output)");
  add_file(c, "--svg", atlas_.svg, "Draw the picture to this file (- is standard output)");
  add_quiet(c, atlas_.quiet);
  c->callback([this] { chosen_ = atlas_; });
}

void contct_parser::declare_export() {
  CLI::App* const c = command("export", "Write a beam or a plate for another program, CalculiX");
  add_problem_file(c, export_.file);
  add_file(c, "--calculix", export_.calculix,
           "Write CalculiX's input to this file, JOB.inp (- is standard output)")
      ->required();
  add(c, takes::number, "--step", export_.choice.step, "The load step whose end it is [the last]")
      ->check(CLI::Range(1, most_steps));
  add(c, takes::number, "--refine", export_.choice.refine,
      "Elements for each of the problem's, along each side")
      ->check(CLI::Range(1, most_refinement))
      ->capture_default_str();
  add(c, takes::number, "--slenderness", export_.choice.slenderness,
      "The structure's length over its thickness")
      ->check(CLI::Range(10.0, 10'000.0))
      ->capture_default_str();
  c->callback([this] { chosen_ = export_; });
}

/// The commands that print what the program knows of itself.
void contct_parser::declare_texts() {
  command("kernels", "What is built in, and how this machine computes")->callback([this] {
    chosen_ = kernels_options{};
  });
  CLI::App* const c = command("completion", "Print what makes a shell complete the words of contct");
  const std::vector<std::string> shells = {"bash", "zsh", "fish"};
  add(c, takes::word, "SHELL", completion_.shell, "bash, zsh or fish", shells)
      ->required()
      ->check(CLI::IsMember(shells));
  c->callback([this] { chosen_ = completion_; });
  command("man", "Print the manual page")->callback([this] { chosen_ = manual_options{}; });
}

/// Each command's examples stand under its --help, and the first of each under the program's.
void contct_parser::add_examples() {
  std::string first_ones;
  for (CLI::App* c : commands_of(program_)) {
    std::string own;
    for (const example& e : examples_of(c->get_name())) {
      const std::string shown = fmt::format("\n  {}\n      {}", line_of(e), e.text);
      if (own.empty()) first_ones += shown;
      own += shown;
    }
    c->footer("Examples:" + own);
  }
  program_.footer("Examples:" + first_ones + "\ncontct COMMAND --help says more of each.");
}

}  // namespace

command_options parse_contct(int argc, const char* const* argv, const std::vector<std::string>& engines) {
  return contct_parser(engines).parse(argc, argv);
}

command_options parse_contct_replay(int argc, const char* const* argv) {
  return replay_parser().parse(argc, argv);
}

program_description describe_contct(const std::vector<std::string>& engines) {
  return contct_parser(engines).description();
}

}  // namespace contct::app
