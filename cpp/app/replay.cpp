// contct replay and contct-replay: kernels repeat recorded calls, without LAPACK and finite elements.
#include <filesystem>
#include <map>
#include <stdexcept>

#include "app/kernel_report.hpp"
#include "app/outputs.hpp"
#include "contct/harness/compare.hpp"
#include "contct/kernel/registry.hpp"
#include "contct/number/probe.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/sha256.hpp"

namespace contct {
namespace {

/// The verdict of a replay. Without strict floating point, a mismatch is attributed to the environment.
std::string verdict_of(const tally& compared, const floating_point& fp) {
  if (compared.mismatches != 0) return fp.strict() ? "mismatch" : "environment";
  return "equal";
}

std::string verdict_words(const std::string& verdict, const floating_point& fp) {
  if (verdict != "equal") return verdict;
  const std::string but = fmt::format(", but the environment is not strict ({})", describe(fp));
  return "equal to the bit" + (fp.strict() ? "" : but);
}

/// The results of all traces, for the report about a kernel.
struct replayed {
  kernel_report report = {"replay", "", "", 0, {}, {}, {}};
  nearness near;
  std::map<std::string, fault_finder> faults;  // one for each kernel name

  void add(compared_trace t, const nearness& of) {
    report.calls += t.calls;
    report.compared += t.compared;
    near.most_ulps = std::max(near.most_ulps, of.most_ulps);
    near.same_events = near.same_events && of.same_events;
    if (report.first_mismatch.empty() && t.first)
      report.first_mismatch = {t.name + ": " + words_of(*t.first)[0]};
    report.traces.push_back(std::move(t));
  }
};

check_result replay_one(const std::string& file, const std::string& text, const std::string& name, bool quiet,
                        replayed& all) {
  trace_reader calls(text, file);
  const trace_header h = calls.read_header();
  const std::string kernel = name.empty() ? usual_kernel(h) : name;
  check_result result{file + ": " + kernel, outcome::passed, "", ""};
  const kernel_facts facts = facts_of_kernel(kernel);
  if (!comparable(h, facts)) {
    result.what = outcome::skipped;
    all.report.traces.push_back({file, kernel, "skipped"});
    result.summary =
        fmt::format("skipped: recorded with {}-byte REAL and {}; {} has {}-byte REAL and {}", h.real_bytes,
                    rule_words(h.rule), kernel, facts.real_bytes, rule_words(facts.rule));
    return result;
  }
  const std::unique_ptr<class kernel> k = make_kernel(kernel);
  progress shown(quiet);
  follower f = follower_of(h, *k);
  std::swap(f.faults, all.faults[kernel]);
  std::int64_t done = 0;
  (void)replay(calls, f, [&](const auto&...) { shown.say(file + ": " + counted(++done, "call")); });
  std::swap(f.faults, all.faults[kernel]);
  shown.erase();
  if (done == 0) throw input_error(file + ": found no call; allowed: a trace with one or more");
  const floating_point fp = probe_floating_point();
  result.what = passed_if(f.compared.mismatches == 0);
  const std::string verdict = verdict_of(f.compared, fp);
  all.add({file, kernel, verdict, done, f.compared, f.first(), std::filesystem::path(file).stem().string(),
           sha256(text)},
          f.near);
  result.summary =
      fmt::format("{}; {}, {} compared, {}", verdict_words(verdict, fp), counted(done, "call"),
                  counted(f.compared.values, "value"), counted(f.compared.mismatches, "mismatch"));
  if (!f.first()) return result;
  result.details = joined(words_of(*f.first()), "\n") + "\n";
  if (!fp.strict()) result.details += "the cause is the environment, not the kernel: " + describe(fp) + "\n";
  return result;
}

}  // namespace

exit_status run_command(const replay_options& options) {
  const auto started = std::chrono::steady_clock::now();
  const std::vector<output_option> outputs = with_reports(
      {{"--json", options.json}, {"--report", options.kernel_report}, {"--badge", options.badge}},
      options.report);
  refuse_many_reported(options.kernels.size(), options.kernel_report + options.badge);
  std::vector<output_option> inputs;
  for (const std::string& file : options.traces) inputs.push_back({"a trace", file});
  refuse_shared_outputs(outputs, inputs);
  for (const std::string& name : options.kernels) (void)facts_of_kernel(name);
  const auto kernels = options.kernels.empty() ? std::vector<std::string>(1) : options.kernels;
  const output_files files(outputs);
  const bool silent = options.report.quiet || takes_standard_output(outputs);
  const terminal t = look_at_terminal();
  constexpr paint paints[] = {paint::good, paint::bad, paint::quiet};  // in the order of `outcome`
  replayed all;
  check_report report{"contct replay", common_facts(), {}, 0.0};
  for (const std::string& file : options.traces) {
    const std::string text = read_input(file, "trace", 2048);
    for (const std::string& kernel : kernels) {
      check_result r =
          replay_one(file == "-" ? "standard input" : file, text, kernel, options.report.quiet, all);
      if (!silent)
        print_text(fmt::format("{}: {}\n", whole_line(r.name),
                               painted(t, paints[static_cast<int>(r.what)], r.summary)));
      flush_standard_output();  // the result comes before the messages
      if (!r.details.empty())
        complain("{}: {}", whole_line(r.name), r.details.substr(0, r.details.size() - 1));
      report.results.push_back(std::move(r));
    }
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  std::vector<checked_kernel> checked;
  for (const auto& [kernel, faults] : all.faults) {
    all.report.at_fault = faults.found();
    std::vector<std::string> findings = known_faults(faults);
    if (all.report.at_fault) findings.insert(findings.begin(), "at fault: " + words_of(*all.report.at_fault));
    for (const std::string& finding : findings) complain("{}: {}", kernel, finding);
    checked.push_back({kernel, all.report.at_fault, std::move(findings)});
  }
  if (report.count(outcome::skipped) == static_cast<std::int64_t>(report.results.size()))
    throw std::invalid_argument(
        "nothing was compared: every trace has another precision or rule than the kernel");
  if (!silent)
    print_text(fmt::format("{} passed, {} failed, {} skipped\n", report.count(outcome::passed),
                           report.count(outcome::failed), report.count(outcome::skipped)));
  flush_standard_output();
  all.report.kernel = kernels[0];
  all.report.rung = name_of(level_of(all.near, all.report.compared));
  files.write("--json", replay_json(all.report, checked));
  write_report(files, all.report);
  files.write(report);
  return report.count(outcome::failed) == 0 ? exit_status::solved : exit_status::kernels_differ;
}

}  // namespace contct
