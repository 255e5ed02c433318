// contct verify: checks every problem in reference/ by its published, closed-form and recomputed numbers.
#include "contct/results/verify.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/problem_runs.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/strings.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/result_json.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string_view mark_of(const verified_number& n) {
  if (!n.passed) return "FAILED";
  if (n.expected.faithful) return "1989 differs";  // the table has the value under the 1989 rule
  return n.certified ? "certified" : "not certified";
}

json json_of(const verified_number& n) {
  const expected_number& e = n.expected;
  json out = {{"step", e.step},           {"quantity", quantity_words(e)}, {"kind", e.kind},
              {"source", e.source},       {"expected", e.value},           {"computed", n.computed},
              {"corrected", n.corrected}, {"difference", n.difference()},  {"tolerance", e.tolerance},
              {"because", e.because},     {"certified", n.certified},      {"passed", n.passed}};
  if (!e.exact.empty()) out["exact"] = e.exact;
  if (!n.apart.empty()) out["apart"] = n.apart;
  if (e.faithful) {
    out["faithful"] = *e.faithful;
    out["reason"] = e.reason;
  }
  return out;
}

json json_of(const verified_case& c) {
  return {{"file", c.file},
          {"title", c.title},
          {"calls", c.calls},
          {"mismatches", c.mismatches},
          {"failure", c.failure},
          {"certificates", list_of(c.steps, certificate_json)},
          {"checks", list_of(c.numbers, [](const verified_number& n) { return json_of(n); })}};
}

struct totals {
  int cases = 0, numbers = 0, failed = 0, known = 0;
  int exact = 0, comparisons = 0;  ///< numbers with a known exact value; comparisons with these values
  std::map<std::string, int> by_kind;

  void add(const verified_case& c) {
    ++cases;
    failed += c.failure.empty() ? 0 : 1;
    for (const verified_number& n : c.numbers) {
      ++numbers;
      ++by_kind[n.expected.kind];
      exact += n.expected.exact.empty() ? 0 : 1;
      comparisons += n.exact_comparisons;
      known += n.expected.faithful ? 1 : 0;
      failed += n.passed ? 0 : 1;
    }
  }
};

/// The result of a problem as a check for the report.
check_result result_of(const verified_case& c) {
  check_result r{c.file, outcome::passed, "", c.failure.empty() ? "" : c.failure + "\n"};
  for (const verified_number& n : c.numbers) {
    if (n.passed) continue;
    r.details += fmt::format("step {}, {}: expected {:.17g}, computed {:.17g}\n", n.expected.step,
                             quantity_words(n.expected), n.expected.value, n.computed);
    if (!n.apart.empty()) r.details += n.apart + "\n";
  }
  if (!r.details.empty()) r.what = outcome::failed;
  r.summary = fmt::format("{} numbers, {} of {} calls equal to the bit", c.numbers.size(),
                          c.calls - c.mismatches, c.calls);
  return r;
}

std::string words_of(const expected_number& e, double x) {
  if (e.quantity == "state") return x < 0 ? "contact" : "separated";
  return fmt::format("{:.8g}", x);
}

/// A row has step, quantity, expected and computed value, relative difference, tolerance and verdict.
constexpr std::string_view row = "{:>4} {:<20} {:>13} {:>13} {:>5} {:>5} {}\n";

/// Like quantity_words, but with "events" instead of "toggles".
std::string quantity_head(const expected_number& e) {
  std::string words = quantity_words(e);
  return words == "toggles" ? "events" : words;
}

/// Prints a row and below it its exact value. The source and the reason for the tolerance follow if they
/// differ from those of the row before.
void print(const terminal& t, const verified_number& n, std::string& printed) {
  const expected_number& e = n.expected;
  const paint p = !n.passed ? paint::bad : e.faithful ? paint::quiet : paint::good;
  print_text(fmt::format(row, e.step, quantity_head(e), words_of(e, e.value), words_of(e, n.computed),
                         fmt::format("{:.0e}", std::abs(n.difference())), fmt::format("{:.0e}", e.tolerance),
                         painted(t, p, mark_of(n))));
  constexpr int below = 9;
  if (!n.apart.empty()) print_wrapped(t, paint::bad, {n.apart}, below);
  if (!e.exact.empty() && e.quantity != "state" && e.exact != fmt::format("{}", e.value))
    print_wrapped(t, paint::quiet, {"exact value " + e.exact}, below);
  std::string source =
      fmt::format("{}: {}; tolerance: {}", e.kind, e.source, e.because.empty() ? "exact" : e.because);
  if (source != printed) print_wrapped(t, paint::quiet, {source}, below);
  printed = std::move(source);
  if (e.faithful) print_wrapped(t, paint::quiet, {e.reason}, below);
}

