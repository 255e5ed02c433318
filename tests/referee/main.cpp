// Judges the corrected rule and its certificate by the exact path:
//     contct_referee COUNT SEED [--jobs N] [--shear] [--hinge] [--bed]
//     contct_referee 0 SEED --only NUMBER      prints all errors of one problem
// Judges random problems and prints the number of each error and where it was first found. Fails on a
// forbidden error, on more errors than are known, or if too little was compared.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <atomic>
#include <climits>
#include <cmath>
#include <exception>
#include <future>
#include <map>
#include <optional>
#include <thread>

#include "contct/results/random_problem.hpp"
#include "referee/judge.hpp"

using namespace contct::referee;

namespace {

/// What all problems have: shear flexibility, of which phi is 10^-7 to 10^6, or hinges, most of them with a
/// stiffness of 10^-6 to 10^7 EI / h. With `bed`: what is proved about the mesh of a beam on beds is judged.
struct family {
  bool shear = false, hinge = false, bed = false;
  bool operator==(const family&) const = default;
  [[nodiscard]] bool named() const { return shear || hinge; }
};

/// True if a support or load acts on theta of this node, where a hinge cannot be.
bool names_theta(const contct::problem& p, int node) {
  const auto is_theta = [node](const auto& at) { return at.node == node && at.dof == 1; };
  return std::ranges::any_of(p.supports, is_theta) ||
         std::ranges::any_of(p.steps,
                             [&](const contct::load& l) { return std::ranges::any_of(l.points, is_theta); });
}

/// Returns problem `number` of `seed`: even numbers are small problems of the laboratory, and odd numbers are
/// the hard kinds in turn. `of`: all are beams with what it names.
contct::problem draw(std::uint64_t seed, std::uint64_t number, family of) {
  if (number % 2 != 0 && !of.named())
    return make_hard_problem(seed, number / 2 / hard_kinds, static_cast<int>(number / 2 % hard_kinds));
  contct::random_problem_kind small;
  small.most_elements = 8;
  small.most_lines = 2;
  if (of.named()) small.plate_share = 0.0;
  contct::random_problem r = contct::make_random_problem(seed, number / 2, small);
  r.title = "problem of the laboratory";
  if (auto* const b = std::get_if<contct::beam>(&r.geometry.kind); of.named() && b != nullptr) {
    for (std::size_t e = 0; e < b->EI.size() && of.shear; ++e) {
      const double phi = std::pow(10.0, static_cast<double>((number * 7 + e % 2) % 14) - 7.0);
      b->GA.push_back(12 * b->EI[e] / phi / b->length_of(e) / b->length_of(e));
    }
    for (int node = 1; node + 1 < b->nodes() && of.hinge; ++node) {
      if ((number + static_cast<std::uint64_t>(node)) % 2 == 0 || names_theta(r, node)) continue;
      const double share =
          std::pow(10.0, static_cast<double>((number * 5 + static_cast<std::uint64_t>(node)) % 14) - 6.0);
      b->hinges.push_back(node);
      b->hinge_stiffness.push_back(number % 11 == 0 ? 0.0 : share * b->EI[node - 1] / b->length_of(node - 1));
    }
  }
  return static_cast<const contct::problem&>(r);
}

/// The judgements of one problem, which is run in each way with the corrected rule.
using judgements = std::array<judgement, ways>;

judgements judge_all_ways(const contct::problem& p) {
  const exact_answer exactly(p);
  judgements all;
  for (int w = 0; w < ways; ++w) all[w] = judge(p, exactly, static_cast<way>(w));
  return all;
}

/// Judges the first `count` problems in several threads; the results do not depend on the number of threads.
std::vector<judgements> judge_all(std::uint64_t count, std::uint64_t seed, int jobs, family of) {
  std::vector<judgements> judged(count);
  std::atomic<std::size_t> next = 0;
  std::vector<std::future<void>> threads;
  for (int j = 0; j < jobs; ++j)
    threads.push_back(std::async(std::launch::async, [&] {
      for (std::size_t i = next++; i < count; i = next++)
        judged[i] = of.bed ? judgements{judge_meshes(seed + i)} : judge_all_ways(draw(seed, i, of));
    }));
  for (std::future<void>& t : threads) t.get();
  return judged;
}

/// The least number of compared values and the known numbers of errors in a run; 0 if not listed. Events
/// differ where rounding decides. A bound is loose if half a unit in the last digits of a matrix decides
/// whether the structure has a rigid-body motion. `exactly` counts paths that were followed exactly, which is
/// no error. The numbers are those of one LAPACK, since another rounds differently.
struct known_run {
  std::uint64_t count, seed;
  long values;
  std::map<fault, long> most;
  family of = {};
};
using enum fault;
const known_run known_runs[] = {
    {300, 2026, 36'939, {{loose, 2}, {other_events, 22}, {exactly, 12}}},
    {20'000, 2026, 2'551'180, {{loose, 3}, {other_events, 1187}, {exactly, 349}}},
    {1000, 2026, 154'716, {{loose, 6}, {other_events, 10}}, {.shear = true}},
    {1000, 2026, 8245, {}, {.bed = true}},
    {1000, 2026, 147'567, {{other_events, 15}, {exactly, 7}}, {.hinge = true}},
};
constexpr long any = LONG_MAX;
const known_run any_other_run = {
    0, 0, 1, {{loose, any}, {other_events, any}, {exactly, any}, {false_mechanism, any}, {other_end, any}}};

int judge_and_count(std::uint64_t count, std::uint64_t seed, int jobs, family of) {
  long steps = 0, certified = 0, values = 0;
  std::map<fault, long> found;
  std::map<fault, std::string> first;
  const std::vector<judgements> judged = judge_all(count, seed, jobs, of);
  for (std::size_t number = 0; number < count; ++number) {
    for (int w = 0; w < ways; ++w) {
      const judgement& j = judged[number][w];
      steps += j.steps;
      certified += j.certified;
      values += j.values;
      for (const finding& f : j.findings)
        if (++found[f.what] == 1)
          first[f.what] = fmt::format("problem {}, {}: {}", number, way_names[w], f.words);
    }
  }
  const auto* known = std::ranges::find_if(
      known_runs, [&](const known_run& k) { return k.count == count && k.seed == seed && k.of == of; });
  if (known == std::end(known_runs)) known = &any_other_run;
  bool passed = values >= known->values;
  fmt::print("{} problems, {} steps, {} certified\n{} values compared; allowed: {} or more\n", count, steps,
             certified, values, known->values);
  for (const auto& [what, times] : found) {
    const auto limit = known->most.find(what);
    const long most = limit == known->most.end() ? 0 : limit->second;
    passed = passed && times <= most;
    fmt::print("{}: {} times; allowed: {}; the first: {}\n", fault_names[static_cast<int>(what)], times, most,
               first[what]);
  }
  fmt::print("{}\n", passed ? "passed" : "FAILED");
  return passed ? 0 : 1;
}

int tell(const std::string& title, const judgements& all) {
  for (std::size_t w = 0; w < ways; ++w) {
    const judgement& j = all[w];
    fmt::print("{}, {}: {} steps, {} certified, {} values compared\n", title, way_names[w], j.steps,
               j.certified, j.values);
    for (const finding& f : j.findings)
      fmt::print("  {}: {}\n", fault_names[static_cast<int>(f.what)], f.words);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t count = 300, seed = 2026;
  std::optional<std::uint64_t> only;
  family of;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  CLI::App program("The exact path as referee of the corrected rule and its certificate.", "contct_referee");
  program.add_option("count", count, "How many problems");
  program.add_option("seed", seed, "Of the random problems");
  program.add_option("--jobs", jobs, "Threads")->check(CLI::PositiveNumber);
  program.add_option("--only", only,
                     "Only the problem of this number, from 0, and all that is wrong with it");
  program.add_flag("--shear", of.shear, "Beams with shear flexibility");
  program.add_flag("--bed", of.bed, "Beams on beds, each with two meshes");
  program.add_flag("--hinge", of.hinge, "Beams with semi-rigid hinges");
  CLI11_PARSE(program, argc, argv);
  try {
    if (!only) return judge_and_count(count, seed, jobs, of);
    const contct::problem p = draw(seed, *only, of);
    return of.bed ? tell("a beam on beds", {judge_meshes(seed + *only)}) : tell(p.title, judge_all_ways(p));
  } catch (const std::exception& e) {
    fmt::print(stderr, "contct_referee: {}\n", e.what());
    return 2;
  }
}
