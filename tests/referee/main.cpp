// Judges the corrected rule and its certificate by the exact path:
//     contct_referee COUNT SEED [--jobs N]
//     contct_referee 0 SEED --only NUMBER
//     contct_referee --file PROBLEM.toml
// Judges random problems and prints the number and the worst of each error by kind. Fails on a forbidden
// error, on more errors than are known, or if too little was compared. --only and --file print all errors of
// one problem.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

#include "contct/lab/random_problem.hpp"
#include "contct/read/problem_file.hpp"
#include "referee/hard_problems.hpp"
#include "referee/judge.hpp"

using namespace contct::referee;

namespace {

struct options {
  std::uint64_t count = 300, seed = 2026;
  std::optional<std::uint64_t> only = {};
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string problem_file = {};
};

struct drawn_problem {
  std::string kind;
  contct::problem problem;
};

drawn_problem draw_of_laboratory(std::uint64_t seed, std::uint64_t number) {
  constexpr const char* layouts[] = {"gaps",      "zero-gaps", "mixed",         "equal-gaps",
                                     "near-ties", "symmetric", "antisymmetric", "two-sided"};
  contct::random_problem_kind small;
  small.most_elements = 8;
  small.most_lines = 2;
  const contct::random_problem r = contct::make_random_problem(seed, number, small);
  return {std::string(r.held ? "held:" : "free:") + layouts[static_cast<int>(r.layout)],
          static_cast<const contct::problem&>(r)};
}

/// Returns problem `number` of `seed`: even numbers are small problems of the laboratory, named by their
/// layouts, and odd numbers are the hard kinds in turn.
drawn_problem draw(std::uint64_t seed, std::uint64_t number) {
  drawn_problem d;
  if (number % 2 == 0) {
    d = draw_of_laboratory(seed, number / 2);
  } else {
    const auto kind = static_cast<hard_kind>(number / 2 % hard_kinds);
    d = {std::string(name_of(kind)), make_hard_problem(seed, number / 2 / hard_kinds, kind)};
  }
  d.problem.title = fmt::format("{}, problem {} of seed {}", d.kind, number, seed);
  return d;
}

/// The judgements of one problem, which is run in each way with the corrected rule.
struct judged_problem {
  std::string kind;
  std::array<judgement, ways> judgements;
};

judged_problem judge_all_ways(const drawn_problem& p) {
  const exact_answer exactly(p.problem);
  judged_problem j{p.kind, {}};
  for (int w = 0; w < ways; ++w) j.judgements[w] = judge(p.problem, exactly, static_cast<way>(w));
  return j;
}

/// Counts of one kind of problem, or of all.
struct counts {
  long problems = 0;
  long steps = 0, certified = 0, values = 0;  // sums over all ways to run
  std::array<long, faults> wrong{};           // likewise

  void add(const judged_problem& p) {
    ++problems;
    for (const judgement& j : p.judgements) {
      steps += j.steps;
      certified += j.certified;
      values += j.values;
      for (const finding& f : j.findings) ++wrong[static_cast<std::size_t>(f.what)];
    }
  }

  [[nodiscard]] std::string row(std::string_view name) const {
    std::string text = fmt::format("{:<20}{:>9}{:>10}{:>10}{:>10}", name, problems, steps, certified, values);
    for (const long n : wrong) text += fmt::format("{:>11}", n);
    return text + "\n";
  }
};

/// The worst error of one kind.
struct worst_finding {
  std::uint64_t number;
  way how;
  finding what;
};

struct all_counts {
  counts all;
  std::map<std::string, counts> by_kind;
  std::array<std::optional<worst_finding>, faults> worst;

  void add(std::uint64_t number, const judged_problem& p) {
    all.add(p);
    by_kind[p.kind].add(p);
    for (std::size_t w = 0; w < ways; ++w) {
      for (const finding& f : p.judgements[w].findings) {
        auto& known = worst[static_cast<std::size_t>(f.what)];
        if (!known || f.amount > known->what.amount) known = {number, static_cast<way>(w), f};
      }
    }
  }
};

/// Judges a range of problems on several threads; the results do not depend on the number of threads.
std::vector<judged_problem> judge_stretch(const options& o, std::uint64_t first, std::uint64_t count) {
  std::vector<judged_problem> judged(count);
  std::atomic<std::size_t> next = 0;
  std::mutex failing;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < judged.size(); i = next++)
        judged[i] = judge_all_ways(draw(o.seed, first + i));
    } catch (...) {
      const std::lock_guard lock(failing);
      failure = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int j = 1; j < o.jobs; ++j) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
  return judged;
}

