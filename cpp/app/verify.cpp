// contct verify: every problem in reference/ against its published, closed-form and recomputed numbers.
#include "contct/lab/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.hpp"
#include "app/outputs.hpp"
#include "app/progress.hpp"
#include "app/streams.hpp"
#include "contct/read/problem_file.hpp"
#include "contct/text/input_text.hpp"
#include "contct/text/joined.hpp"
#include "contct/text/output_file.hpp"
#include "contct/text/terminal.hpp"
#include "contct/write/result_json.hpp"

namespace contct::app {
namespace {

using json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// reference/ as asked for; or what was installed with the program, wherever both have been moved; or that of
/// the tree in which the program was built.
fs::path find_reference(const std::string& asked) {
  if (!asked.empty()) return asked;
  const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
  std::string looked_at;
  for (const char* from_here : {CONTCT_INSTALLED_REFERENCE, "../../reference"}) {
    fs::path found = (here / from_here).lexically_normal();
    if (fs::exists(found / "verification.toml")) return found;
    looked_at += (looked_at.empty() ? "" : " nor ") + (found / "verification.toml").string();
  }
  throw input_error("there is neither " + looked_at + "; name the folder with --reference");
}

/// What the listing gives where the table knows that it misses the value.
bool known_to_miss(const verified_number& n) {
  return n.expected.faithful.has_value();
}

std::string_view mark_of(const verified_number& n) {
  if (!n.passed) return "FAILED";
  if (known_to_miss(n)) return "1989 differs";
  return n.certified ? "certified" : "not certified";
}

json json_of(const verified_number& n) {
  const expected_number& e = n.expected;
  json out = {{"step", e.step},           {"quantity", quantity_words(e)}, {"kind", e.kind},
              {"source", e.source},       {"expected", e.value},           {"computed", n.computed},
              {"corrected", n.corrected}, {"difference", n.difference()},  {"tolerance", e.tolerance},
              {"because", e.because},     {"certified", n.certified},      {"passed", n.passed}};
  if (known_to_miss(n)) {
    out["faithful"] = *e.faithful;
    out["reason"] = e.reason;
  }
  return out;
}

/// step, quantity, expected, computed, relative difference, tolerance, certificate
constexpr std::string_view row = "{:>2} {:<20} {:>13} {:>13} {:>6} {:>6} {}";

/// Collects what came of every case, and prints it as it comes.
class report {
 public:
  report(const terminal& t, bool silent) : terminal_(t), silent_(silent) {}

  void add(const verified_case& c) {
    ++cases_;
    for (const std::string& line : wrap({c.title.empty() ? c.file : c.title}, terminal_.width)) {
      say("{}\n", painted(terminal_, paint::strong, line));
    }
    say("{}: {} of {} calls equal to the bit\n", c.file, c.calls - c.mismatches, c.calls);
    say("{}\n", painted(terminal_, paint::quiet,
                        fmt::format(row, "", "quantity", "expected", "computed", "differ", "allow", "")));
    if (!c.failure.empty()) say("  {}\n", painted(terminal_, paint::bad, "FAILED: " + c.failure));
    std::string said;
    for (const verified_number& n : c.numbers) add(n, said);
    failed_ += c.failure.empty() ? 0 : 1;
    for_machines_.results.push_back(result_of(c));
    json certificates = json::array();
    for (const auto& judged : c.certificates) certificates.push_back(certificate_json(judged));
    json numbers = json::array();
    for (const verified_number& n : c.numbers) numbers.push_back(json_of(n));
    all_.push_back({{"file", c.file},
                    {"title", c.title},
                    {"calls", c.calls},
                    {"mismatches", c.mismatches},
                    {"failure", c.failure},
                    {"certificates", std::move(certificates)},
                    {"checks", std::move(numbers)}});
    say("\n");
  }

  void conclude() const {
    std::vector<std::string> kinds;
    for (const auto& [kind, count] : by_kind_) kinds.push_back(fmt::format("{} {}", count, kind));
    const std::vector<std::string> counts = {
        fmt::format("{} numbers in {} problems", numbers_, cases_), joined(kinds, ", "),
        fmt::format("{} where the 1989 rule differs, as known", known_), fmt::format("{} failed", failed_)};
    for (const std::string& line : wrap(counts, terminal_.width)) {
      say("{}\n", painted(terminal_, failed_ == 0 ? paint::good : paint::bad, line));
    }
    say("The examples of the paper's reference [1] (Mahmoud, Salamon, Pawlak 1986) are not available\n"
        "here; none of their numbers is claimed.\n");
  }

