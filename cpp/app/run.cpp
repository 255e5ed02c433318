// contct run: follow the path of a problem, all kernels in lockstep.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "app/commands.hpp"
#include "app/exit_messages.hpp"
#include "app/path_progress.hpp"
#include "app/read_problem.hpp"
#include "app/report_options.hpp"
#include "app/run_pictures.hpp"
#include "app/streams.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/certify/fallback.hpp"
#include "contct/certify/final_state.hpp"
#include "contct/compare/early_toggles.hpp"
#include "contct/compare/free_run.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/compare/trace_recorder.hpp"
#include "contct/matrix/lapack.hpp"
#include "contct/numeric/probe.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/solve/engine.hpp"
#include "contct/text/output_file.hpp"
#include "contct/write/certificate_text.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/table.hpp"

namespace contct {
namespace {

struct run_options {
  std::string file;
  std::vector<std::string> kernels = {"fortran", "cpp"};
  std::string engine;  // empty: what suits the leader
  std::string json;
  std::string log;
  std::string trace;
  report_options report;
  picture_options pictures;
  bool free_run = false;
  bool final_only = false;
  bool strict = false;
  int max_increments = 0;
};

/// Keeps what the leader writes to unit 26.
class log_writer final : public observer {
 public:
  explicit log_writer(output_file& out) : out_(out) {}
  void called(const answered_call& c) override { out_.write(c.text); }

