#include "contct/lab/fuzz.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "contct/kernel/contct.hpp"
#include "contct/lab/packed.hpp"
#include "contct/lab/random_calls.hpp"
#include "contct/lab/random_problem.hpp"
#include "contct/lab/workers.hpp"
#include "contct/outside/registry.hpp"
#include "contct/path/solve_problem.hpp"

namespace contct::lab {

// What a worker sends of its part; found where it is packed, so in no namespace of this source alone.
template <class Visit>
void pack(Visit& visit, mismatch& m) {
  visit(m.field, m.index, m.leader, m.follower, m.ulps);
}
template <class Visit>
void pack(Visit& visit, mismatch_report& r) {
  visit(r.call, r.leader, r.follower, r.where, r.decisions);
}
template <class Visit>
void pack(Visit& visit, call_inputs<double>& in) {
  visit(in.dd, in.dtest, in.cc, in.id, in.isep, in.isurf, in.dof);
}
template <class Visit>
void pack(Visit& visit, follower_result& r) {
  visit(r.compared, r.most_ulps, r.same_events, r.always_answered, r.first, r.calls);
}
template <class Visit>
void pack(Visit& visit, campaign_result& r) {
  visit(static_cast<campaign_counts&>(r), r.each);
}

namespace {

constexpr std::int64_t calls_in_a_block = 2048;
constexpr std::int64_t most_calls_before = 40;  // that a kernel with a memory may need for its mismatch
constexpr std::uint64_t few_ulps = 64;

/// Problems small enough that thousands of them are quick.
random_problem_kind quick_problems() {
  random_problem_kind kind;
  kind.most_elements = 16;
  kind.most_lines = 4;
  return kind;
}

call_inputs<double> inputs_of(const answered_call& c) {
  const auto owned = [](const auto& list) { return std::vector(list.begin(), list.end()); };
  return {owned(c.c.dd),        owned(c.c.dtest), owned(c.c.cc), owned(c.c.id),
          owned(c.isep_before), owned(c.c.isurf), c.c.dof};
}

/// The first number after `after` that is the shard's.
std::int64_t next_of_shard(const fuzz_request& r, std::int64_t after) {
  return after < r.shard ? r.shard : r.shard + ((after - r.shard) / r.shards + 1) * r.shards;
}

/// A leader and its followers, and what comes of the calls that they are put. Observes a path of the leader.
struct contest : observer {
  std::unique_ptr<kernel> leader;
  std::vector<std::unique_ptr<kernel>> kernels;
  std::vector<follower> followers;
  call_sequence path;  ///< the calls that were observed
  campaign_result result;

  explicit contest(const std::vector<std::string>& names) {
    for (const std::string& name : names) refuse_unequal(facts_of_kernel(names[0]), facts_of_kernel(name));
    leader = make_kernel(names[0]);
    for (const std::string& name : std::span(names).subspan(1)) {
      kernels.push_back(make_kernel(name));
      followers.emplace_back(leader->facts(), *kernels.back());
    }
    result.each.resize(followers.size());
  }

  void called(const answered_call& c) override {
    path.push_back(inputs_of(c));
    const bool has_text = leader->facts().has_text;
    compare(std::ssize(path), c.c, c.isep_before, has_text ? std::optional(c.text) : std::nullopt);
  }

  void compare(std::int64_t number, const call<double>& answered, std::span<const int> isep_before,
               std::optional<std::string_view> text) {
    result.count(answered, isep_before);
    for (std::size_t f = 0; f < followers.size(); ++f) {
      if (followers[f].ask(number, answered, isep_before, text))
        result.each[f].note_difference(answered, followers[f]);
    }
  }

