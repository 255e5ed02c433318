#include "contct/harness/fuzz.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "contct/harness/random_calls.hpp"
#include "contct/kernel/contct.hpp"
#include "contct/text/strings.hpp"

namespace contct {
namespace {

constexpr std::int64_t calls_between_progress = 2048;
constexpr std::int64_t most_calls_before = 40;  // kept before a mismatch, for kernels that keep data
constexpr std::int64_t problems_certified = 20;

call_inputs inputs_of(const answered_call& c) {
  const auto owned = [](const auto& list) { return std::vector(list.begin(), list.end()); };
  return {owned(c.c.dd),        owned(c.c.dtest), owned(c.c.cc), owned(c.c.id),
          owned(c.isep_before), owned(c.c.isurf), c.c.dof};
}

/// The first mismatch of a follower, and the calls that lead to the mismatch.
struct first_mismatch {
  mismatch_report what;
  call_sequence calls;
};

class fuzzing {
 public:
  fuzzing(const fuzz_request& r, const fuzz_problems* problems, const fuzz_progress& progress,
          const kernel_maker& make)
      : request_(r),
        problems_(problems),
        progress_(progress),
        make_(make),
        leader_(make(r.kernels.at(0))),
        source_(r.seed, leader_->facts().real_bytes) {
    std::vector<std::unique_ptr<kernel>> kernels;
    run_.result.request = r;
    for (const std::string& name : std::span(r.kernels).subspan(1)) kernels.push_back(make(name));
    compared_.emplace(leader_->facts(), std::move(kernels));
    firsts_.resize(followers().size());
  }

  fuzz_run run() {
    const auto started = std::chrono::steady_clock::now();
    put_calls();
    for (std::int64_t number = request_.shard; problems_ != nullptr && number <= request_.problems;
         number += request_.shards)
      follow_problem(number);
    for (const follower& f : followers())
      run_.result.followers.push_back(
          {f.asked().facts().name, f.compared, f.near, equality_level::bits, f.faults.found(), {}});
    // Unit 26 belongs to the process, so all kernels must end before new kernels are made.
    compared_.reset();
    leader_.reset();
    for (std::size_t f = 0; f < firsts_.size(); ++f) conclude(run_.result.followers[f], firsts_[f]);
    run_.result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return std::move(run_);
  }

 private:
  void put_calls() {
    for (std::int64_t number = request_.shard; number <= request_.calls; number += request_.shards) {
      const call_inputs& in = source_.at(number);
      compare(answer_of(*leader_, in).answering(in, number));
      keep_firsts([this](std::int64_t last) {
        call_sequence calls;
        for (std::int64_t k = std::min(most_calls_before, (last - 1) / request_.shards); k >= 0; --k)
          calls.push_back(source_.at(last - k * request_.shards));
        return calls;
      });
      if (progress_ && run_.result.calls % calls_between_progress == 0)
        progress_(run_.result.calls, request_.calls / request_.shards, "calls");
    }
  }

  void follow_problem(std::int64_t number) {
    path_.clear();
    const std::int64_t before = compared_->compared().mismatches;
    problems_->follow(number, *leader_, [this](const answered_call& c) {
      path_.push_back(inputs_of(c));
      compare(c);
    });
    if (compared_->compared().mismatches > before && std::ssize(differing_problems_) < problems_certified)
      differing_problems_.push_back(number);
    keep_firsts([this](std::int64_t last) { return call_sequence(path_.begin(), path_.begin() + last); });
    ++run_.result.problems;
    if (progress_) progress_(run_.result.problems, request_.problems / request_.shards, "problems");
  }

  void compare(const answered_call& c) {
    run_.result.count(c.c, c.isep_before);
    compared_->put(c);
    for (const follower& f : followers()) (void)f.asked().take_text();  // discards text that was not compared
  }