 private:
  output_file& out_;
};

/// "1 node", "3 nodes".
template <class Count>
std::string counted(Count n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

/// One run of `contct run`: what is wrong is refused first, then files are opened, then it is solved.
class run {
 public:
  explicit run(const run_options& options)
      : options_(options),
        terminal_(look_at_terminal()),
        shows_table_(!options.report.quiet && !takes_standard_output(outputs())) {}

  exit_status go() {
    refuse_bad_options();
    read();
    refuse_shared_outputs(outputs(), {{"the problem", options_.file}});
    if (options_.final_only) return final_only();
    return options_.free_run ? free_run() : lockstep_run();
  }

 private:
  void refuse_bad_options() const {
    if (!options_.engine.empty() && options_.engine != "auto") refuse_unknown_engine(options_.engine);
    for (const std::string& name : options_.kernels) {
      if (std::count(options_.kernels.begin(), options_.kernels.end(), name) > 1)
        throw std::invalid_argument("--kernels: \"" + name + "\" is named twice");
      (void)facts_of_kernel(name);
    }
  }

  void read() {
    problem_ = read_as_one_waits(options_.file, options_.report.quiet);
    for (const std::string& w : problem_.warnings) complain("warning: {}", w);
    refuse_grid_without_coordinates();
    warn_of_pairs_without_cell();
    structure_ = build_as_one_waits(problem_, options_.report.quiet);
    judged_.emplace(structure_, loads_of(problem_));
    engine_ = engine_for(options_.kernels.front());
  }

  /// A grid has points. Everything else that is asked for does without, as a table.
  void refuse_grid_without_coordinates() const {
    const auto* a = std::get_if<assembled>(&problem_.geometry.kind);
    if (a == nullptr || options_.pictures.vtu.empty() || a->places.known()) return;
    throw std::invalid_argument(
        fmt::format("--vtu: found a structure given by its matrix, {}, without coordinates; allowed: one "
                    "with coordinates, by "
                    "coordinates = \"FILE\" in [matrix] or CalculiX's mesh, JOB.inp beside its matrix or "
                    "mesh = \"FILE\" in "
                    "[calculix]. --csv and --json have all its numbers, by label",
                    a->name));
  }

  void warn_of_pairs_without_cell() const {
    const auto* a = std::get_if<assembled>(&problem_.geometry.kind);
    if (a == nullptr || options_.pictures.vtu.empty()) return;
    const auto lost = std::count_if(problem_.pairs.begin(), problem_.pairs.end(), [a](const contact_pair& p) {
      return a->places.dofs[static_cast<std::size_t>(p.node)].node < 0;
    });
    if (lost > 0)
      complain("warning: --vtu: {} of {} pairs {} no cell: the places of their dofs are not known", lost,
               problem_.pairs.size(), lost == 1 ? "has" : "have");
  }

  [[nodiscard]] std::vector<output_option> outputs() const {
    return with_reports(
        with_pictures({{"--json", options_.json}, {"--log", options_.log}, {"--trace", options_.trace}},
                      options_.pictures),
        options_.report);
  }

  /// The engine of a path that `name` leads. The 1989 way for the 1989 rule, unless asked otherwise: it is
  /// there to be faithful. The quickest for others.
  [[nodiscard]] std::string engine_for(const std::string& name) const {
    const bool as_listed = options_.engine.empty() && facts_of_kernel(name).rule == "listing";
    if (as_listed) return "refactor";
    if (!options_.engine.empty() && options_.engine != "auto") return options_.engine;
    return std::string(quickest_engine(structure_));
  }

  /// No path: the equilibrium under each step's load, by the oracle.
  exit_status final_only() {
    options_.kernels.clear();
    engine_ = "oracle";
    open_outputs();
    print_heading();
    const path_end end = find_final_states(structure_, static_cast<int>(problem_.steps.size()),
                                           loads_of(problem_), observers(nullptr));
    shown_.reset();
    print_verdict(paint::quiet, {"only the end: the oracle's, judged by equilibrium, penetration and tension",
                                 fmt::format("{} factorisations", end.work.factors)});
    return finish(end, true, nullptr);
  }

  exit_status lockstep_run() {
    const std::unique_ptr<kernel> leader = make_kernel(options_.kernels[0]);
    const bool alone = options_.kernels.size() == 1;
    lockstep compared = make_lockstep(leader->facts(), std::span(options_.kernels).subspan(1));
    open_outputs();
    print_heading();
    const path_end end = follow_observed(*leader, alone ? nullptr : &compared, nullptr);
    if (alone) return finish(end, true, nullptr);
    report_lockstep(compared);
    return finish(end, compared.compared().mismatches == 0, &compared);
  }

  /// Drive every kernel on a path of its own, one after the other: unit 26 is there only once.
  exit_status free_run() {
    open_outputs();
    print_heading();
    path_record leader;
    leader.end = follow_observed(*make_kernel(options_.kernels[0]), nullptr, &leader);
    bool all_within = true;
    for (std::size_t i = 1; i < options_.kernels.size(); ++i) {
      const std::string& name = options_.kernels[i];
      path_record own;
      certifier judged(structure_, loads_of(problem_));
      own.end = follow(problem_, structure_, engine_for(name), *make_kernel(name), {&judged, &own}, limits());
      const double bound = free_run_bound(facts_of_kernel(options_.kernels[0]), facts_of_kernel(name));
      const free_run_difference d = compare_paths(leader, own, bound, structure_.dofs_per_node);
      all_within = all_within && d.within_bound();
      if (json_) json_->add_free_run(name, d, judged.all_exact());
      report_free_run(name, d, judged);
    }
    return finish(leader.end, all_within, nullptr);
  }

  /// The leader's path, under the eyes of all that was asked for.
  path_end follow_observed(kernel& leader, lockstep* compared, path_record* record) {
    std::vector<observer*> watching = observers(compared);
    if (!options_.trace.empty())
      watching.push_back(&recorder_.emplace(header_of_trace(leader), trace_sink()));
    const bool forces_by_law = leader.facts().rule != "listing";
    for (observer* drawing :
         pictures_->observe(problem_, structure_, loads_of(problem_), compared, forces_by_law))
      watching.push_back(drawing);
    if (record != nullptr) watching.push_back(record);
    path_end end = follow(problem_, structure_, engine_, leader, watching, limits());
    shown_.reset();
    return end;
  }

  /// Those that watch every run.
  std::vector<observer*> observers(lockstep* compared) {
    std::vector<observer*> watching;
    if (compared != nullptr) watching.push_back(compared);
    watching.push_back(&*judged_);
    watching.push_back(&early_);
    shown_.emplace(problem_.steps.size(), options_.report.quiet);
    watching.push_back(shown_->before());
    if (shows_table_) watching.push_back(&table_.emplace(problem_, compared, *judged_, terminal_));
    if (json_) watching.push_back(&*json_);
    if (log_) watching.push_back(&*log_);
    watching.push_back(&digits_);
    watching.push_back(shown_->behind());
    return watching;
  }

  [[nodiscard]] path_limits limits() const {
    return {options_.max_increments, fallback_to_reference(structure_)};
  }

  /// Before anything is solved: a place that cannot be written is found out at once.
  void open_outputs() {
    if (!options_.json.empty()) {
      json_file_.emplace(options_.json);
      json_.emplace(problem_, options_.kernels, engine_, *judged_, *json_file_);
    }
    if (!options_.log.empty()) {
      log_file_.emplace(options_.log);
      log_.emplace(*log_file_);
    }
    if (!options_.trace.empty()) trace_file_.emplace(options_.trace);
    pictures_.emplace(options_.pictures);
    reports_.emplace(options_.report);
  }

  [[nodiscard]] trace_header header_of_trace(const kernel& leader) const {
    trace_header h = header_for(leader.facts(), CONTCT_LISTING_SHA256, lapack_identity());
    h.about = {fmt::format("every call of {}",
                           options_.file == "-" ? "a problem from standard input"
                                                : std::filesystem::path(options_.file).filename().string())};
    if (!problem_.title.empty()) h.about.push_back(on_one_line(problem_.title));
    return h;
  }

  trace_recorder::sink trace_sink() {
    return [this](std::string_view text) { trace_file_->write(text); };
  }

  void print_heading() const {
    if (!shows_table_) return;
    for (const std::string& line : wrap({problem_.title}, terminal_.width))
      if (!line.empty()) fmt::print("{}\n", painted(terminal_, paint::strong, line));
    const std::vector<std::string> facts = {
        fmt::format("{}, {}, {}", counted(nodes(problem_.geometry), node_name(problem_.geometry)),
                    counted(problem_.pairs.size(), "pair"), counted(problem_.steps.size(), "step")),
        options_.final_only ? "only the end" : fmt::format("kernels {}", fmt::join(options_.kernels, ", ")),
        "engine " + engine_ + (structure_.stiffness.is_band() ? "" : ", sparse")};
    for (const std::string& line : wrap(facts, terminal_.width)) fmt::print("{}\n", line);
    fmt::print("\n");
  }

  void print_verdict(paint p, const std::vector<std::string>& items) {
    if (!shows_table_) return;
    if (!std::exchange(has_verdict_, true)) fmt::print("\n");
    for (const std::string& line : wrap(items, terminal_.width))
      fmt::print("{}\n", painted(terminal_, p, line));
  }

  /// Say how the comparison came out. A mismatch under a bad probe is the environment's.
  void report_lockstep(const lockstep& compared) {
    const tally& t = compared.compared();
    const std::string names = fmt::format("{}", fmt::join(options_.kernels, " and "));
    compared_words_ =
        fmt::format("{} calls, {} values compared, {} mismatches", compared.calls(), t.values, t.mismatches);
    if (compared.calls() == 0)
      return print_verdict(paint::quiet, {names + " were never called: nothing is compared"});
    const bool equal = t.mismatches == 0;
    print_verdict(
        equal ? paint::good : paint::bad,
        {fmt::format("{} {} to the bit", names, equal ? "are equal" : "are NOT equal"), compared_words_});
    if (!compared.first()) return;
    for (const std::string& line : words_of(*compared.first())) {
      complain("{}", line);
      differences_ += line + "\n";
    }
    const floating_point fp = probe_floating_point();
    if (!fp.strict()) complain("environment, not kernel: {}", describe(fp));
  }

  void report_free_run(const std::string& name, const free_run_difference& d, const certifier& judged) {
    print_verdict(
        d.within_bound() ? paint::good : paint::bad,
        {fmt::format("{} on a path of its own: events {}", name, d.same_events ? "the same" : "DIFFERENT"),
         fmt::format("load fractions within {:.2g}, D within {:.2g} (bound {:.0e})", d.fraction,
                     d.displacement, d.bound),
         judged.all_exact() ? "certified" : "NOT certified"});
    compared_words_ +=
        fmt::format("{}{}: load fractions within {:.2g}, D within {:.2g} (bound {:.0e})",
                    compared_words_.empty() ? "" : "; ", name, d.fraction, d.displacement, d.bound);
    if (!d.first_difference.empty()) differences_ += name + ": " + d.first_difference + "\n";
    if (!d.first_difference.empty()) complain("{}: first difference: {}", name, d.first_difference);
    for (const auto& [what, difference] : {std::pair("a load fraction", d.fraction), {"D", d.displacement}}) {
      if (difference <= d.bound) continue;
      complain("{}: {} differs by {:.2g}; allowed: {:.0e}", name, what, difference, d.bound);
    }
  }

  /// The certificate of the leader's path, for people.
  void report_certificate() {
    if (auto items = certificate_summary(*judged_); !items.empty()) {
      if (options_.final_only) items.resize(1);  // the oracle would agree with itself
      const bool good = std::none_of(judged_->steps().begin(), judged_->steps().end(),
                                     [](const auto& c) { return c && !c->exact; });
      print_verdict(good ? paint::good : paint::bad, items);
    }
    flush_standard_output();
    for (const std::string& line : certificate_complaints(problem_, *judged_, early_)) complain("{}", line);
  }

  exit_status finish(const path_end& end, bool equal, const lockstep* compared) {
    report_certificate();
    flush_standard_output();  // the table before what is said about it; and no files when it is lost
    if (end.status == path_status::solved) {
      if (const std::string w = digits_.warning(); !w.empty()) complain("warning: {}", w);
    } else {
      complain("{}: {}", options_.file, end_words(problem_, end));
    }
    const exit_status status = equal ? certified_status_of(end.status) : exit_status::kernels_differ;
    if (status == exit_status::bad_input) return status;  // no numbers, and no files
    if (json_) json_->finish(equal ? status_name(end.status) : "kernels-disagree", end, compared);
    if (log_) log_file_->finish();
    if (trace_file_) trace_file_->finish();
    pictures_->finish([&] { return finished(end, equal, compared != nullptr); });
    reports_->write(check_report_of(end, equal));
    return status;
  }

  /// What pictures are made from.
  [[nodiscard]] finished_run finished(const path_end& end, bool equal, bool in_lockstep) const {
    return {problem_,
            pictures_->kept(),
            pictures_->record(),
            *judged_,
            early_,
            options_.file,
            options_.kernels,
            engine_,
            std::string(equal ? status_name(end.status) : "kernels-disagree"),
            end_words(problem_, end),
            in_lockstep,
            equal,
            compared_words_,
            common_facts()};
  }

  /// What a CI system is told.
  [[nodiscard]] check_report check_report_of(const path_end& end, bool equal) const {
    check_report r{"contct run", common_facts(), {}, 0.0};
    r.facts.push_back(options_.file + ": kernels " + fmt::format("{}", fmt::join(options_.kernels, ", ")));
    if (options_.kernels.size() > 1)
      r.results.push_back(
          {"kernels", equal ? outcome::passed : outcome::failed, compared_words_, differences_});
    const std::string ended = end_words(problem_, end);
    const bool solved = end.status == path_status::solved;
    r.results.push_back({"path", solved ? outcome::passed : outcome::failed,
                         solved ? "every step's load is applied" : ended, ended});
    const bool exact = judged_->all_exact();
    r.results.push_back(
        {"certificate",
         exact             ? outcome::passed
         : options_.strict ? outcome::failed
                           : outcome::skipped,
         exact ? "every final state is certified" : "NOT certified",
         exact ? ""
               : fmt::format("{}", fmt::join(certificate_complaints(problem_, *judged_, early_), "\n"))});
    r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
    return r;
  }

  [[nodiscard]] exit_status certified_status_of(path_status status) const {
    if (status == path_status::solved && options_.strict && !judged_->all_exact())
      return exit_status::uncertified;
    return status_of(status);
  }

  run_options options_;
  std::string engine_;  // of the leader's path
  terminal terminal_;
  bool shows_table_;
  problem problem_;
  linear_structure structure_;
  std::optional<output_file> json_file_, log_file_, trace_file_;
  std::optional<trace_recorder> recorder_;
  std::optional<run_pictures> pictures_;
  std::optional<report_files> reports_;
  std::string compared_words_, differences_;  // how the kernels compared, for the reports
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::optional<result_json> json_;
  std::optional<log_writer> log_;
  std::optional<table> table_;
  std::optional<certifier> judged_;
  early_toggles early_;
  std::optional<path_progress> shown_;
  digit_watch digits_;
  bool has_verdict_ = false;
};

}  // namespace

void add_run(CLI::App& program, exit_status& status) {
  auto options = std::make_shared<run_options>();
  CLI::App* const command =
      program.add_subcommand("run", "Follow the path of a problem, all kernels in lockstep");
  command->add_option("FILE", options->file, "The problem (TOML); - reads standard input")->required();
  command->add_option("--kernels", options->kernels, "Kernels to run, the first one leads")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--engine", options->engine,
                      fmt::format("How the stiffness equations are solved: auto, {} [refactor for the 1989 "
                                  "rule, auto for others]",
                                  fmt::join(engine_names(), ", ")));
  CLI::Option* const free_run =
      command->add_flag("--free-run", options->free_run,
                        "Drive each kernel on a path of its own; compare events, load fractions and D");
  CLI::Option* const final_only =
      command->add_flag("--final-only", options->final_only,
                        "No path: the equilibrium under each step's load by the oracle, certified");
  final_only->excludes(free_run)->excludes("--kernels")->excludes("--engine");
  command->add_flag("--strict", options->strict, "Exit 3 when a final state is not certified");
  command->add_option("--max-increments", options->max_increments, "Limit of increments in a step")
      ->check(CLI::Range(1, most_increments));
  command->add_option("--json", options->json, "Write the result to this file (- is standard output)");
  command->add_option("--trace", options->trace,
                      "Write every call of the leader, inputs and answers, to this file");
  add_picture_options(*command, options->pictures);
  add_report_options(*command, options->report);
  command->add_option("--log", options->log, "Write what the leader writes to unit 26 to this file");
  for (const char* of_a_path : {"--trace", "--log", "--max-increments", "--html", "--svg", "--csv", "--vtu"})
    final_only->excludes(command->get_option(of_a_path));
  command->callback([options, &status] { status = run(*options).go(); });
}

}  // namespace contct