  /// `up_to(number)`: the calls up to that one.
  template <class Calls>
  campaign_result conclude(Calls up_to) {
    for (std::size_t f = 0; f < followers.size(); ++f) {
      follower_result& r = result.each[f];
      r.compared = followers[f].compared;
      r.first = followers[f].first();
      if (r.first) r.calls = up_to(r.first->call);
    }
    return std::move(result);
  }
};

/// Put a block of calls once more, and compare the text call by call.
void find_text_difference(contest& c, follower& f, call_source& source, std::span<const std::int64_t> block) {
  call_outputs outputs;
  call_outputs its_outputs;
  for (const std::int64_t number : block) {
    const call_inputs<double>& in = source.at(number);
    call<double> answered = outputs.prepare(in);
    c.leader->answer(answered);
    const std::string text = c.leader->take_text();
    call<double> asked = its_outputs.prepare(in);
    try {
      f.asked().answer(asked);
    } catch (const kernel_failure&) {
      continue;  // counted already
    }
    if (const auto found = compare_text(text, f.asked().take_text(), f.compared, f.equality()))
      f.note(number, *found, answered, in.isep);
  }
}

/// Compare unit 26 of the calls of `block`, which were put since the last time.
void compare_texts(contest& c, call_source& source, std::span<const std::int64_t> block) {
  const std::string text = c.leader->take_text();
  for (follower& f : c.followers) {
    const std::string its_text = f.asked().take_text();
    const bool both = c.leader->facts().has_text && f.asked().facts().has_text;
    if (!both || block.empty()) continue;
    tally whole;
    if (compare_text(text, its_text, whole, f.equality()))
      find_text_difference(c, f, source, block);
    else
      f.compared.values += std::ssize(block);
  }
}

/// What is one task, and what is put between two checkpoints. Kernels are made anew for each, so that the
/// result depends neither on checkpoints nor on the number of jobs.
constexpr std::int64_t calls_in_a_task = 4 * calls_in_a_block;
constexpr std::int64_t problems_in_a_task = 16;
constexpr std::size_t most_differing_problems = 40;

/// Calls or problems of a task: `after` < number <= `last`, those of the shard.
struct stretch {
  bool of_problems;
  std::int64_t after, last;
};

/// What came of a problem, or of calls: problem 0.
struct part_result {
  std::int64_t problem = 0;
  campaign_result result;

  template <class Visit>
  friend void pack(Visit& visit, part_result& p) {
    visit(p.problem, p.result);
  }
};

std::vector<part_result> parts_of(const fuzz_request& r, const stretch& s) {
  std::vector<part_result> parts;
  if (!s.of_problems) parts.push_back({0, put_calls(r, s.after, s.last)});
  std::int64_t number = s.of_problems ? next_of_shard(r, s.after) : s.last + 1;
  for (; number <= s.last; number += r.shards) parts.push_back({number, follow_in_lockstep(r, number)});
  return parts;
}

class fuzzing {
 public:
  fuzzing(const fuzz_request& r, const fuzz_progress& progress, const fuzz_keeper& keeper, int jobs)
      : request_(r), progress_(progress), keeper_(keeper), jobs_(jobs) {
    now_.result.request = r;
    for (const std::string& name : std::span(r.kernels).subspan(1))
      now_.result.followers.emplace_back().name = name;
    now_.firsts.resize(now_.result.followers.size());
    if (keeper.from) go_on_from(*keeper.from);
  }

  fuzz_run run() {
    started_ = std::chrono::steady_clock::now();
    seconds_before_ = now_.result.seconds;
    do_all();
    for (fuzz_follower& f : now_.result.followers) conclude(f);
    take_time();
    run_.result = std::move(now_.result);
    return std::move(run_);
  }

 private:
  /// The mismatches are found once more: a checkpoint knows only where they are.
  void go_on_from(const fuzz_checkpoint& from) {
    now_ = from;
    for (std::size_t f = 0; f < now_.firsts.size(); ++f) {
      const auto [problem, call] = now_.firsts[f];
      if (call == 0) continue;
      const std::int64_t after = std::max<std::int64_t>(0, call - most_calls_before * request_.shards - 1);
      campaign_result again =
          problem > 0 ? follow_in_lockstep(request_, problem) : put_calls(request_, after, call);
      now_.result.followers[f].first = std::move(again.each[f].first);
      now_.result.followers[f].calls = std::move(again.each[f].calls);
    }
  }

  /// What is left to do, in tasks of `step` numbers; the last of them ends at `most`.
  struct tasks {
    bool of_problems;
    std::int64_t done, most, step;
    [[nodiscard]] std::int64_t count() const { return done < most ? (most - done - 1) / step + 1 : 0; }
    [[nodiscard]] stretch at(std::int64_t task) const {
      const std::int64_t after = done + task * step;
      return {of_problems, after, std::min(most, after + step)};
    }
  };

  void do_all() {
    const tasks calls{false, now_.calls_up_to, request_.calls, calls_in_a_task * request_.shards};
    const tasks problems{true, now_.problems_up_to, request_.problems, problems_in_a_task * request_.shards};
    const auto at = [&](std::int64_t task) {
      return task < calls.count() ? calls.at(task) : problems.at(task - calls.count());
    };
    const auto work = [&](std::int64_t task) { return packed(parts_of(request_, at(task))); };
    do_tasks(jobs_, calls.count() + problems.count(), work,
             [&](std::int64_t task, const std::string& result) { take(at(task), result); });
  }

