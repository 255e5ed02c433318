// The exact path as referee of the corrected rule and its certificate:
//     contct_referee COUNT SEED [--jobs N] [--kind KIND] [--exact-every N] [--list] [--examples]
//     contct_referee --only NUMBER SEED
//     contct_referee --file PROBLEM.toml
// Judges random problems, prints the counts of what is wrong by kind and the worst of each, and fails where a
// count is above its ceiling or too little was compared. --list prints everything that is wrong, --examples
// the worst problems as files; --only prints one problem and all that is wrong with it, --file does so for a
// problem file. With --exact-every N only so many are judged by their exact paths, the others by their ends.
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string_view>
#include <thread>

#include "contct/read/problem_file.hpp"
#include "referee/counts.hpp"
#include "referee/problem_text.hpp"

using namespace contct::referee;

namespace {

struct options {
  std::uint64_t count = 0, seed = 0, only = 0, exact_every = 1;
  bool only_one = false, list = false, examples = false;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::string problem_file = {}, kind = {};
};

[[noreturn]] void refuse(std::string_view found) {
  fmt::print(stderr,
             "contct_referee: found {}; allowed: COUNT SEED [--jobs N] [--kind KIND] [--exact-every N] "
             "[--list] [--examples], or --only NUMBER SEED, or --file PROBLEM\n",
             found);
  std::exit(2);
}

std::uint64_t number_in(std::string_view text) {
  std::uint64_t n = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  if (error != std::errc{} || end != text.data() + text.size()) refuse(text);
  return n;
}

options options_of(int argc, char** argv) {
  options o;
  std::vector<std::uint64_t> numbers;
  for (int i = 1; i < argc; ++i) {
    const std::string_view a = argv[i];
    const auto value = [&] { return ++i < argc ? std::string_view(argv[i]) : (refuse(a), a); };
    if (a == "--examples") {
      o.examples = true;
    } else if (a == "--list") {
      o.list = true;
    } else if (a == "--kind") {
      o.kind = value();
    } else if (a == "--file") {
      o.problem_file = value();
    } else if (a == "--jobs") {
      o.jobs = std::max(1, static_cast<int>(number_in(value())));
    } else if (a == "--exact-every") {
      o.exact_every = std::max<std::uint64_t>(1, number_in(value()));
    } else if (a == "--only") {
      o.only_one = true;
      o.only = number_in(value());
    } else {
      numbers.push_back(number_in(a));
    }
  }
  if (!o.problem_file.empty()) return o;
  if (numbers.size() != (o.only_one ? 1U : 2U)) refuse(fmt::format("{} numbers", numbers.size()));
  o.seed = numbers.back();
  if (!o.only_one) o.count = numbers.front();
  if (!o.only_one && o.count == 0) refuse("no problems");
  return o;
}

void print_files(std::uint64_t seed, std::uint64_t number) {
  const problem_text text = text_of(draw(seed, number).problem);
  fmt::print("{}", text.toml);
  if (!text.matrix.empty()) fmt::print("\nK.mtx:\n{}", text.matrix);
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

void print_worst(const options& o, const referee_counts& counts) {
  fmt::print("\nThe worst of each (--only NUMBER SEED shows it):\n");
  for (std::size_t f = 0; f < faults; ++f) {
    const auto& w = counts.worst[f];
    if (!w) continue;
    fmt::print("{:<11}{:>9.2e}  problem {}, {}, {}: {}\n", name_of(w->what.what), w->what.amount, w->number,
               draw(o.seed, w->number).kind, name_of(w->how), w->what.words);
    if (o.examples) print_files(o.seed, w->number);
  }
}

/// Everything that is wrong with a problem, a line each.
void print_findings(std::uint64_t number, const judged_problem& p) {
  for (std::size_t w = 0; w < ways; ++w)
    for (const finding& f : p.judgements[w].findings)
      fmt::print("{} {} {} {} {:.2e}: {}\n", number, p.kind, name_of(static_cast<way>(w)), name_of(f.what),
                 f.amount, f.words);
}

int judge_all(const options& o) {
  std::ifstream file(CONTCT_REFEREE_CEILINGS);
  if (!file) refuse("no file " CONTCT_REFEREE_CEILINGS);
  ceilings allowed = read_ceilings(file, o.count, o.seed);
  if (!o.kind.empty()) std::erase_if(allowed, [&o](const auto& row) { return row.first != o.kind; });
  const auto started = std::chrono::steady_clock::now();
  const referee_counts counts =
      judge_many(o.count, o.seed, o.jobs, o.list ? print_findings : judgement_sink{}, o.kind, o.exact_every);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - started;
  fmt::print("{} problems, seed {}, {:.1f} s\n{}", o.count, o.seed, taken.count(), table_of(counts));
  print_worst(o, counts);
  fmt::print("\n{}\n", ceilings_text(counts, o.count, o.seed));
  if (allowed.empty()) {
    fmt::print("{} has no ceilings for {} problems of seed {}: the block above would be theirs\nFAILED\n",
               CONTCT_REFEREE_CEILINGS, o.count, o.seed);
    return 1;
  }
  const std::vector<std::string> wrong = breaches(counts, allowed);
  for (const std::string& line : wrong) fmt::print("{}\n", line);
  fmt::print("{}\n", wrong.empty() ? "passed" : "FAILED");
  return wrong.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const options o = options_of(argc, argv);
    if (!o.problem_file.empty())
      return judge_one({o.problem_file, contct::read::read_problem(o.problem_file)});
    if (!o.only_one) return judge_all(o);
    print_files(o.seed, o.only);
    return judge_one(draw(o.seed, o.only));
  } catch (const std::exception& e) {
    fmt::print(stderr, "contct_referee: {}\n", e.what());
    return 2;
  }
}
