// contct run: follow the path of a problem, all kernels in lockstep.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "app/commands.hpp"
#include "app/exit_messages.hpp"
#include "app/outputs.hpp"
#include "app/problem_progress.hpp"
#include "app/run_pictures.hpp"
#include "app/streams.hpp"
#include "contct/certify/certificate.hpp"
#include "contct/compare/free_run.hpp"
#include "contct/compare/lockstep.hpp"
#include "contct/matrix/lapack.hpp"
#include "contct/numeric/probe.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/text/joined.hpp"
#include "contct/write/certificate_text.hpp"
#include "contct/write/result_json.hpp"
#include "contct/write/table.hpp"

namespace contct::app {
namespace {

/// What is run; complete before any file is opened.
struct run_setup {
  const run_options& options;
  std::chrono::steady_clock::time_point started;
  std::vector<std::string> kernels;  // the leader first; none under --final-only
  problem what;
  linear_structure structure;
  std::string engine;  // of the leader's path
  terminal screen;
  bool prints;  // heading, table and verdicts
};

std::vector<output_option> outputs_of(const run_options& o) {
  return with_reports(with_pictures({{"--json", o.json}, {"--log", o.log}, {"--trace", o.trace}}, o.pictures),
                      o.report);
}

void refuse_bad_options(const run_options& o) {
  if (!o.engine.empty() && o.engine != "auto") refuse_unknown_engine(o.engine);
  for (const std::string& name : o.kernels) {
    if (std::count(o.kernels.begin(), o.kernels.end(), name) > 1)
      throw std::invalid_argument("--kernels: \"" + name + "\" is named twice");
    (void)facts_of_kernel(name);
  }
}

/// The engine of a path that `kernel` leads: unless asked otherwise, one factorisation an increment, as in
/// 1989, for the 1989 rule; the quickest for others.
std::string engine_for(const std::string& kernel, const run_options& o, const linear_structure& s) {
  if (o.engine.empty() && facts_of_kernel(kernel).rule == "listing") return "refactor";
  if (!o.engine.empty() && o.engine != "auto") return o.engine;
  return std::string(quickest_engine(s));
}

run_setup set_up(const run_options& o, const std::vector<output_option>& outputs) {
  const auto started = std::chrono::steady_clock::now();
  refuse_bad_options(o);
  problem p = read_with_progress(o.file, o.report.quiet);
  if (!o.pictures.vtu.empty()) check_grid_coordinates(p);
  linear_structure s = build_with_progress(p, o.report.quiet);
  std::string engine = o.final_only ? "oracle" : engine_for(o.kernels.front(), o, s);
  refuse_shared_outputs(outputs, {{"the problem", o.file}});
  return {.options = o,
          .started = started,
          .kernels = o.final_only ? std::vector<std::string>() : o.kernels,
          .what = std::move(p),
          .structure = std::move(s),
          .engine = std::move(engine),
          .screen = look_at_terminal(),
          .prints = !o.report.quiet && !takes_standard_output(outputs)};
}

/// Writes what the leader writes to unit 26.
class log_writer final : public observer {
 public:
  explicit log_writer(output_file& out) : out_(out) {}
  void called(const answered_call& c) override { out_.write(c.text); }

 private:
  output_file& out_;
};

trace_header header_of_trace(const run_setup& run, const kernel_facts& leader) {
  trace_header h = header_for(leader, CONTCT_LISTING_SHA256, lapack_identity());
  const std::string& file = run.options.file;
  h.about = {"every call of " + (file == "-" ? "a problem from standard input"
                                             : std::filesystem::path(file).filename().string())};
  if (!run.what.title.empty()) h.about.push_back(on_one_line(run.what.title));
  return h;
}

/// A run's files and the observers of the leader's path. Files are opened before anything is solved: a
/// place that cannot be written is reported at once.
struct observed_run {
  /// `r` must outlive this object, and so must `lockstep_of_run`, which is null where nothing is compared.
  observed_run(const run_setup& r, lockstep* lockstep_of_run);