  [[nodiscard]] json document() const {
    return {{"format", "contct-verify-1"},
            {"numbers", numbers_},
            {"failed", failed_},
            {"known_differences", known_},
            {"kinds", by_kind_},
            {"not_claimed", "the examples of the paper's reference [1], which are not available"},
            {"cases", all_}};
  }
  [[nodiscard]] const check_report& for_machines() const { return for_machines_; }
  [[nodiscard]] bool passed() const { return failed_ == 0 && numbers_ > 0; }

 private:
  /// A problem as a test: its numbers, and what is wrong.
  static check_result result_of(const verified_case& c) {
    check_result r{c.file, outcome::passed, "", c.failure.empty() ? "" : c.failure + "\n"};
    for (const verified_number& n : c.numbers) {
      if (n.passed) continue;
      r.details += fmt::format("step {}, {}: expected {:.17g}, computed {:.17g}\n", n.expected.step,
                               quantity_words(n.expected), n.expected.value, n.computed);
    }
    if (!r.details.empty()) r.what = outcome::failed;
    r.summary = fmt::format("{} numbers, {} of {} calls equal to the bit", c.numbers.size(),
                            c.calls - c.mismatches, c.calls);
    return r;
  }

  /// A row; its source and the reason of its tolerance above it, where they are not those of the row before.
  void add(const verified_number& n, std::string& said) {
    const expected_number& e = n.expected;
    ++numbers_;
    ++by_kind_[e.kind];
    known_ += known_to_miss(n) ? 1 : 0;
    failed_ += n.passed ? 0 : 1;
    std::string source =
        fmt::format("{}: {}; tolerance: {}", e.kind, e.source, e.because.empty() ? "exact" : e.because);
    if (source != said) {
      for (const std::string& line : wrap({source}, terminal_.width - 4)) {
        say("    {}\n", painted(terminal_, paint::quiet, line));
      }
      said = std::move(source);
    }
    say(row, e.step, quantity_words(e), words_of(e, e.value), words_of(e, n.computed),
        fmt::format("{:.0e}", std::abs(n.difference())), fmt::format("{:.0e}", e.tolerance),
        painted(terminal_, paint_of(n), mark_of(n)));
    say("\n");
    if (known_to_miss(n)) {
      for (const std::string& line : wrap({e.reason}, terminal_.width - 6)) say("      {}\n", line);
    }
  }

  static paint paint_of(const verified_number& n) {
    return !n.passed ? paint::bad : known_to_miss(n) ? paint::quiet : paint::good;
  }

  static std::string words_of(const expected_number& e, double x) {
    if (e.quantity == "state") return x < 0 ? "contact" : "separated";
    return fmt::format("{:.8g}", x);
  }

  template <class... Arguments>
  void say(fmt::format_string<Arguments...> words, Arguments&&... arguments) const {
    if (!silent_) fmt::print(words, std::forward<Arguments>(arguments)...);
  }

  terminal terminal_;
  bool silent_;
  check_report for_machines_{"contct verify", common_facts(), {}, 0.0};
  int cases_ = 0;
  int numbers_ = 0;
  int failed_ = 0;
  int known_ = 0;
  std::map<std::string, int> by_kind_;
  json all_ = json::array();
};

}  // namespace

exit_status run_command(const verify_options& options) {
  const std::vector<output_option> outputs = with_reports({{"--json", options.json}}, options.report);
  refuse_shared_outputs(outputs);
  const fs::path reference = find_reference(options.reference);
  const std::vector<verification_case> cases = read_verification((reference / "verification.toml").string());
  std::optional<output_file> out;
  if (!options.json.empty()) out.emplace(options.json);
  report_files reports(options.report);
  const bool silent = options.report.quiet || takes_standard_output(outputs);
  report r(look_at_terminal(), silent);
  progress shown(static_cast<long>(cases.size()), "problems", options.report.quiet);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    shown.reached(static_cast<long>(i));
    const verified_case verified =
        verify_case(cases[i], read_problem((reference / "problems" / cases[i].file).string()));
    shown.erase();
    r.add(verified);
  }
  r.conclude();
  flush_standard_output();
  if (out) {
    out->write(r.document().dump(1) + "\n");
    out->finish();
  }
  reports.write(r.for_machines());
  return r.passed() ? exit_status::solved : exit_status::kernels_differ;
}

}  // namespace contct::app