  /// Stores the first mismatch of each follower. `up_to(number)` returns the calls up to call `number`.
  template <class Calls>
  void keep_firsts(Calls up_to) {
    for (std::size_t f = 0; f < firsts_.size(); ++f) {
      const auto& found = followers()[f].first();
      if (found && !firsts_[f]) firsts_[f] = {*found, up_to(found->call)};
    }
  }

  [[nodiscard]] std::vector<follower>& followers() { return compared_->followers(); }

  /// Determines a follower's level of equality, and reduces the calls of its first mismatch.
  void conclude(fuzz_follower& total, const std::optional<first_mismatch>& first) {
    total.highest = level_of(total);
    if (!first) return;
    std::vector<std::string>& lines = total.mismatch_reports;
    lines = words_of(first->what);
    if (total.at_fault) lines.push_back("at fault: " + words_of(*total.at_fault));
    const std::unique_ptr<kernel> leader = make_(request_.kernels[0]);
    const std::string& field = first->what.where.field;
    const int most_tries = field == "answer" ? 60 : 4000;  // a kernel that hangs delays each try
    if (auto small = shrunk_case(
            *leader, [&] { return make_(total.name); }, first->calls, field, most_tries)) {
      lines.push_back("reduced to " + counted(small->calls.size(), "call") + ", " +
                      counted(small->calls.back().in.pairs(), "pair") + ": " + words_of(small->what)[0]);
      run_.cases.push_back(std::move(*small));
    } else {
      lines.emplace_back("not reproducible with fresh kernels: the kernel keeps state between calls");
    }
  }

  equality_level level_of(const fuzz_follower& total) {
    const equality_level level = contct::level_of(total.near, total.compared);
    return level == equality_level::none && certified_paths(total) ? equality_level::certificate : level;
  }

  /// True if, in the first problems and in problems with a mismatch, the follower's own path has the
  /// leader's verdict.
  bool certified_paths(const fuzz_follower& total) {
    if (problems_ == nullptr || request_.problems == 0 || !total.near.always_answered) return false;
    std::vector<std::int64_t> asked = differing_problems_;
    for (std::int64_t n = 1; n <= std::min(problems_certified, request_.problems); ++n) asked.push_back(n);
    return std::ranges::all_of(asked, [&](std::int64_t n) {
      return problems_->has_verdict_of(
          n, [&] { return make_(request_.kernels[0]); }, [&] { return make_(total.name); });
    });
  }

  const fuzz_request& request_;
  const fuzz_problems* problems_;
  const fuzz_progress& progress_;
  const kernel_maker& make_;
  std::unique_ptr<kernel> leader_;
  call_source source_;
  std::optional<lockstep> compared_;
  std::vector<std::optional<first_mismatch>> firsts_;  // [followers]
  call_sequence path_;                                 // the calls of the current problem
  std::vector<std::int64_t> differing_problems_;       // the first problems in which a follower differed
  fuzz_run run_;
};

}  // namespace

void fuzz_result::count(const call<double>& answered, std::span<const int> isep_before) {
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
  std::vector<std::string> missed;
  const auto need = [&](std::string_view what, std::int64_t count) {
    if (count < floor) missed.push_back(std::string(what) + ": " + std::to_string(count));
  };
  need("make", r.events.make);
  need("break", r.events.break_);
  need("stationary", r.events.stationary);
  for (std::size_t b = 0; b < branch_names.size(); ++b)
    for (const bool outcome : {false, true})
      need(std::string(branch_names[b]) + (outcome ? " true" : " false"),
           r.branches.of(static_cast<branch>(b), outcome));
  if (missed.empty()) return "";
  return "too little was compared: found " + joined(missed, ", ") + "; allowed: at least " +
         std::to_string(floor) + " each";
}

fuzz_run run_fuzz(const fuzz_request& r, const fuzz_problems* problems, const fuzz_progress& progress,
                  const kernel_maker& make) {
  return fuzzing(r, problems, progress, make).run();
}

}  // namespace contct
