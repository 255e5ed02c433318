// contct run: follow the path of a problem, all kernels in lockstep.
#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "app/grid_files.hpp"
#include "app/problem_runs.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/compare/free_run.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/exact/exact_follower.hpp"
#include "contct/exact/exact_residual.hpp"
#include "contct/matrix/cholesky.hpp"
#include "contct/matrix/lapack_identity.hpp"
#include "contct/numeric/probe.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/pictures.hpp"
#include "contct/write/proof_json.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/table.hpp"
#include "contct/write/words.hpp"

namespace contct::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* csv_pairs = "--csv (its pairs)";

/// "out.pairs.csv" beside "out.csv"; none beside standard output.
std::string pairs_table(const std::string& csv) {
  if (csv.empty() || csv == "-") return "";
  return beside(csv, ".pairs" + fs::path(csv).extension().string());
}

/// Every file that these options may write. Throws std::invalid_argument for names that cannot be theirs.
std::vector<output_option> outputs_of(const run_options& o) {
  const auto& [html, csv, vtu] = o.pictures;
  std::vector<output_option> all = {{"--json", o.json},  {"--log", o.log}, {"--trace", o.trace},
                                    {"--html", html},    {"--csv", csv},   {csv_pairs, pairs_table(csv)},
                                    {"--proof", o.proof}};
  if (!vtu.empty()) add_grid_files(vtu, all);
  return with_reports(std::move(all), o.report);
}

void refuse_bad_options(const run_options& o) {
  if (!o.engine.empty()) refuse_engine_option(o.engine);
  for (const std::string& name : o.kernels) {
    if (std::ranges::count(o.kernels, name) > 1)
      throw std::invalid_argument("--kernels: \"" + name + "\" is named twice");
    (void)facts_of_kernel(name);
  }
}

/// The node of --node, from 0: a number from 1, "x = 4.5", or a dof's label. Throws std::invalid_argument.
int node_named(const model& m, const std::string& name) {
  for (int node = 0; node < nodes(m); ++node)
    if (place_name(m, node) == name) return node;
  std::string allowed = fmt::format("a node from 1 to {}", nodes(m));
  if (std::holds_alternative<assembled>(m.kind)) allowed = "the label of a dof";
  if (const auto* b = std::get_if<beam>(&m.kind)) {
    const std::size_t digits = name.find_first_not_of("x= ");
    const auto x =
        digits == std::string::npos || name[0] != 'x' ? std::nullopt : number_in<double>(name.substr(digits));
    if (const auto at = x ? std::ranges::find(b->x, *x) : b->x.end(); at != b->x.end())
      return static_cast<int>(at - b->x.begin());
    allowed += fmt::format(", or x = .. of one, from {} to {}", b->x.front(), b->x.back());
  }
  throw std::invalid_argument(fmt::format("--node: found {}; allowed: {}", in_quotes(name), allowed));
}

/// What is run; complete before any file is opened.
struct run_setup {
  const run_options& options;
  std::vector<output_option> outputs = outputs_of(options);
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
  std::string date = utc_now();
  terminal screen = look_at_terminal();
  bool prints = !options.report.quiet && !takes_standard_output(outputs);  // heading, table and verdicts
  std::vector<std::string> kernels = {};  // the leader first; none under --final-only
  problem what = {};
  linear_structure structure = {};
  std::string engine = "reference";  // of the leader's path
  int watched = 0;                   // the node of --csv, from 0
};

/// In the states in which steps end, by the reference solution.
int node_that_deflects_most(const run_setup& run) {
  struct : observer {
    void step_ended(const step_state& s) override {
      for (const int node : among) most.take(node, deflection_of(*what, s.displacement, node));
    }
    const problem* what = nullptr;
    std::vector<int> among;
    extreme most;
  } ends;
  ends.what = &run.what;
  ends.among = deflecting_nodes(run.what);
  observer* const watching[] = {&ends};
  (void)find_final_states(run.structure, static_cast<int>(run.what.steps.size()),
                          loads_of(run.what, run.structure), watching);
  return ends.most.at;
}

run_setup set_up(const run_options& o) {
  run_setup run{o};
  refuse_bad_options(o);
  run.what = read_with_progress(o.file, run.outputs, o.limits, o.report.quiet);
  if (!o.pictures.vtu.empty()) check_grid_coordinates(run.what);
  run.structure = build_with_progress(run.what, o.report.quiet);
  if (!o.final_only) {
    run.kernels = o.kernels;
    run.engine = engine_for(facts_of_kernel(o.kernels.front()), o.engine, run.structure);
  }
  if (!o.watched.empty()) {
    run.watched = node_named(run.what.geometry, o.watched);
  } else if (!o.pictures.csv.empty()) {
    run.watched = node_that_deflects_most(run);
  }
  return run;
}

