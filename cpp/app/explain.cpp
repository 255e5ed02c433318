// contct explain: explains, for each pair, the branches of the listing in each increment of a run.
#include "contct/write/explain.hpp"

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "app/problem_runs.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/results/run.hpp"
#include "contct/text/input_text.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

/// The whole of `text` as a number from 1; 0 if `text` is not such a number.
int number_from_1(std::string_view text) {
  return std::max(0, number_in<int>(text).value_or(0));
}

/// Combines --step and --increment. "--increment 2.1" means increment 1 of step 2, as in the table of
/// `contct run`.
increments_wanted wanted_of(const explain_options& o) {
  increments_wanted wanted{o.step.value_or(0), 0};
  if (o.increment.empty()) return wanted;
  const std::size_t point = o.increment.find('.');
  const bool both = point != std::string::npos;
  const int step = both ? number_from_1(o.increment.substr(0, point)) : wanted.step;
  wanted.increment = number_from_1(both ? o.increment.substr(point + 1) : o.increment);
  if (wanted.increment == 0 || (both && step == 0))
    throw std::invalid_argument("--increment: found " + o.increment +
                                "; allowed: a whole number from 1, or STEP.INCREMENT, such as 2.1");
  if (both && o.step && *o.step != step)
    throw std::invalid_argument(
        fmt::format("--increment {} is in step {}, but --step is {}; allowed: the same step", o.increment,
                    step, *o.step));
  wanted.step = step;
  return wanted;
}

void refuse_beyond(const char* option, std::optional<int> found, std::size_t most, const char* what) {
  if (!found || (*found > 0 && static_cast<std::size_t>(*found) <= most)) return;
  throw std::invalid_argument(
      most == 0 ? fmt::format("{}: found {}, but the problem has no {}", option, *found, what)
                : fmt::format("{}: found {}; allowed: a {} from 1 to {}", option, *found, what, most));
}

/// Complains of a step or increment that the path does not have. Returns the exit status of `contct explain`
/// if no increment was explained.
exit_status nothing_told(const explain_options& o, const increments_wanted& wanted, const path_end& end,
                         const explained_path& told) {
  if (wanted.step > told.steps())
    complain("--step: found {}; allowed: a step from 1 to {}, where the path ends", wanted.step,
             told.steps());
  else if (wanted.increment > told.most_increments())
    complain("--increment: found {}; allowed: an increment from 1 to {}{}", o.increment,
             told.most_increments(), wanted.step == 0 ? "" : fmt::format(", in step {}", wanted.step));
  return wanted.step > 0 || wanted.increment > 0 ? exit_status::bad_input : status_of(end.status);
}

void print_comparison(const std::vector<std::string>& kernels, const explained_run& run) {
  print_text("\n");
  print_wrapped(look_at_terminal(), run.equal() ? paint::good : paint::bad,
                {fmt::format("{} and {} {} to the bit in the whole run", kernels[0], kernels[1],
                             run.equal() ? "are equal" : "are NOT equal"),
                 counts_of(run.told)});
}

bool is_trace(const std::string& file) {
  std::string line;
  std::ifstream in(file, std::ios::binary);
  return std::getline(in, line) && line.starts_with("contct-trace-1");
}

void print_story(const std::vector<sentence>& story) {
  for (const sentence& t : story) print_text(text_of(look_at_terminal(), t));
}

void print_call(const recorded_call& c, const explained_call& told, int only_pair) {
  print_text(fmt::format("\nCall {}{}\n", c.number, c.note.empty() ? "" : ": " + whole_line(c.note)));
  for (const explained_pair& p : told.pairs) {
    if (only_pair != 0 && only_pair != p.pair + 1) continue;
    print_text("\n" + heading_of(p, fmt::format("node {}", p.node)) + "\n");
    print_story(scale_factor_story(p));
    if (told.winner >= 0) print_story(toggle_story(told, p));
    for (std::optional<decision> d : p.taken) {
      if (!d || d->what == branch::was_separated) continue;  // compares integers, without a margin
      d->pair = -1;
      print_story({{no_line, words_of(*d)}});
    }
  }
  print_text("\nThe smallest s\n");
  print_story(winner_story(told));
  if (told.narrowest)
    print_story({{no_line, "The narrowest decision of this call: " + words_of(*told.narrowest) + "."}});
}

