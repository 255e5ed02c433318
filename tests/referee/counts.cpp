#include "referee/counts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <istream>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include "contct/lab/random_problem.hpp"
#include "referee/hard_problems.hpp"

namespace contct::referee {
namespace {

drawn_problem draw_of_laboratory(std::uint64_t seed, std::uint64_t number) {
  constexpr const char* layouts[] = {"gaps",      "zero-gaps", "mixed",         "equal-gaps",
                                     "near-ties", "symmetric", "antisymmetric", "two-sided"};
  lab::random_problem_kind small;
  small.most_elements = 8;
  small.most_lines = 2;
  const lab::random_problem r = lab::make_random_problem(seed, number, small);
  drawn_problem d;
  d.kind = std::string(r.held ? "held:" : "free:") + layouts[static_cast<int>(r.layout)];
  d.problem = r;
  return d;
}

void tell_breach(std::vector<std::string>& all, const std::string& kind, std::string_view what, long found,
                 long allowed, bool is_floor) {
  if (is_floor ? found >= allowed : found <= allowed) return;
  all.push_back(fmt::format("{}: {}: found {}; allowed: at {} {}", kind, what, found,
                            is_floor ? "least" : "most", allowed));
}

std::string row_of(std::string_view name, const kind_counts& k) {
  std::string row = fmt::format("{:<20}{:>9}{:>9}{:>10}{:>10}{:>10}", name, k.problems, k.mechanisms, k.steps,
                                k.certified, k.values);
  for (const long n : k.wrong) row += fmt::format("{:>11}", n);
  return row + "\n";
}

ceiling ceiling_from(const std::string& line, std::string& kind, int number) {
  std::istringstream in(line);
  ceiling c;
  in >> kind >> c.problems >> c.values;
  for (long& n : c.wrong) in >> n;
  std::string rest;
  if (in.fail() || in >> rest)
    throw std::runtime_error(
        fmt::format("ceilings, line {}: found \"{}\"; allowed: a kind, problems, values "
                    "and {} counts",
                    number, line, faults));
  return c;
}

}  // namespace

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

judged_problem judge_all_ways(const drawn_problem& p) {
  const exact_answer exactly(p.problem);
  judged_problem j{p.kind, {}};
  for (int w = 0; w < ways; ++w)
    j.judgements[static_cast<std::size_t>(w)] = judge(p.problem, exactly, static_cast<way>(w));
  return j;
}

judged_problem judge_all_ends(const drawn_problem& p) {
  judged_problem j{p.kind, {}};
  for (int w = 0; w < ways; ++w)
    j.judgements[static_cast<std::size_t>(w)] = judge_end(p.problem, static_cast<way>(w));
  return j;
}

void kind_counts::add(const judgement& j) {
  mechanisms += j.mechanism ? 1 : 0;
  steps += j.steps;
  certified += j.certified;
  values += j.values;
  for (const finding& f : j.findings) ++wrong[static_cast<std::size_t>(f.what)];
}

void referee_counts::add(std::uint64_t number, const judged_problem& p) {
  kind_counts& of_kind = by_kind[p.kind];
  ++of_kind.problems;
  for (std::size_t w = 0; w < ways; ++w) {
    of_kind.add(p.judgements[w]);
    by_way[w].add(p.judgements[w]);
    ++by_way[w].problems;
    for (const finding& f : p.judgements[w].findings) {
      auto& known = worst[static_cast<std::size_t>(f.what)];
      if (!known || f.amount > known->what.amount) known = {number, static_cast<way>(w), f};
    }
  }
}

referee_counts judge_many(std::uint64_t count, std::uint64_t seed, int jobs, const judgement_sink& tell,
                          const std::string& only_kind, std::uint64_t exact_every) {
  constexpr std::uint64_t stretch = 1000;  // of problems whose judgements are kept before they are added
  referee_counts counts;
  std::exception_ptr failure;
  for (std::uint64_t first = 0; first < count; first += stretch) {
    std::vector<judged_problem> judged(std::min(stretch, count - first));
    std::atomic<std::size_t> next = 0;
    std::mutex failing;
    const auto work = [&] {
      try {
        for (std::size_t i = next++; i < judged.size(); i = next++)
          if (const drawn_problem d = draw(seed, first + i); only_kind.empty() || d.kind == only_kind)
            judged[i] = (first + i) / 2 % exact_every == 0 ? judge_all_ways(d) : judge_all_ends(d);
      } catch (...) {
        const std::lock_guard lock(failing);
        failure = std::current_exception();
      }
    };
    {
      std::vector<std::jthread> threads;
      for (int j = 1; j < jobs; ++j) threads.emplace_back(work);
      work();
    }
    if (failure) std::rethrow_exception(failure);
    for (std::size_t i = 0; i < judged.size(); ++i) {
      if (judged[i].kind.empty()) continue;  // not of the kind that was asked for
      counts.add(first + i, judged[i]);
      if (tell) tell(first + i, judged[i]);
    }
  }
  return counts;
}

std::string table_of(const referee_counts& c) {
  std::string text = fmt::format("{:<20}{:>9}{:>9}{:>10}{:>10}{:>10}", "kind", "problems", "mechan.", "steps",
                                 "certified", "values");
  for (int f = 0; f < faults; ++f) text += fmt::format("{:>11}", name_of(static_cast<fault>(f)));
  text += "\n";
  for (const auto& [kind, counts] : c.by_kind) text += row_of(kind, counts);
  for (std::size_t w = 0; w < ways; ++w) text += row_of(name_of(static_cast<way>(w)), c.by_way[w]);
  return text;
}

ceilings read_ceilings(std::istream& file, std::uint64_t count, std::uint64_t seed) {
  ceilings found;
  const std::string wanted = fmt::format("[{} {}]", count, seed);
  bool here = false;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == '[') {
      here = line == wanted;
      continue;
    }
    std::string kind;
    const ceiling c = ceiling_from(line, kind, number);
    if (here) found[kind] = c;
  }
  return found;
}

std::string ceilings_text(const referee_counts& c, std::uint64_t count, std::uint64_t seed) {
  std::string text = fmt::format("[{} {}]\n#{:<19}{:>9}{:>10}", count, seed, "kind", "problems", "values");
  for (int f = 0; f < faults; ++f) text += fmt::format("{:>11}", name_of(static_cast<fault>(f)));
  text += "\n";
  for (const auto& [kind, k] : c.by_kind) {
    text += fmt::format("{:<20}{:>9}{:>10}", kind, k.problems, k.values - k.values / 100);
    for (const long n : k.wrong) text += fmt::format("{:>11}", n == 0 ? 0 : n + std::max(3L, n / 4));
    text += "\n";
  }
  return text;
}

std::vector<std::string> breaches(const referee_counts& c, const ceilings& allowed) {
  std::vector<std::string> all;
  for (const auto& [kind, k] : c.by_kind)
    if (!allowed.contains(kind)) all.push_back(kind + ": found no ceilings for this kind");
  for (const auto& [kind, most] : allowed) {
    const auto found = c.by_kind.find(kind);
    const kind_counts counted = found == c.by_kind.end() ? kind_counts{} : found->second;
    tell_breach(all, kind, "problems", counted.problems, most.problems, true);
    tell_breach(all, kind, "values compared", counted.values, most.values, true);
    for (std::size_t f = 0; f < faults; ++f)
      tell_breach(all, kind, name_of(static_cast<fault>(f)), counted.wrong[f], most.wrong[f], false);
  }
  return all;
}

}  // namespace contct::referee