/// Writes what the leader writes to unit 26.
struct log_writer final : observer {
  explicit log_writer(output_file& file) : out(file) {}
  void called(const answered_call& c) override { out.write(c.text); }

  output_file& out;
};

trace_header header_of_trace(const run_setup& run, const kernel_facts& leader) {
  trace_header h = header_for(leader, CONTCT_LISTING_SHA256, lapack_identity());
  const std::string& file = run.options.file;
  h.about = {"every call of " + (file == "-" ? "a problem from standard input"
                                             : on_one_line(fs::path(file).filename().string()))};
  if (!run.what.title.empty()) h.about.push_back(on_one_line(run.what.title));
  return h;
}

/// A run's files and the observers of the leader's path. Files are opened before anything is solved: a
/// place that cannot be written is reported at once.
struct observed_run {
  const run_setup& run;
  lockstep* compared;  // null where nothing is compared
  output_files files{run.outputs};
  certifier judged{run.what, run.structure, exact::exact_residual_of(run.what),
                   exact::semidefinite_test_of(run.what)};
  early_toggles early{};
  digit_watch digits{};
  passage_watch passages{run.what};
  path_progress shown{run.what.steps.size(), run.options.report.quiet};
  std::optional<table> rows = {};
  std::optional<result_json> json = {};
  std::optional<log_writer> log = {};
  std::optional<trace_recorder> trace = {};
  std::optional<frame_keeper> frames = {};  // these two for pictures
  std::optional<run_record> record = {};
  std::optional<envelope> extremes = {};
  std::optional<run_csv> tables = {};
  bool has_verdict = false;
};

/// Those that every run has, and those that its options ask for, in the order in which they must observe.
std::vector<observer*> make_observers(observed_run& o) {
  const run_setup& run = o.run;
  if (o.files["--proof"] != nullptr) o.judged.keep_proofs();
  std::vector<observer*> all = {o.compared, &o.judged, &o.early, o.shown.before.get()};
  if (run.prints)
    all.push_back(&o.rows.emplace(run.what, o.compared, o.judged, run.screen, run.options.detail));
  if (output_file* const file = o.files["--json"])
    all.push_back(&o.json.emplace(run.what, run.kernels, run.engine, o.judged, *file));
  if (output_file* const file = o.files["--log"]) all.push_back(&o.log.emplace(*file));
  all.insert(all.end(), {&o.digits, &o.passages, o.shown.behind.get()});
  std::erase(all, nullptr);
  return all;
}

void print_heading(const run_setup& run) {
  if (!run.prints) return;
  for (const std::string& line : wrap({on_one_line(run.what.title)}, run.screen.width))
    if (!line.empty()) print_text(fmt::format("{}\n", painted(run.screen, paint::strong, line)));
  const std::vector<std::string> facts = {
      fmt::format("{}, {}, {}", counted(nodes(run.what.geometry), node_name(run.what.geometry)),
                  counted(run.what.pairs.size(), "pair"), counted(run.what.steps.size(), "step")),
      run.kernels.empty() ? "only the end" : fmt::format("kernels {}", joined(run.kernels, ", ")),
      "engine " + run.engine + (run.structure.stiffness.is_band() ? "" : ", sparse")};
  for (const std::string& line : wrap(facts, run.screen.width)) print_text(fmt::format("{}\n", line));
  print_text("\n");
}

void print_verdict(observed_run& o, paint p, const std::vector<std::string>& items) {
  if (!o.run.prints) return;
  if (!std::exchange(o.has_verdict, true)) print_text("\n");
  print_wrapped(o.run.screen, p, items);
}

/// The words of the table's columns, below it.
void print_legend(observed_run& o) {
  if (!o.rows) return;
  if (const std::vector<std::string> legend = o.rows->legend(); !legend.empty())
    print_verdict(o, paint::quiet, legend);
}

path_limits limits_of(const run_setup& run, certifier& judged) {
  return {run.options.max_increments, judged.fallback(), judged.refiner(),
          exact::exact_follower_of(run.what)};
}