  void take(const stretch& done, const std::string& result) {
    std::vector<part_result> parts;
    unpack(result, parts);
    for (const part_result& p : parts) add(p.result, p.problem);
    (done.of_problems ? now_.problems_up_to : now_.calls_up_to) = done.last;
    if (done.of_problems) take_problems(parts);
    if (progress_ && done.of_problems)
      progress_(now_.result.problems, request_.problems / request_.shards, "problems");
    if (progress_ && !done.of_problems)
      progress_(now_.result.calls, request_.calls / request_.shards, "calls");
    keep();
  }

  void take_problems(const std::vector<part_result>& parts) {
    now_.result.problems += std::ssize(parts);
    for (const part_result& p : parts)
      for (const follower_result& its : p.result.each)
        if (its.first && now_.differing_problems.size() < most_differing_problems)
          now_.differing_problems.push_back(p.problem);
  }

  /// The result of single calls, or of a problem's.
  void add(const campaign_result& r, std::int64_t problem) {
    now_.result.add(r);
    for (std::size_t f = 0; f < r.each.size(); ++f) {
      if (r.each[f].first && now_.firsts[f].call == 0) now_.firsts[f] = {problem, r.each[f].first->call};
      now_.result.followers[f].add(r.each[f]);
    }
  }

  void take_time() {
    now_.result.seconds =
        seconds_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  }

  void keep() {
    if (!keeper_.keep) return;
    take_time();
    keeper_.keep(now_);
  }

  /// The result of a follower: its level of equality, and its first mismatch made small.
  void conclude(fuzz_follower& total) {
    total.highest = level_of(total);
    std::vector<std::string>& lines = total.mismatch_reports;
    if (!total.first && total.compared.mismatches > 0)
      lines = {"a mismatch before the checkpoint is not seen again: the kernel keeps state between calls"};
    if (!total.first) return;
    lines = words_of(*total.first);
    const std::unique_ptr<kernel> leader = make_kernel(request_.kernels[0]);
    const std::string& field = total.first->where.field;
    const int most_tries = field == "answer" ? 60 : 4000;  // a kernel that hangs takes its time for every try
    if (auto small = shrunk_case(*leader, total.name, total.calls, field, most_tries)) {
      lines.push_back("shrunk to " + std::to_string(small->calls.size()) + " call(s), " +
                      std::to_string(small->calls.back().pairs()) + " pair(s): " + words_of(small->what)[0]);
      run_.cases.push_back(std::move(*small));
    } else {
      lines.emplace_back("not reproducible with fresh kernels: the kernel keeps state between calls");
    }
  }

  equality_level level_of(const fuzz_follower& total) {
    if (total.compared.mismatches == 0) return equality_level::bits;
    if (total.always_answered && total.same_events)
      return total.most_ulps <= few_ulps ? equality_level::ulps : equality_level::events;
    return certified_paths(total) ? equality_level::certificate : equality_level::none;
  }

  /// Are the follower's own paths certified: of the first problems, and of those in which a follower
  /// differed?
  bool certified_paths(const fuzz_follower& total) {
    constexpr std::int64_t enough = 20;
    if (request_.problems == 0 || !total.always_answered) return false;
    std::vector<std::int64_t> asked = now_.differing_problems;
    for (std::int64_t n = 1; n <= std::min(enough, request_.problems); ++n) asked.push_back(n);
    asked.resize(std::min<std::size_t>(asked.size(), 2 * enough));
    return std::all_of(asked.begin(), asked.end(),
                       [&](std::int64_t n) { return certified_as_leader(request_, n, total.name); });
  }