void refuse_for_trace(const explain_options& o, const trace_header& h) {
  if (!o.json.empty() || o.step)
    throw std::invalid_argument(
        o.file +
        ": found a trace with --json or --step; allowed with a trace: --increment for "
        "a call, --pair, --kernels, --quiet");
  if (h.rule != contact_rule::listing)
    throw std::invalid_argument(o.file +
                                ": found a trace of the corrected rule; allowed: a trace of the 1989 rule");
}

/// Explains the calls of a trace, and compares a kernel's answers to the calls with the recorded answers.
exit_status explain_trace(const explain_options& options) {
  const std::string text = read_input(options.file, "trace", 2048);
  trace_reader calls(text, options.file);
  const trace_header h = calls.read_header();
  refuse_for_trace(options, h);
  const std::string& asked = options.kernels.back();
  const std::unique_ptr<kernel> k =
      make_kernel(comparable(h, facts_of_kernel(asked)) ? asked : usual_kernel(h));
  follower other = follower_of(h, *k);
  const int wanted = number_from_1(options.increment);
  double largest = 0.0;
  std::int64_t told = 0;
  (void)replay(calls, other, [&](const recorded_call& c, const answered_call& right) {
    const explained_call explained = explain(right, h.real_bytes, largest);
    if (!options.increment.empty() && c.number != wanted) return;
    ++told;
    if (!options.quiet) print_call(c, explained, options.pair.value_or(0));
    flush_standard_output();
    if (other.difference()) complain_of(words_of(other.report_of(*other.difference(), right)));
  });
  if (told == 0)
    throw std::invalid_argument(fmt::format("--increment: found {}; allowed: the number of a call in {}",
                                            options.increment, options.file));
  if (const std::optional<faulty_line> line = other.faults.found())
    complain("{}: at fault: {}", k->facts().name, words_of(*line));
  if (other.first() && other.near.always_answered)
    for (const std::string& advice : golden_faults(*k)) complain("{}: {}", k->facts().name, advice);
  if (other.first()) return exit_status::kernels_differ;
  if (!options.quiet)
    print_text(fmt::format("\n{} gives the answers of the trace, to the bit\n", k->facts().name));
  return exit_status::solved;
}

}  // namespace

exit_status run_command(const explain_options& options) {
  if (is_trace(options.file)) return explain_trace(options);
  const increments_wanted wanted = wanted_of(options);
  refuse_engine_option(options.engine);
  refuse_other_rules(options.kernels);
  const std::vector<output_option> outputs = {{"--json", options.json}};
  const problem p = read_with_warnings(options, outputs);
  refuse_beyond("--pair", options.pair, p.pairs.size(), "pair");
  refuse_beyond("--step", wanted.step > 0 ? wanted.step : options.step, p.steps.size(), "step");
  const output_files files(outputs);
  const explained_kernels of{p, options.kernels, facts_of_kernel(options.kernels[0]).real_bytes,
                             options.pair.value_or(0)};
  std::optional<explain_text> text;
  std::optional<explain_json> json;
  const bool chosen = options.all || wanted.step > 0 || wanted.increment > 0;
  if (!options.quiet && !takes_standard_output(outputs)) text.emplace(of, look_at_terminal(), chosen);
  if (output_file* const file = files["--json"]) json.emplace(of, *file);
  path_progress shown(p.steps.size(), options.quiet);
  explained_run run(options.kernels, wanted, [&](const auto& i) {
    shown.line.erase();
    if (text) print_text(text->add(i));
    if (json) json->write(i);
  });
  const linear_structure structure = structure_of(p);
  const path_end end = run.follow(p, structure, options.engine, &shown);
  shown.line.erase();
  const explained_path& told = run.told;

  const bool anything = end.status != path_status::not_factored && told.explained() > 0;
  if (anything && text) print_text(text->finish());
  if (anything && text && options.kernels.size() > 1) print_comparison(options.kernels, run);
  if (anything) flush_standard_output();
  if (anything && told.first()) complain_of(words_of(*told.first()));
  for (const std::string& line : words_of_ends(p, end)) complain("{}: {}", whole_line(options.file), line);
  if (!anything) return nothing_told(options, wanted, end, told);
  if (json) json->finish(status_name(end.status, run.equal()), told);
  return status_of(end.status, run.equal());
}

}  // namespace contct
