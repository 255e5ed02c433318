// contct fuzz: compares kernels on random and adversarial calls and on random problems.
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "app/kernel_report.hpp"
#include "app/problem_runs.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/number/probe.hpp"
#include "contct/results/random_problem.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// Reads the shard "I/N" into `r`, unless `text` is empty. Throws std::invalid_argument if `text` is invalid.
void read_shard(const std::string& text, fuzz_request& r) {
  if (text.empty()) return;
  int end = 0;
  if (std::sscanf(text.c_str(), "%d/%d%n", &r.shard, &r.shards, &end) == 2 &&  // NOLINT: checked by %n
      end == static_cast<int>(text.size()) && r.shard >= 1 && r.shard <= r.shards)
    return;
  throw std::invalid_argument("--shard: found " + text + "; allowed: I/N with I from 1 to N, such as 2/8");
}

/// The command that repeats the run.
std::string command_of(const fuzz_request& r) {
  return fmt::format("contct fuzz --kernels {} --calls {} --problems {} --seed {} --shard {}/{}",
                     joined(r.kernels, ","), r.calls, r.problems, r.seed, r.shard, r.shards);
}

fuzz_run fuzzed(const fuzz_request& request, bool quiet) {
  progress shown(quiet);
  const small_problems problems(request.seed);
  return run_fuzz(request, &problems, [&](std::int64_t done, std::int64_t all, const char* what) {
    shown.reached(done, all, what);
  });
}

std::string follower_words(const fuzz_follower& f, const std::string& leader) {
  const floating_point fp = probe_floating_point();
  if (f.compared.mismatches == 0)
    return fmt::format("{} is equal to {} to the bit; {} values compared", f.name, leader, f.compared.values);
  return fmt::format(
      "{} is NOT equal to {}{}; {} of {} values differ; closest equality that holds: {}{}", f.name, leader,
      fp.strict() ? "" : " (the cause is the environment, not the kernel)", f.compared.mismatches,
      f.compared.values, name_of(f.highest),
      f.highest == equality_level::ulps ? fmt::format(" (within {} ULP)", f.near.most_ulps) : "");
}

check_report report_of(const fuzz_result& r, const std::string& missed) {
  check_report report{"contct fuzz", common_facts(), {}, r.seconds};
  report.facts.push_back(command_of(r.request));
  for (const fuzz_follower& f : r.followers) {
    report.results.push_back({f.name + " against " + r.request.kernels[0],
                              passed_if(f.compared.mismatches == 0), follower_words(f, r.request.kernels[0]),
                              joined(f.mismatch_reports, "\n")});
  }
  report.results.push_back(
      {"floors", passed_if(missed.empty()),
       missed.empty() ? fmt::format("{} calls, {} problems", r.calls, r.problems) : missed, missed});
  return report;
}

kernel_report kernel_report_of(const fuzz_result& r) {
  const fuzz_follower& f = r.followers.front();
  return {command_of(r.request), f.name,    std::string(name_of(f.highest)), r.calls, f.compared, {},
          f.mismatch_reports,    f.at_fault};
}

void print_result(const fuzz_result& r) {
  const terminal t = look_at_terminal();
  print_text(fmt::format("{}\n", command_of(r.request)));
  print_wrapped(t, paint::quiet,
                {fmt::format("{} calls, {} problems, {:.1f} s", r.calls, r.problems, r.seconds),
                 fmt::format("events: {} make, {} break, {} of them stationary", r.events.make,
                             r.events.break_, r.events.stationary),
                 fmt::format("each outcome of each IF occurred {} times or more", r.branches.rarest()),
                 "ISEP from -2 to 2, ISURF 1 or -1; contct prove covers every ISEP and ISURF"});
  for (const fuzz_follower& f : r.followers)
    print_wrapped(t, f.compared.mismatches == 0 ? paint::good : paint::bad,
                  {follower_words(f, r.request.kernels[0])});
}

/// A kernel's name for use in a file's name: "plugin-mine-so" for "plugin:./mine.so".
std::string file_name_of(const std::string& kernel) {
  std::string name;
  const std::string library = std::filesystem::path(kernel).filename().string();
  for (const char ch : kernel.rfind("plugin:", 0) == 0 && library != kernel ? "plugin-" + library : kernel) {
    const bool plain = std::isalnum(static_cast<unsigned char>(ch)) != 0;
    if (plain) name += ch;
    if (!plain && !name.empty() && name.back() != '-') name += '-';
  }
  constexpr std::size_t longest = 60;
  return name.substr(0, longest);
}

/// Writes each case as a trace to `folder`, which is created if missing. Returns the names of the files.
std::vector<std::string> write_cases(const std::vector<found_case>& cases, const std::string& folder,
                                     std::uint64_t seed) {
  std::filesystem::create_directories(folder);
  std::vector<std::string> names;
  for (const found_case& c : cases) {
    const std::string stem =
        (std::filesystem::path(folder) / fmt::format("{}-seed{}", file_name_of(c.what.follower), seed))
            .string();
    trace_header header = header_for(facts_of_kernel(c.what.leader), CONTCT_LISTING_SHA256);
    header.about = {"found by contct fuzz, and reduced"};
    write_file(names.emplace_back(stem + ".trace"), trace_of(c, header));
  }
  return names;
}

}  // namespace

exit_status run_command(const fuzz_options& options) {
  fuzz_request request = options.request;
  read_shard(options.shard, request);
  constexpr std::int64_t calls_for_a_problem = 500;
  request.problems = options.problems.value_or(request.calls / calls_for_a_problem);
  if (request.kernels.size() < 2)
    throw std::invalid_argument("--kernels: found one kernel; allowed: two or more; the first one leads");
  for (const std::string& name : request.kernels)
    refuse_unequal(facts_of_kernel(request.kernels[0]), facts_of_kernel(name));
  const std::vector<output_option> outputs = with_reports(
      {{"--json", options.json}, {"--report", options.kernel_report}, {"--badge", options.badge}},
      options.report);
  refuse_many_reported(request.kernels.size() - 1, options.kernel_report + options.badge);
  refuse_shared_outputs(outputs);
  const output_files files(outputs);
  fuzz_run run = fuzzed(request, options.report.quiet);
  const fuzz_result& r = run.result;
  for (fuzz_follower& f : run.result.followers) {
    if (f.compared.mismatches == 0 || !f.near.always_answered) continue;
    const std::vector<std::string> advice = golden_faults(*make_kernel(f.name));
    f.mismatch_reports.insert(f.mismatch_reports.end(), advice.begin(), advice.end());
  }
  const std::string missed = floors_missed(r);
  if (!options.report.quiet && !takes_standard_output(outputs)) print_result(r);
  flush_standard_output();
  for (const fuzz_follower& f : r.followers) complain_of(f.mismatch_reports);
  if (!missed.empty()) complain("{}", missed);
  if (!options.out.empty())
    for (const std::string& name : write_cases(run.cases, options.out, request.seed))
      complain("written: {}", name);
  files.write("--json", fuzz_json(r));
  write_report(files, kernel_report_of(r));
  files.write(report_of(r, missed));
  if (r.compared().mismatches > 0) return exit_status::kernels_differ;
  return missed.empty() ? exit_status::solved : exit_status::bad_input;
}

}  // namespace contct