  const fuzz_request& request_;
  const fuzz_progress& progress_;
  const fuzz_keeper& keeper_;
  int jobs_;
  std::chrono::steady_clock::time_point started_;
  double seconds_before_ = 0.0;
  fuzz_checkpoint now_;
  fuzz_run run_;
};

}  // namespace

void campaign_counts::count(const call<double>& answered, std::span<const int> isep_before) {
  ++calls;
  branches.count(answered, isep_before);
  for (std::size_t i = 0; i < isep_before.size(); ++i) {
    if (answered.isep[i] == isep_before[i]) continue;
    ++(answered.isep[i] == in_contact ? events.make : events.break_);
    const int dof = answered.dof.dof_of(answered.id[i]) - 1;
    const double gap = std::abs(answered.cc[i] - answered.dd[dof]);
    events.stationary += gap < constants<double>::epsgap ? 1 : 0;
  }
}

void campaign_counts::add(const campaign_counts& other) {
  calls += other.calls;
  branches.add(other.branches);
  events.make += other.events.make;
  events.break_ += other.events.break_;
  events.stationary += other.events.stationary;
}

void follower_result::note_difference(const call<double>& leader, const follower& f) {
  if (!f.answered()) {
    always_answered = false;
    return;
  }
  const call_outputs& answer = f.answer();
  most_ulps = std::max(most_ulps, ulps_between(leader.smin, answer.smin));
  for (std::size_t i = 0; i < leader.ss.size(); ++i) {
    most_ulps = std::max(most_ulps, ulps_between(leader.ss[i], answer.ss[i]));
    same_events = same_events && leader.isep[i] == answer.isep[i];
  }
}

void follower_result::add(const follower_result& other) {
  compared += other.compared;
  most_ulps = std::max(most_ulps, other.most_ulps);
  same_events = same_events && other.same_events;
  always_answered = always_answered && other.always_answered;
  if (first) return;
  first = other.first;
  calls = other.calls;
}

campaign_result put_calls(const fuzz_request& r) {
  return put_calls(r, 0, r.calls);
}

campaign_result put_calls(const fuzz_request& r, std::int64_t after, std::int64_t last) {
  contest c(r.kernels);
  call_source source(r.seed, c.leader->facts().real_bytes);
  call_outputs outputs;
  std::vector<std::int64_t> block;  // numbers of the calls whose text is not yet compared
  for (std::int64_t number = next_of_shard(r, after); number <= last; number += r.shards) {
    const call_inputs<double>& in = source.at(number);
    call<double> answered = outputs.prepare(in);
    c.leader->answer(answered);
    c.compare(number, answered, in.isep, std::nullopt);
    block.push_back(number);
    if (std::ssize(block) < calls_in_a_block) continue;
    compare_texts(c, source, block);
    block.clear();
  }
  compare_texts(c, source, block);
  return c.conclude([&](std::int64_t up_to) {
    call_sequence calls;
    for (std::int64_t k = std::min(most_calls_before, (up_to - 1) / r.shards); k >= 0; --k)
      calls.push_back(source.at(up_to - k * r.shards));
    return calls;
  });
}

campaign_result follow_in_lockstep(const fuzz_request& r, std::int64_t number) {
  const random_problem p = make_random_problem(r.seed, number, quick_problems());
  const linear_structure s = build(p.geometry, p.supports, p.pairs);
  contest c(r.kernels);
  (void)follow_steps(p.geometry, s, p.steps, "refactor", *c.leader, std::vector<observer*>{&c});
  return c.conclude([&c](std::int64_t last) { return call_sequence(c.path.begin(), c.path.begin() + last); });
}

bool certified_as_leader(const fuzz_request& r, std::int64_t number, const std::string& follower) {
  const random_problem p = make_random_problem(r.seed, number, quick_problems());
  const verdict leads = try_problem(p, *make_kernel(r.kernels[0])).came_to;
  if (leads != verdict::certified && leads != verdict::no_equilibrium) return true;
  try {
    return try_problem(p, *make_kernel(follower)).came_to == leads;
  } catch (const kernel_failure&) {
    return false;
  }
}

std::string_view name_of(equality_level l) {
  constexpr std::string_view names[equality_levels] = {"bits", "ulps", "events", "certificate", "none"};
  return names[static_cast<int>(l)];
}

tally fuzz_result::compared() const {
  tally all;
  for (const fuzz_follower& f : followers) all += f.compared;
  return all;
}

std::string floors_missed(const fuzz_result& r) {
  if (r.calls == 0 || r.compared().values == 0) return "nothing was compared";
  constexpr std::int64_t enough_calls = 1000;
  if (r.calls < enough_calls) return "";
  const std::int64_t floor = std::max<std::int64_t>(1, r.calls / 10'000);
  std::string missed;
  const auto need = [&](std::string_view what, std::int64_t count) {
    if (count >= floor) return;
    missed += missed.empty() ? "" : ", ";
    missed.append(what).append(": ").append(std::to_string(count));
  };
  need("make", r.events.make);
  need("break", r.events.break_);
  need("stationary", r.events.stationary);
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    for (const bool outcome : {false, true}) {
      need(std::string(branch_names[b]) + (outcome ? " true" : " false"),
           r.branches.of(static_cast<branch>(b), outcome));
    }
  }
  if (missed.empty()) return "";
  return "too little was compared: found " + missed + "; allowed: at least " + std::to_string(floor) +
         " each";
}

fuzz_run run_fuzz(const fuzz_request& r, const fuzz_progress& progress, const fuzz_keeper& keeper, int jobs) {
  return fuzzing(r, progress, keeper, jobs).run();
}

}  // namespace contct::lab
