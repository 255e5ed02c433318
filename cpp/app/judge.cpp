// contct verify --results: judges another program's results of the reference problems by the exact numbers.
#include <nlohmann/json.hpp>

#include "app/outputs.hpp"
#include "contct/lab/foreign_results.hpp"

namespace contct {
namespace {

using json = nlohmann::ordered_json;

json json_of(const foreign_case& c) {
  json numbers = json::array();
  for (const foreign_number& n : c.numbers)
    numbers.push_back({{"step", n.expected.step},
                       {"quantity", quantity_words(n.expected)},
                       {"exact", n.expected.exact},
                       {"given", n.given},
                       {"error", n.error},
                       {"passed", n.passed}});
  return {{"problem", c.name}, {"numbers", std::move(numbers)}, {"not_given", c.not_given}};
}

json json_of(const foreign_results& r) {
  json cases = json::array();
  for (const foreign_case& c : r.cases) cases.push_back(json_of(c));
  return {{"format", "contct-judged-1"},  {"program", r.program},    {"version", r.version},
          {"tolerance", r.tolerance},     {"judged", r.judged},      {"failed", r.failed},
          {"problems", std::move(cases)}, {"not_given", r.not_given}};
}

void print(const terminal& t, const foreign_results& r) {
  constexpr std::string_view row = "{:<44} {:>7} {:>6} {:>9} {:>10}\n";
  print_text(
      painted(t, paint::quiet, fmt::format(row, "problem", "numbers", "failed", "not given", "error")));
  for (const foreign_case& c : r.cases) {
    print_text(painted(t, c.failures.empty() ? paint::good : paint::bad,
                       fmt::format(row, c.name, c.numbers.size(), c.failures.size(), c.not_given.size(),
                                   fmt::format("{:.1e}", c.largest_error))));
    for (const std::string& line : c.failures) print_wrapped(t, paint::bad, {"  " + line});
  }
  if (!r.not_given.empty()) print_wrapped(t, paint::quiet, {"not given: " + joined(r.not_given, ", ")});
  print_wrapped(
      t, r.failed == 0 ? paint::good : paint::bad,
      {fmt::format("{} {}: {} numbers in {} problems", r.program, r.version, r.judged, r.cases.size()),
       fmt::format("tolerance {:g}", r.tolerance), fmt::format("{} failed", r.failed)});
}

check_report report_of(const foreign_results& r, const std::string& missed) {
  check_report report{"contct verify --results", {r.program + " " + r.version}, {}, 0.0};
  for (const foreign_case& c : r.cases)
    report.results.push_back({c.name, passed_if(c.failures.empty()),
                              fmt::format("{} numbers, {} not given", c.numbers.size(), c.not_given.size()),
                              joined(c.failures, "\n")});
  report.results.push_back({"floor", passed_if(missed.empty()), fmt::format("{} numbers", r.judged), missed});
  return report;
}

}  // namespace

exit_status judge_foreign(const verify_options& options, const std::string& table) {
  const std::vector<output_option> outputs = with_reports({{"--json", options.json}}, options.report);
  refuse_shared_outputs(outputs, {{"the table of numbers", table}, {"the results", options.results}});
  const output_files files(outputs);
  const foreign_results r = judge_results(options.results, read_verification(table));
  const std::string missed =
      r.judged >= options.least
          ? ""
          : fmt::format("found {} numbers; allowed: {} or more (--least)", r.judged, options.least);
  if (!options.report.quiet && !takes_standard_output(outputs)) print(look_at_terminal(), r);
  flush_standard_output();
  if (!missed.empty()) complain("{}: {}", options.results, missed);
  files.write("--json", json_text(json_of(r), 1) + "\n");
  files.write(report_of(r, missed));
  if (r.failed > 0) return exit_status::kernels_differ;
  return missed.empty() ? exit_status::solved : exit_status::bad_input;
}

}  // namespace contct
