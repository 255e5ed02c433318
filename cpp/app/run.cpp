// contct run: follows the path of a problem, by both rules or by the named kernels.
#include "contct/results/run.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "app/problem_runs.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/number/probe.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/results/path_states.hpp"
#include "contct/results/rule_1989.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

namespace fs = std::filesystem;

constexpr const char* csv_pairs = "--csv (its pairs)";
constexpr const char* csv_states = "--csv (its states)";
constexpr const char* csv_supports = "--csv (its supports)";
constexpr const char* csv_envelope = "--csv (its envelope)";
constexpr const char* vtu_collection = "--vtu (its collection)";
constexpr const char* vtu_increments = "--vtu (its increments)";

/// The name of `file` with `end` in place of its extension.
std::string beside(const std::string& file, const std::string& end) {
  const fs::path path(file);
  return (path.parent_path() / (path.stem().string() + end)).string();
}

/// A further table's name, for example "out.pairs.csv" for "out.csv" and ".pairs"; empty without a CSV file.
std::string table_beside(const std::string& csv, const std::string& name) {
  if (csv.empty() || csv == "-") return "";
  return beside(csv, name + fs::path(csv).extension().string());
}

/// Adds all files of --vtu. Throws std::invalid_argument if the name does not end in .vtu.
void add_grid_files(const std::string& vtu, std::vector<output_option>& all) {
  if (fs::path(vtu).extension() != ".vtu")
    throw std::invalid_argument(fmt::format("--vtu: found \"{}\"; allowed: a file that ends in .vtu", vtu));
  all.push_back({"--vtu", vtu});
  all.push_back({vtu_collection, beside(vtu, ".pvd")});
  for (std::size_t i = 0; i < most_pictures; ++i)
    all.push_back({vtu_increments, beside(vtu, name_of_state("", i)), true});
}

/// Every file that these options may write. Throws std::invalid_argument if a name is invalid.
std::vector<output_option> outputs_of(const run_options& o) {
  std::vector<output_option> all = {{"--json", o.json},
                                    {"--log", o.log},
                                    {"--trace", o.trace},
                                    {"--html", o.html},
                                    {"--csv", o.csv},
                                    {csv_pairs, table_beside(o.csv, ".pairs")},
                                    {csv_states, table_beside(o.csv, ".states")},
                                    {csv_supports, table_beside(o.csv, ".supports")},
                                    {csv_envelope, o.envelope ? table_beside(o.csv, ".envelope") : ""},
                                    {"--proof", o.proof}};
  if (!o.vtu.empty()) add_grid_files(o.vtu, all);
  return with_reports(std::move(all), o.report);
}

/// For --vtu: throws std::invalid_argument if a structure given by its matrix has no coordinates, and warns
/// of pairs that get no cell.
void check_grid_coordinates(const problem& p) {
  const auto* a = std::get_if<assembled>(&p.geometry.kind);
  if (a == nullptr) return;
  if (!a->places.known())
    throw std::invalid_argument(fmt::format(
        "--vtu: found the matrix {} without coordinates; allowed: coordinates = \"FILE\" in [matrix], "
        "mesh = \"FILE\" in [calculix], or CalculiX's mesh JOB.inp in the folder of its matrix. --csv and "
        "--json need no coordinates",
        a->name));
  const auto lost =
      std::ranges::count_if(p.pairs, [a](const contact_pair& c) { return a->places.dofs[c.node].node < 0; });
  if (lost > 0)
    complain("warning: --vtu: {} of {} pairs {} no cell: the coordinates of their dofs are not known", lost,
             p.pairs.size(), lost == 1 ? "has" : "have");
}

void refuse_bad_options(const run_options& o) {
  if (!o.engine.empty()) refuse_engine_option(o.engine);
  for (const std::string& name : o.kernels) {
    if (std::ranges::count(o.kernels, name) > 1)
      throw std::invalid_argument("--kernels: \"" + name + "\" is named twice");
    (void)facts_of_kernel(name);
  }
}

/// The node of --node, from 0: a number from 1, "x = 4.5", or a dof's label. Throws std::invalid_argument
/// if there is no such node.
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
    allowed +=
        fmt::format(", or x = .. with the coordinate of a node, from {} to {}", b->x.front(), b->x.back());
  }
  throw std::invalid_argument(fmt::format("--node: found {}; allowed: {}", in_quotes(name), allowed));
}

/// Reads the problem, and throws std::invalid_argument if the options do not go with it.
problem problem_of(const run_options& o, const std::vector<output_option>& outputs) {
  refuse_bad_options(o);
  problem p = read_with_warnings(o, outputs);
  if (!o.vtu.empty()) check_grid_coordinates(p);
  if (o.refine) (void)refined(p);  // throws if the structure is given by a matrix
  return p;
}