/// The known numbers of errors in a run of `count` problems of `seed`, and the least number of compared
/// values. Events differ where rounding decides. A bound is loose if half a unit in the last digits of a
/// matrix decides whether the structure has a rigid-body motion. `exactly` counts paths that were followed
/// exactly, which is no error. The numbers are those of one LAPACK, since another rounds differently.
struct known_counts {
  std::uint64_t count, seed;
  long values, loose, events, exactly;
};
constexpr std::array known_runs = {known_counts{300, 2026, 36'939, 2, 22, 12},
                                   known_counts{20'000, 2026, 2'551'180, 3, 1187, 349}};

/// Returns the allowed number of an error, or nothing if it is unknown for this run.
std::optional<long> most_allowed(fault what, const known_counts* known) {
  switch (what) {
    case fault::loose:
      return known != nullptr ? std::optional(known->loose) : std::nullopt;
    case fault::other_events:
      return known != nullptr ? std::optional(known->events) : std::nullopt;
    case fault::exactly:
      return known != nullptr ? std::optional(known->exactly) : std::nullopt;
    case fault::false_mechanism:
    case fault::other_end:
      return known != nullptr ? std::optional(0L) : std::nullopt;
    default:
      return 0;
  }
}

/// Returns one line for each limit that is exceeded.
std::vector<std::string> breaches(const options& o, const counts& c) {
  const auto* known = std::ranges::find_if(
      known_runs, [&o](const known_counts& k) { return k.count == o.count && k.seed == o.seed; });
  if (known == known_runs.end()) known = nullptr;
  std::vector<std::string> lines;
  for (int f = 0; f < faults; ++f) {
    const long found = c.wrong[f];
    const auto most = most_allowed(static_cast<fault>(f), known);
    if (most && found > *most)
      lines.push_back(
          fmt::format("{}: found {}; allowed: at most {}", name_of(static_cast<fault>(f)), found, *most));
  }
  const long least = known != nullptr ? known->values : 1;
  if (c.values < least)
    lines.push_back(fmt::format("values compared: found {}; allowed: at least {}", c.values, least));
  return lines;
}

void print_counts(const options& o, const all_counts& c) {
  fmt::print("{:<20}{:>9}{:>10}{:>10}{:>10}", "kind", "problems", "steps", "certified", "values");
  for (int f = 0; f < faults; ++f) fmt::print("{:>11}", name_of(static_cast<fault>(f)));
  fmt::print("\n");
  for (const auto& [kind, of_kind] : c.by_kind) fmt::print("{}", of_kind.row(kind));
  fmt::print("{}\nThe worst of each (0 SEED --only NUMBER shows it):\n", c.all.row("all"));
  for (const auto& w : c.worst)
    if (w)
      fmt::print("{:<11}{:>9.2e}  problem {}, {}, {}: {}\n", name_of(w->what.what), w->what.amount, w->number,
                 draw(o.seed, w->number).kind, name_of(w->how), w->what.words);
}

int judge_all(const options& o) {
  constexpr std::uint64_t stretch = 1000;  // problems whose judgements are in memory together
  const auto started = std::chrono::steady_clock::now();
  all_counts c;
  for (std::uint64_t first = 0; first < o.count; first += stretch) {
    const auto judged = judge_stretch(o, first, std::min(stretch, o.count - first));
    for (std::size_t i = 0; i < judged.size(); ++i) c.add(first + i, judged[i]);
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - started;
  fmt::print("{} problems, seed {}, {:.1f} s\n", o.count, o.seed, taken.count());
  print_counts(o, c);
  const std::vector<std::string> wrong = breaches(o, c.all);
  for (const std::string& line : wrong) fmt::print("{}\n", line);
  fmt::print("{}\n", wrong.empty() ? "passed" : "FAILED");
  return wrong.empty() ? 0 : 1;
}

int judge_one(const drawn_problem& p) {
  const judged_problem j = judge_all_ways(p);
  for (std::size_t w = 0; w < ways; ++w) {
    const judgement& one = j.judgements[w];
    fmt::print("\n{}: {} steps, {} certified, {} values compared\n", name_of(static_cast<way>(w)), one.steps,
               one.certified, one.values);
    for (const finding& f : one.findings) fmt::print("  {} {:.3g}: {}\n", name_of(f.what), f.amount, f.words);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  options o;
  CLI::App program("The exact path as referee of the corrected rule and its certificate.", "contct_referee");
  program.add_option("count", o.count, "How many problems");
  program.add_option("seed", o.seed, "Of the random problems");
  program.add_option("--jobs", o.jobs, "Threads")->check(CLI::PositiveNumber);
  program.add_option("--only", o.only,
                     "Only the problem of this number, from 0, and all that is wrong with it");
  program.add_option("--file", o.problem_file, "The same for a problem file");
  CLI11_PARSE(program, argc, argv);
  try {
    if (!o.problem_file.empty()) return judge_one({o.problem_file, contct::read_problem(o.problem_file)});
    return o.only ? judge_one(draw(o.seed, *o.only)) : judge_all(o);
  } catch (const std::exception& e) {
    fmt::print(stderr, "contct_referee: {}\n", e.what());
    return 2;
  }
}
