// contct fuzz: random and adversarial calls and problems, kernels against each other.
#include "contct/lab/fuzz.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/fuzz_cases.hpp"
#include "app/progress.hpp"
#include "app/report_options.hpp"
#include "app/streams.hpp"
#include "contct/lab/fuzz_json.hpp"
#include "contct/numeric/probe.hpp"
#include "contct/text/terminal.hpp"

namespace contct {
namespace {

struct fuzz_options {
  fuzz_request request;
  std::optional<std::int64_t> problems;  // by default one for 500 calls
  std::string shard;
  std::vector<std::string> merge;
  std::string json, out;
  report_options report;
};

/// "I/N" as two numbers; throws std::invalid_argument.
void read_shard(const std::string& text, fuzz_request& r) {
  if (text.empty()) return;
  int end = 0;
  if (std::sscanf(text.c_str(), "%d/%d%n", &r.shard, &r.shards, &end) == 2 &&  // NOLINT: checked by %n
      end == static_cast<int>(text.size()) && r.shard >= 1 && r.shard <= r.shards)
    return;
  throw std::invalid_argument("--shard: found " + text + "; allowed: I/N, I from 1 to N, as in 2/8");
}

/// The line that runs the same again.
std::string command_of(const fuzz_request& r) {
  return fmt::format("contct fuzz --kernels {} --calls {} --problems {} --seed {} --shard {}/{}",
                     fmt::join(r.kernels, ","), r.calls, r.problems, r.seed, r.shard, r.shards);
}

fuzz_run fuzzed(const fuzz_request& request, bool quiet) {
  std::optional<progress> shown;
  const char* shown_what = nullptr;
  return run_fuzz(request, [&](std::int64_t done, std::int64_t all, const char* what) {
    if (shown_what != what) shown.emplace(static_cast<long>(all), what, quiet);
    shown_what = what;
    shown->reached(static_cast<long>(done));
  });
}

std::string follower_words(const fuzz_follower& f, const std::string& leader) {
  const floating_point fp = probe_floating_point();
  if (f.compared.mismatches == 0)
    return fmt::format("{} is equal to {} to the bit; {} values compared", f.name, leader, f.compared.values);
  return fmt::format("{} is NOT equal to {}{}; {} of {} values differ; highest rung that holds: {}{}", f.name,
                     leader, fp.strict() ? "" : " (environment, not kernel)", f.compared.mismatches,
                     f.compared.values, name_of(f.highest),
                     f.highest == equality_level::ulps ? fmt::format(" (within {})", f.most_ulps) : "");
}

check_report report_of(const fuzz_result& r, const std::string& missed) {
  check_report report{"contct fuzz", common_facts(), {}, r.seconds};
  report.facts.push_back(command_of(r.request));
  for (const fuzz_follower& f : r.followers) {
    const bool equal = f.compared.mismatches == 0;
    report.results.push_back(
        {f.name + " against " + r.request.kernels[0], equal ? outcome::passed : outcome::failed,
         follower_words(f, r.request.kernels[0]), fmt::format("{}", fmt::join(f.mismatch_reports, "\n"))});
  }
  report.results.push_back(
      {"floors", missed.empty() ? outcome::passed : outcome::failed,
       missed.empty() ? fmt::format("{} calls, {} problems", r.calls, r.problems) : missed, missed});
  return report;
}

void print_result(const fuzz_result& r) {
  const terminal t = look_at_terminal();
  const auto say = [&t](paint p, const std::vector<std::string>& items) {
    for (const std::string& line : wrap(items, t.width)) fmt::print("{}\n", painted(t, p, line));
  };
  fmt::print("{}\n", command_of(r.request));
  say(paint::quiet, {fmt::format("{} calls, {} problems, {:.1f} s", r.calls, r.problems, r.seconds),
                     fmt::format("events: {} make, {} break, {} of them stationary", r.events.make,
                                 r.events.break_, r.events.stationary),
                     fmt::format("the rarest outcome of an IF came {} times", r.branches.rarest())});
  for (const fuzz_follower& f : r.followers)
    say(f.compared.mismatches == 0 ? paint::good : paint::bad, {follower_words(f, r.request.kernels[0])});
}

exit_status run_fuzz_command(fuzz_options options) {
  fuzz_request& request = options.request;
  read_shard(options.shard, request);
  constexpr std::int64_t calls_for_a_problem = 500;
  request.problems = options.problems.value_or(request.calls / calls_for_a_problem);
  if (request.kernels.size() < 2)
    throw std::invalid_argument("--kernels: found one kernel; allowed: two or more, the first one leads");
  const std::vector<output_option> outputs = with_reports({{"--json", options.json}}, options.report);
  std::vector<output_option> inputs;
  for (const std::string& file : options.merge) inputs.push_back({"a shard", file});
  refuse_shared_outputs(outputs, inputs);
  const std::unique_ptr<output_file> json = open_output(outputs[0]);
  report_files reports(options.report);

  const bool merging = !options.merge.empty();
  const fuzz_run run =
      merging ? fuzz_run{merged_fuzz(options.merge), {}} : fuzzed(request, options.report.quiet);
  const fuzz_result& r = run.result;
  const std::string missed = floors_missed(r);
  if (!options.report.quiet && !takes_standard_output(outputs)) print_result(r);
  flush_standard_output();
  for (const fuzz_follower& f : r.followers)
    for (const std::string& line : f.mismatch_reports) complain("{}", line);
  if (!missed.empty()) complain("{}", missed);
  if (!options.out.empty())
    for (const std::string& name : write_cases(run.cases, options.out, request.seed))
      complain("written: {}", name);
  if (json) {
    json->write(fuzz_json(r));
    json->finish();
  }
  reports.write(report_of(r, missed));
  if (r.compared().mismatches > 0) return exit_status::kernels_differ;
  return missed.empty() ? exit_status::solved : exit_status::bad_input;
}

}  // namespace

void add_fuzz(CLI::App& program, exit_status& status) {
  auto options = std::make_shared<fuzz_options>();
  CLI::App* const command = program.add_subcommand(
      "fuzz", "Random and adversarial calls and problems, kernels against each other, to the bit");
  constexpr std::int64_t most = 1'000'000'000'000;
  command->add_option("--kernels", options->request.kernels, "Kernels to compare, the first one leads")
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--calls", options->request.calls, "Calls, of all shards together")
      ->check(CLI::Range(std::int64_t{1}, most))
      ->capture_default_str();
  command->add_option("--problems", options->problems, "Whole problems; by default one for 500 calls")
      ->check(CLI::Range(std::int64_t{0}, most));
  command->add_option("--seed", options->request.seed, "Another seed, other calls")->capture_default_str();
  command->add_option("--shard", options->shard, "Only calls and problems I, I + N, ...")->type_name("I/N");
  command->add_option("--merge", options->merge, "Add up the --json files of all shards instead of running");
  command->add_option("--json", options->json, "Write the result to this file (- is standard output)");
  command->add_option("--out", options->out,
                      "Write what is found to this folder: trace, Catch2 test, FORTRAN main");
  add_report_options(*command, options->report);
  command->callback([options, &status] { status = run_fuzz_command(*options); });
}

}  // namespace contct