run_request request_of(const run_options& o, const model& m, const std::string& date) {
  run_request r{.file = o.file,
                .engine = o.engine,
                .free_run = o.free_run,
                .envelope = o.envelope,
                .compare_all = o.compare == "all",
                .appendix = o.appendix};
  if (!o.final_only) r.kernels = o.kernels;
  if (o.kernels.empty() && o.free_run) r.kernels = kernels_of_1989;
  r.both_rules = r.kernels.empty() && !o.final_only;
  r.pictures = !o.vtu.empty();
  r.max_increments = o.max_increments;
  r.date = date;
  if (!o.watched.empty()) r.watched = node_named(m, o.watched);
  return r;
}

/// A run at the terminal. Its members are made in this order: the input is complete before any output file is
/// opened, and files are opened before solving, so that errors of files are reported at once.
struct shown_run {
  const run_options& options;
  std::vector<output_option> outputs = outputs_of(options);
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();
  std::string date = utc_now();
  terminal screen = look_at_terminal();
  bool prints = !options.report.quiet && !takes_standard_output(outputs);  // the heading, table and verdicts
  problem what = problem_of(options, outputs);
  linear_structure structure = structure_of(what);
  contct::run run{what, structure, request_of(options, what.geometry, date)};
  output_files files{outputs};
  bool has_verdict = false;
  std::string differences = {};  // lines about differences of the kernels
};

void print_heading(const shown_run& o) {
  const terminal& t = o.screen;
  for (const std::string& line : wrap({on_one_line(o.what.title)}, t.width))
    if (!line.empty()) print_text(fmt::format("{}\n", painted(t, paint::strong, line)));
  const std::vector<std::string>& kernels = o.run.result.kernels;
  const std::vector<std::string> facts = {
      fmt::format("{}, {}, {}", counted(nodes(o.what.geometry), node_name(o.what.geometry)),
                  counted(o.what.pairs.size(), "pair"), counted(o.what.steps.size(), "step")),
      kernels.empty() ? "final states only" : fmt::format("kernels {}", joined(kernels, ", ")),
      "engine " + o.run.result.engine + (o.structure.stiffness.is_band() ? "" : ", sparse")};
  print_text(joined(wrap(facts, t.width), "\n") + "\n\n");
}

void print_verdict(shown_run& o, paint p, const std::vector<std::string>& items) {
  if (!o.prints) return;
  if (!std::exchange(o.has_verdict, true)) print_text("\n");
  print_wrapped(o.screen, p, items);
}

/// Follows the path and prints a table of its increments, or only of the ends of steps.
void go(shown_run& o) {
  if (o.prints) print_heading(o);
  path_progress progress(o.what.steps.size(), o.options.report.quiet);
  const output_files& f = o.files;
  o.run.go({f["--json"], result_parts::ends, f["--log"], f["--trace"], f["--proof"], f["--html"], f["--csv"],
            f[csv_pairs], f[csv_states], f[csv_supports], f[csv_envelope]},
           {&progress});
  progress.line.erase();
  o.run.find_mesh_errors();
  if (!o.prints) return;
  const run_table rows = table_of(o.run.result, o.screen, o.options.detail);
  print_text(rows.text);
  if (!rows.legend.empty()) print_verdict(o, paint::quiet, rows.legend);
}

/// Prints whether the kernels are equal to the bit. Without strict floating point, the environment is named
/// as the cause of a mismatch.
void report_lockstep(shown_run& o) {
  const lockstep& compared = *o.run.result.compared_calls();
  const std::string names = joined(o.run.result.beside ? kernels_of_1989 : o.run.wanted.kernels, " and ");
  if (compared.calls() == 0)
    return print_verdict(o, paint::quiet, {names + " were never called, so nothing was compared"});
  const bool equal = o.run.result.equal;
  print_verdict(o, equal ? paint::good : paint::bad,
                {fmt::format("{} {} to the bit", names, equal ? "are equal" : "are NOT equal"),
                 o.run.result.comparison});
  if (!compared.first()) return;
  const std::vector<std::string> lines = words_of(*compared.first());
  complain_of(lines);
  o.differences = joined(lines, "\n") + "\n";
  const floating_point fp = probe_floating_point();
  if (!fp.strict()) complain("the cause is the environment, not the kernel: {}", describe(fp));
}