void print_legend(const terminal& t) {
  print_wrapped(t, paint::quiet,
                {"error: relative difference between computed and expected", "tol: the largest error allowed",
                 "below a row: its exact value, its source, the reason for its tolerance",
                 "a row without a source has the source of the row above"});
  print_text("\n");
}

void print(const terminal& t, const verified_case& c) {
  print_wrapped(t, paint::strong, {c.title.empty() ? c.file : c.title});
  print_text(fmt::format("{}: {} of {} calls equal to the bit\n", c.file, c.calls - c.mismatches, c.calls));
  print_text(painted(t, paint::quiet,
                     fmt::format(row, "step", "quantity", "expected", "computed", "error", "tol", "result")));
  if (!c.failure.empty()) print_text(fmt::format("  {}\n", painted(t, paint::bad, "FAILED: " + c.failure)));
  std::string printed;
  for (const verified_number& n : c.numbers) print(t, n, printed);
  print_text("\n");
}

void print(const terminal& t, const totals& all) {
  print_wrapped(t, paint::quiet,
                {fmt::format("{} exact values, compared {} times with numbers of kernels", all.exact,
                             all.comparisons)});
  std::vector<std::string> kinds;
  for (const auto& [kind, count] : all.by_kind) kinds.push_back(fmt::format("{} {}", count, kind));
  print_wrapped(t, all.failed == 0 ? paint::good : paint::bad,
                {fmt::format("{} numbers in {} problems", all.numbers, all.cases), joined(kinds, ", "),
                 fmt::format("{} known differences of the 1989 rule", all.known),
                 fmt::format("{} failed", all.failed)});
  print_text(fmt::format(
      "The examples of the paper's reference [1] (Mahmoud, Salamon, Pawlak 1986) are not available\n"
      "here, so they were not compared.\n"));
}

/// All input files: the table, its problems, and the files that the problems name.
std::vector<output_option> input_files(const std::string& table, const fs::path& folder,
                                       const std::vector<verification_case>& cases) {
  std::vector<output_option> all = {{"the table of numbers", table}};
  for (const verification_case& c : cases) {
    const std::string file = (folder / c.file).string();
    all.push_back({"a reference problem", file});
    for (const std::string& named : read_problem(file).files) all.push_back({named_by_problem, named});
  }
  return all;
}

}  // namespace

exit_status run_command(const verify_options& options) {
  const fs::path reference = find_reference(options.reference);
  const std::string table = (reference / "verification.toml").string();
  const std::vector<output_option> outputs = with_reports({{"--json", options.json}}, options.report);
  const std::vector<verification_case> cases = read_verification(table);
  const bool writes = std::ranges::any_of(outputs, [](const output_option& o) { return !o.path.empty(); });
  if (writes) refuse_shared_outputs(outputs, input_files(table, reference / "problems", cases));
  const output_files files(outputs);
  const bool silent = options.report.quiet || takes_standard_output(outputs);
  const terminal t = look_at_terminal();
  totals all;
  check_report report{"contct verify", common_facts(), {}, 0.0};
  json judged = json::array();
  progress shown(options.report.quiet);
  const auto count = [&] { shown.reached(all.cases, std::ssize(cases), "problems"); };
  if (!silent) print_legend(t);
  count();
  for (const verification_case& c : cases) {
    const verified_case verified = verify_case(c, read_problem((reference / "problems" / c.file).string()));
    shown.erase();
    if (!silent) print(t, verified);
    all.add(verified);
    report.results.push_back(result_of(verified));
    judged.push_back(json_of(verified));
    count();
  }
  shown.erase();
  if (!silent) print(t, all);
  flush_standard_output();
  const json document = {
      {"format", "contct-verify-1"},
      {"numbers", all.numbers},
      {"failed", all.failed},
      {"known_differences", all.known},
      {"kinds", all.by_kind},
      {"exact", {{"numbers", all.exact}, {"comparisons", all.comparisons}}},
      {"not_claimed", "the examples of the paper's reference [1], which are not available"},
      {"cases", judged}};
  files.write("--json", json_text(document, 1) + "\n");
  files.write(report);
  return all.failed == 0 && all.numbers > 0 ? exit_status::solved : exit_status::kernels_differ;
}

}  // namespace contct