  /// In the order in which they must observe.
  std::vector<observer*> observers();

  const run_setup& run;
  lockstep* compared;
  std::unique_ptr<output_file> json_file, log_file, trace_file;
  run_pictures pictures;
  report_files reports;
  certifier judged;
  early_toggles early;
  digit_watch digits;
  path_progress shown;
  std::optional<table> rows;
  std::optional<result_json> json;
  std::optional<log_writer> log;
  std::optional<trace_recorder> trace;
  bool has_verdict = false;
};

observed_run::observed_run(const run_setup& r, lockstep* lockstep_of_run)
    : run(r),
      compared(lockstep_of_run),
      json_file(open_output({"--json", r.options.json})),
      log_file(open_output({"--log", r.options.log})),
      trace_file(open_output({"--trace", r.options.trace})),
      pictures(r.options.pictures),
      reports(r.options.report),
      judged(r.structure, loads_of(r.what)),
      shown(r.what.steps.size(), r.options.report.quiet) {
  if (r.prints) rows.emplace(r.what, compared, judged, r.screen);
  if (json_file) json.emplace(r.what, r.kernels, r.engine, judged, *json_file);
  if (log_file) log.emplace(*log_file);
}

std::vector<observer*> observed_run::observers() {
  std::vector<observer*> all = {compared, &judged, &early, shown.before()};
  if (rows) all.push_back(&*rows);
  if (json) all.push_back(&*json);
  if (log) all.push_back(&*log);
  all.insert(all.end(), {&digits, shown.behind()});
  std::erase(all, nullptr);
  return all;
}

/// "1 node", "3 nodes".
template <class Count>
std::string counted(Count n, std::string_view what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

void print_heading(const run_setup& run) {
  if (!run.prints) return;
  for (const std::string& line : wrap({run.what.title}, run.screen.width))
    if (!line.empty()) fmt::print("{}\n", painted(run.screen, paint::strong, line));
  const std::vector<std::string> facts = {
      fmt::format("{}, {}, {}", counted(nodes(run.what.geometry), node_name(run.what.geometry)),
                  counted(run.what.pairs.size(), "pair"), counted(run.what.steps.size(), "step")),
      run.kernels.empty() ? "only the end" : fmt::format("kernels {}", joined(run.kernels, ", ")),
      "engine " + run.engine + (run.structure.stiffness.is_band() ? "" : ", sparse")};
  for (const std::string& line : wrap(facts, run.screen.width)) fmt::print("{}\n", line);
  fmt::print("\n");
}

void print_verdict(observed_run& o, paint p, const std::vector<std::string>& items) {
  if (!o.run.prints) return;
  if (!std::exchange(o.has_verdict, true)) fmt::print("\n");
  for (const std::string& line : wrap(items, o.run.screen.width))
    fmt::print("{}\n", painted(o.run.screen, p, line));
}

path_limits limits_of(const run_setup& run) {
  return {run.options.max_increments, fallback_to_reference(run.structure)};
}

/// The leader's path, observed by all that was asked for, and by `record` where that is not null.
path_end follow_leader(observed_run& o, kernel& leader, path_record* record) {
  const run_setup& run = o.run;
  std::vector<observer*> observers = o.observers();
  if (o.trace_file)
    observers.push_back(&o.trace.emplace(header_of_trace(run, leader.facts()),
                                         [&o](std::string_view text) { o.trace_file->write(text); }));
  const bool forces_by_law = leader.facts().rule != "listing";
  for (observer* drawing :
       o.pictures.observe(run.what, run.structure, loads_of(run.what), o.compared, forces_by_law))
    observers.push_back(drawing);
  if (record != nullptr) observers.push_back(record);
  path_end end = follow(run.what, run.structure, run.engine, leader, observers, limits_of(run));
  o.shown.erase();
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
  const tally& t = compared.compared();
  const std::string names = joined(o.run.kernels, " and ");
  comparison c{
      t.mismatches == 0,
      fmt::format("{} calls, {} values compared, {} mismatches", compared.calls(), t.values, t.mismatches),
      ""};
  if (compared.calls() == 0) {
    print_verdict(o, paint::quiet, {names + " were never called: nothing is compared"});
    return c;
  }
  print_verdict(o, c.equal ? paint::good : paint::bad,
                {fmt::format("{} {} to the bit", names, c.equal ? "are equal" : "are NOT equal"), c.words});
  if (!compared.first()) return c;
  for (const std::string& line : words_of(*compared.first())) {
    complain("{}", line);
    c.differences += line + "\n";
  }
  const floating_point fp = probe_floating_point();
  if (!fp.strict()) complain("environment, not kernel: {}", describe(fp));
  return c;
}

/// Print how the path of `name` compares with the leader's, and add that to `c`.
void report_free_run(observed_run& o, const std::string& name, const free_run_difference& d, bool certified,
                     comparison& c) {
  const std::string distances = fmt::format("load fractions within {:.2g}, D within {:.2g} (bound {:.0e})",
                                            d.fraction, d.displacement, d.bound);
  print_verdict(
      o, d.within_bound() ? paint::good : paint::bad,
      {fmt::format("{} on a path of its own: events {}", name, d.same_events ? "the same" : "DIFFERENT"),
       distances, certified ? "certified" : "NOT certified"});
  c.equal = c.equal && d.within_bound();
  c.words += (c.words.empty() ? "" : "; ") + name + ": " + distances;
  if (!d.first_difference.empty()) {
    c.differences += name + ": " + d.first_difference + "\n";
    complain("{}: first difference: {}", name, d.first_difference);
  }
  for (const auto& [what, difference] : {std::pair("a load fraction", d.fraction), {"D", d.displacement}}) {
    if (difference > d.bound)
      complain("{}: {} differs by {:.2g}; allowed: {:.0e}", name, what, difference, d.bound);
  }
}

/// The certificate of the leader's path, for people.
void report_certificate(observed_run& o) {
  if (const auto items = certificate_summary(o.judged); !items.empty()) {
    const bool good = std::none_of(o.judged.steps().begin(), o.judged.steps().end(),
                                   [](const auto& c) { return c && !c->exact; });
    print_verdict(o, good ? paint::good : paint::bad, items);
  }
  flush_standard_output();  // the table before what is said about it; and no files when it is lost
  for (const std::string& line : certificate_complaints(o.run.what, o.judged, o.early)) complain("{}", line);
}

/// The result of the certificate as a check. Without --strict nothing fails for it.
check_result certificate_result(const observed_run& o) {
  if (o.judged.all_exact()) return {"certificate", outcome::passed, "every final state is certified", ""};
  return {"certificate", o.run.options.strict ? outcome::failed : outcome::skipped, "NOT certified",
          joined(certificate_complaints(o.run.what, o.judged, o.early), "\n")};
}

/// The report for --junit and --markdown.
check_report check_report_of(const observed_run& o, const path_end& end, const comparison& c) {
  const run_setup& run = o.run;
  check_report r{"contct run", common_facts(), {}, 0.0};
  r.facts.push_back(fmt::format("{}: kernels {}", run.options.file, joined(run.kernels, ", ")));
  if (run.kernels.size() > 1)
    r.results.push_back({"kernels", c.equal ? outcome::passed : outcome::failed, c.words, c.differences});
  const std::string ended = end_words(run.what, end);
  const bool solved = end.status == path_status::solved;
  r.results.push_back({"path", solved ? outcome::passed : outcome::failed,
                       solved ? "every step's load is applied" : ended, ended});
  r.results.push_back(certificate_result(o));
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - run.started).count();
  return r;
}

exit_status exit_status_of(const observed_run& o, path_status ended, bool equal) {
  if (!equal) return exit_status::kernels_differ;
  const bool uncertified = o.run.options.strict && !o.judged.all_exact();
  return ended == path_status::solved && uncertified ? exit_status::uncertified : status_of(ended);
}

/// Complete and name all files.
void write_files(observed_run& o, const path_end& end, const comparison& c) {
  const std::string status(c.equal ? status_name(end.status) : "kernels-disagree");
  if (o.json) o.json->finish(status, end, o.compared);
  if (o.log_file) o.log_file->finish();
  if (o.trace_file) o.trace_file->finish();
  o.pictures.finish([&]() -> finished_run {
    return {o.run.what,
            o.pictures.kept(),
            o.pictures.record(),
            o.judged,
            o.early,
            o.run.options.file,
            o.run.kernels,
            o.run.engine,
            status,
            end_words(o.run.what, end),
            o.compared != nullptr,
            c.equal,
            c.words,
            common_facts()};
  });
  o.reports.write(check_report_of(o, end, c));
}

/// What every run ends with: certificate, messages, files, exit status.
exit_status finish(observed_run& o, const path_end& end, const comparison& c) {
  report_certificate(o);
  if (end.status != path_status::solved) {
    complain("{}: {}", o.run.options.file, end_words(o.run.what, end));
  } else if (const std::string w = o.digits.warning(); !w.empty()) {
    complain("warning: {}", w);
  }
  const exit_status status = exit_status_of(o, end.status, c.equal);
  if (status != exit_status::bad_input) write_files(o, end, c);  // without numbers no files
  return status;
}

/// No path: the equilibrium under each step's load, by the oracle.
exit_status final_states(const run_setup& run) {
  observed_run o(run, nullptr);
  print_heading(run);
  const path_end end = find_final_states(run.structure, static_cast<int>(run.what.steps.size()),
                                         loads_of(run.what), o.observers());
  o.shown.erase();
  print_verdict(o, paint::quiet,
                {"only the end: the oracle's, judged by equilibrium, penetration and tension",
                 fmt::format("{} factorisations", end.work.factors)});
  return finish(o, end, {});
}

/// The leader's path, every call put to the other kernels.
exit_status lockstep_run(const run_setup& run) {
  const std::unique_ptr<kernel> leader = make_kernel(run.kernels.front());
  lockstep compared = make_lockstep(leader->facts(), std::span(run.kernels).subspan(1));
  const bool alone = run.kernels.size() == 1;
  observed_run o(run, alone ? nullptr : &compared);
  print_heading(run);
  const path_end end = follow_leader(o, *leader, nullptr);
  return finish(o, end, alone ? comparison{} : report_lockstep(o, compared));
}

/// Every kernel on a path of its own, one after the other: unit 26 exists only once.
exit_status free_run(const run_setup& run) {
  observed_run o(run, nullptr);
  print_heading(run);
  path_record leader;
  leader.end = follow_leader(o, *make_kernel(run.kernels.front()), &leader);
  comparison c;
  for (const std::string& name : std::span(run.kernels).subspan(1)) {
    path_record own;
    certifier judged(run.structure, loads_of(run.what));
    own.end = follow(run.what, run.structure, engine_for(name, run.options, run.structure),
                     *make_kernel(name), {&judged, &own}, limits_of(run));
    const double bound = free_run_bound(facts_of_kernel(run.kernels.front()), facts_of_kernel(name));
    const free_run_difference d = compare_paths(leader, own, bound, run.structure.dofs_per_node);
    if (o.json) o.json->add_free_run(name, d, judged.all_exact());
    report_free_run(o, name, d, judged.all_exact(), c);
  }
  return finish(o, leader.end, c);
}

}  // namespace

exit_status run_command(const run_options& options) {
  const run_setup run = set_up(options, outputs_of(options));
  if (options.final_only) return final_states(run);
  return options.free_run ? free_run(run) : lockstep_run(run);
}

}  // namespace contct::app