/// The leader's path, observed by all that was asked for, and by `recorded` where that is not null.
path_end follow_leader(observed_run& o, kernel& leader, path_record* recorded) {
  const run_setup& run = o.run;
  std::vector<observer*> observers = make_observers(o);
  if (output_file* const file = o.files["--trace"])
    observers.push_back(&o.trace.emplace(header_of_trace(run, leader.facts()),
                                         [file](std::string_view text) { file->write(text); }));
  if (run.options.envelope) o.extremes.emplace(run.what);
  output_file* const csv = o.files["--csv"];
  if (run.options.pictures.wants_frames() || run.options.envelope || csv != nullptr) {
    const bool forces_by_law = leader.facts().rule != "listing";
    observers.push_back(&o.frames.emplace(run.structure, loads_of(run.what, run.structure), forces_by_law));
    observers.push_back(&o.record.emplace(o.compared));
    if (run.options.envelope) o.frames->show_each_to([&o](const frame& f) { o.extremes->take(f); });
  }
  if (csv != nullptr) {
    o.frames->solve_each();
    observers.push_back(
        &o.tables.emplace(run.what, o.compared, *o.frames, run.watched, *csv, o.files[csv_pairs]));
  }
  if (recorded != nullptr) observers.push_back(recorded);
  path_end end = follow(run.what, run.structure, run.engine, leader, observers, limits_of(run, o.judged));
  o.shown.line.erase();
  print_legend(o);
  return end;
}

/// How the kernels compared.
struct comparison {
  bool equal = true;        // in lockstep: to the bit; on paths of their own: within the bound
  std::string words;        // for reports; empty where nothing was compared
  std::string differences;  // lines
};

/// Print how the comparison came out. A mismatch under a bad probe is the environment's.
comparison report_lockstep(observed_run& o, const lockstep& compared) {
  const std::string names = joined(o.run.kernels, " and ");
  comparison c{compared.compared().mismatches == 0, counts_of(compared), ""};
  if (compared.calls() == 0) {
    print_verdict(o, paint::quiet, {names + " were never called: nothing is compared"});
    return c;
  }
  print_verdict(o, c.equal ? paint::good : paint::bad,
                {fmt::format("{} {} to the bit", names, c.equal ? "are equal" : "are NOT equal"), c.words});
  if (!compared.first()) return c;
  const std::vector<std::string> lines = words_of(*compared.first());
  complain_of(lines);
  c.differences = joined(lines, "\n") + "\n";
  const floating_point fp = probe_floating_point();
  if (!fp.strict()) complain("environment, not kernel: {}", describe(fp));
  return c;
}

/// Print how the path of `name` compares with the leader's, and add that to `c`.
void report_free_run(observed_run& o, const std::string& name, const free_run_difference& d, bool certified,
                     comparison& c) {
  const std::string distances =
      fmt::format("shares of the step within {:.2g}, D within {:.2g} (bound {:.0e})", d.fraction,
                  d.displacement, d.bound);
  print_verdict(o, d.within_bound() ? paint::good : paint::bad,
                {fmt::format("{} in free run: events {}", name, d.same_events ? "the same" : "DIFFERENT"),
                 distances, certified ? "certified" : "NOT certified"});
  c.equal = c.equal && d.within_bound();
  c.words += (c.words.empty() ? "" : "; ") + name + ": " + distances;
  if (!d.first_difference.empty()) {
    c.differences += name + ": " + d.first_difference + "\n";
    complain("{}: first difference: {}", name, d.first_difference);
  }
  for (const auto& [what, difference] :
       {std::pair("a share of the step", d.fraction), {"D", d.displacement}}) {
    if (difference > d.bound)
      complain("{}: {} differs by {:.2g}; allowed: {:.0e}", name, what, difference, d.bound);
  }
}

/// What is wrong with the final states of the leader's path, and what to do about it.
void complain_of_certificate(const observed_run& o) {
  const std::vector<std::string> complaints = certificate_complaints(o.run.what, o.judged, o.early);
  complain_of(complaints);
  if (const std::string remedy = remedy_words(o.run.kernels, o.run.options.file);
      !complaints.empty() && !remedy.empty())
    complain("{}", whole_line(remedy));
}

/// The report for --junit and --markdown.
check_report check_report_of(const observed_run& o, const path_end& end, const comparison& c) {
  const run_setup& run = o.run;
  check_report r{"contct run", common_facts(), {}, 0.0};
  r.facts.push_back(fmt::format("{}: kernels {}", run.options.file, joined(run.kernels, ", ")));
  if (run.kernels.size() > 1) r.results.push_back({"kernels", passed_if(c.equal), c.words, c.differences});
  const std::string ended = end_words(run.what, end);
  const bool solved = end.status == path_status::solved;
  r.results.push_back({"path", passed_if(solved), solved ? "every step's load is applied" : ended, ended});
  if (o.judged.all_exact()) {
    r.results.push_back({"certificate", outcome::passed, "every final state is certified", ""});
  } else {  // without --strict nothing fails for it
    r.results.push_back({"certificate", run.options.strict ? outcome::failed : outcome::skipped,
                         "NOT certified", joined(certificate_complaints(run.what, o.judged, o.early), "\n")});
  }
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - run.started).count();
  return r;
}