/// Lets another kernel follow its own path, and prints the comparison with the leader's path.
void report_free_run(shown_run& o, const std::string& name) {
  const compared_path& other = o.run.follow_alone(name);
  const free_run_difference& d = other.difference;
  print_verdict(o, d.within_bound() ? paint::good : paint::bad,
                {fmt::format("{} in free run: {} events", name, d.same_events ? "the same" : "DIFFERENT"),
                 other.distances, other.certified ? "certified" : "NOT certified"});
  if (!d.first_difference.empty()) {
    o.differences += name + ": " + d.first_difference + "\n";
    complain("{}: first difference: {}", name, d.first_difference);
  }
  for (const auto& [what, difference] :
       {std::pair("a share of the step", d.fraction), {"D", d.displacement}}) {
    if (difference > d.bound)
      complain("{}: {} differs by {:.2g}; allowed: {:.0e}", name, what, difference, d.bound);
  }
}

void report_comparison(shown_run& o) {
  const std::vector<std::string>& kernels = o.run.wanted.kernels;
  if (kernels.empty())
    return print_verdict(o, paint::quiet,
                         {"only the final state of each step, without a path",
                          counted(o.run.result.end.work.factors, "factorisation")});
  if (o.run.result.compared_calls() != nullptr) report_lockstep(o);
  for (const std::string& line : rule_1989_words(o.run.result)) print_verdict(o, paint::strong, {line});
  if (!o.run.wanted.free_run) return;
  // Kernels run one after the other because they share unit 26.
  for (const std::string& name : std::span(kernels).subspan(1)) report_free_run(o, name);
}

/// Solves again with half the element size, and prints the changes.
void report_refinement(shown_run& o) {
  o.run.refine();
  const std::vector<std::string> items = refinement_words(o.run.result);
  print_verdict(o, paint::quiet,
                items.empty()
                    ? std::vector<std::string>{"the problem with half the element size could not be solved"}
                    : items);
}

check_report check_report_of(const shown_run& o) {
  const run_result& run = o.run.result;
  const std::vector<std::string>& kernels = run.kernels;
  check_report r{"contct run", run.facts, {}, 0.0};
  r.facts.push_back(fmt::format("{}: kernels {}", run.file, joined(kernels, ", ")));
  if (kernels.size() > 1)
    r.results.push_back({"kernels", passed_if(run.equal), run.comparison, o.differences});
  if (run.beside) {
    const std::vector<std::string> lines = rule_1989_words(run);
    const bool is_wrong = std::ranges::any_of(run.beside->differences, &state_difference::is_wrong);
    r.results.push_back({"1989 rule", is_wrong ? outcome::skipped : outcome::passed,
                         lines.empty() ? "not compared" : lines.front(), joined(lines, "\n")});
  }
  const std::string ended = joined(words_of_ends(run.what, run.end), "\n");
  const bool solved = run.end.status == path_status::solved;
  r.results.push_back({"path", passed_if(solved), solved ? "every step's load is applied" : ended, ended});
  if (run.all_certified()) {
    r.results.push_back({"certificate", outcome::passed, "every final state is certified", ""});
  } else {  // fails only with --strict
    r.results.push_back({"certificate", o.options.strict ? outcome::failed : outcome::skipped,
                         "NOT certified", joined(certificate_complaints(run), "\n")});
  }
  r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - o.started).count();
  return r;
}

/// Writes all files of --vtu. The collection (.pvd) is written last, after the files that it names.
void write_grids(const output_files& files, const std::string& vtu, const run_result& r) {
  const std::vector<structure_state> states = pictures_of(r);
  for (std::size_t i = 0; i < states.size(); ++i)
    write_file(beside(vtu, name_of_state("", i)), vtu_of_state(r.what, states[i]));
  files.write("--vtu", vtu_of_state(r.what, states.back()));
  files.write(vtu_collection, pvd_of_states(fs::path(vtu).stem().string(), states.size()));
}

/// Ends a run: prints the certificate, writes the files and prints messages. Returns the exit status.
exit_status finish(shown_run& o) {
  const bool solved = o.run.result.end.status == path_status::solved;
  const bool certified = o.run.result.all_certified();
  print_verdict(o, solved && certified ? paint::good : paint::bad, certificate_summary(o.run.result, solved));
  const exit_status status = o.run.exit();
  if (status != exit_status::bad_input) {  // a run with bad input has no numbers
    write_outputs(o.run);
    if (o.files["--vtu"] != nullptr) write_grids(o.files, o.options.vtu, o.run.result);
    o.files.write(check_report_of(o));
  }
  flush_standard_output();  // the table comes before the messages
  complain_of(end_messages(o.run.result));
  return status == exit_status::solved && o.options.strict && !certified ? exit_status::uncertified : status;
}

}  // namespace

exit_status run_command(const run_options& options) {
  shown_run o{options};
  go(o);
  report_comparison(o);
  if (options.refine) report_refinement(o);
  return finish(o);
}

}  // namespace contct