/// Complete and name all files.
void write_files(observed_run& o, const path_end& end, const comparison& c) {
  const run_setup& run = o.run;
  const std::string status(c.equal ? status_name(end.status) : "kernels-disagree");
  if (o.json) o.json->finish(status, end, o.compared, o.extremes ? &*o.extremes : nullptr);
  for (const char* name : {"--log", "--trace"})
    if (output_file* const file = o.files[name]) file->finish();
  if (o.tables) o.tables->finish();
  if (o.files["--proof"] != nullptr) o.files.write("--proof", proof_json(run.what, o.judged));
  if (o.frames) {
    const finished_run r{run.what,
                         *o.frames,
                         *o.record,
                         o.judged,
                         o.early,
                         run.options.file,
                         run.kernels,
                         run.engine,
                         status,
                         end_words(run.what, end),
                         o.compared != nullptr,
                         c.equal,
                         c.words,
                         common_facts(),
                         run.date,
                         o.extremes ? &*o.extremes : nullptr};
    if (o.files["--html"] != nullptr) o.files.write("--html", run_page(r));
    if (o.files["--vtu"] != nullptr) write_grids(o.files, run.options.pictures.vtu, r);
  }
  o.files.write(check_report_of(o, end, c));
}

/// What every run ends with: certificate, messages, files, exit status.
exit_status finish(observed_run& o, const path_end& end, const comparison& c) {
  const bool solved = end.status == path_status::solved;
  std::vector<std::string> summary = certificate_summary(o.judged, solved);
  if (solved && o.judged.all_exact()) summary.front() += " for this mesh";
  print_verdict(o, solved && o.judged.all_exact() ? paint::good : paint::bad, summary);
  const bool uncertified = o.run.options.strict && !o.judged.all_exact();
  const exit_status status = !c.equal                ? exit_status::kernels_differ
                             : solved && uncertified ? exit_status::uncertified
                                                     : status_of(end.status);
  if (status != exit_status::bad_input) write_files(o, end, c);  // without numbers no files
  flush_standard_output();                                       // the table before what is said about it
  complain_of_certificate(o);
  if (end.status != path_status::solved) {
    complain("{}: {}", whole_line(o.run.options.file), end_words(o.run.what, end));
  } else if (const std::string w = o.digits.warning(); !w.empty()) {
    complain("warning: {}", w);
  }
  if (const std::string w = o.passages.warning(); !w.empty()) complain("warning: {}", w);
  return status;
}

/// No path: the equilibrium under each step's load, by the oracle.
exit_status final_states(const run_setup& run) {
  observed_run o{run, nullptr};
  print_heading(run);
  const path_end end = find_final_states(run.structure, static_cast<int>(run.what.steps.size()),
                                         loads_of(run.what, run.structure), make_observers(o), &o.judged,
                                         exact::exact_follower_of(run.what));
  o.shown.line.erase();
  print_legend(o);
  print_verdict(o, paint::quiet,
                {"only the end of each step, no path", fmt::format("{} factorisations", end.work.factors)});
  return finish(o, end, {});
}

/// The leader's path, every call put to the other kernels.
exit_status lockstep_run(const run_setup& run) {
  const std::unique_ptr<kernel> leader = make_kernel(run.kernels.front());
  lockstep compared = make_lockstep(leader->facts(), std::span(run.kernels).subspan(1));
  const bool alone = run.kernels.size() == 1;
  observed_run o{run, alone ? nullptr : &compared};
  print_heading(run);
  const path_end end = follow_leader(o, *leader, nullptr);
  return finish(o, end, alone ? comparison{} : report_lockstep(o, compared));
}

/// Every kernel on a path of its own, one after the other: unit 26 exists only once.
exit_status free_run(const run_setup& run) {
  observed_run o{run, nullptr};
  print_heading(run);
  path_record leader;
  leader.end = follow_leader(o, *make_kernel(run.kernels.front()), &leader);
  comparison c;
  for (const std::string& name : std::span(run.kernels).subspan(1)) {
    path_record own;
    certifier judged(run.what, run.structure, exact::exact_residual_of(run.what),
                     exact::semidefinite_test_of(run.what));
    own.end =
        follow(run.what, run.structure, engine_for(facts_of_kernel(name), run.options.engine, run.structure),
               *make_kernel(name), {&judged, &own}, limits_of(run, judged));
    const double bound = free_run_bound(facts_of_kernel(run.kernels.front()), facts_of_kernel(name));
    const free_run_difference d = compare_paths(leader, own, bound, run.structure.dofs_per_node);
    if (o.json) o.json->add_free_run(name, d, judged.all_exact());
    report_free_run(o, name, d, judged.all_exact(), c);
  }
  return finish(o, leader.end, c);
}

}  // namespace

exit_status run_command(const run_options& options) {
  const run_setup run = set_up(options);
  if (options.final_only) return final_states(run);
  return options.free_run ? free_run(run) : lockstep_run(run);
}

}  // namespace contct::app
