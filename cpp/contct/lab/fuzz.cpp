#include "contct/lab/fuzz.hpp"

#include <algorithm>
#include <chrono>

#include "contct/lab/problem_campaign.hpp"
#include "contct/outside/registry.hpp"

namespace contct::lab {
namespace {

constexpr std::uint64_t few_ulps = 64;

class fuzzing {
 public:
  fuzzing(const fuzz_request& r, const fuzz_progress& progress)
      : request_(r),
        progress_(progress),
        followers_(r.kernels.begin() + 1, r.kernels.end()),
        totals_(followers_.size()) {
    run_.result.request = r;
  }

  fuzz_run run() {
    const auto started = std::chrono::steady_clock::now();
    compare_calls();
    compare_problems();
    for (std::size_t f = 0; f < followers_.size(); ++f) conclude(f);
    run_.result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return std::move(run_);
  }

 private:
  void add(const campaign_counts& counts, const std::vector<follower_result>& each) {
    run_.result.add(counts);
    for (std::size_t f = 0; f < totals_.size(); ++f) totals_[f].add(each[f]);
  }

  void compare_calls() {
    call_campaign campaign(request_.kernels[0], followers_, request_.seed);
    campaign.run(request_.shard, request_.calls, request_.shards, [this](std::int64_t done) {
      if (progress_) progress_(done, request_.calls / request_.shards, "calls");
    });
    add(campaign.counts(), campaign.results());
  }

  void compare_problems() {
    for (std::int64_t number = request_.shard; number <= request_.problems; number += request_.shards) {
      const problem_in_lockstep p =
          follow_in_lockstep(request_.seed, number, request_.kernels[0], followers_);
      add(p, p.each);
      for (const follower_result& its : p.each)
        if (its.first) differing_problems_.push_back(number);
      ++run_.result.problems;
      if (progress_) progress_(run_.result.problems, request_.problems / request_.shards, "problems");
    }
  }

  /// The result of a follower: its level of equality, and its first mismatch made small.
  void conclude(std::size_t f) {
    const follower_result& total = totals_[f];
    run_.result.followers.push_back({followers_[f], total.compared, level_of(f), total.most_ulps, {}});
    if (!total.first) return;
    std::vector<std::string>& lines = run_.result.followers.back().mismatch_reports;
    lines = words_of(*total.first);
    const std::unique_ptr<kernel> leader = make_kernel(request_.kernels[0]);
    const std::string& field = total.first->where.field;
    const int most_tries = field == "answer" ? 60 : 4000;  // a kernel that hangs takes its time for every try
    if (auto small = shrunk_case(*leader, followers_[f], total.calls, field, most_tries)) {
      lines.push_back("shrunk to " + std::to_string(small->calls.size()) + " call(s), " +
                      std::to_string(small->calls.back().pairs()) + " pair(s): " + words_of(small->what)[0]);
      run_.cases.push_back(std::move(*small));
    } else {
      lines.emplace_back(
          "it could not be seen again by fresh kernels: the kernel is no function of its calls");
    }
  }

  equality_level level_of(std::size_t f) {
    const follower_result& total = totals_[f];
    if (total.compared.mismatches == 0) return equality_level::bits;
    if (total.always_answered && total.same_events)
      return total.most_ulps <= few_ulps ? equality_level::ulps : equality_level::events;
    return certified_paths(f) ? equality_level::certificate : equality_level::none;
  }

  /// Are the follower's own paths certified: of the first problems, and of those in which a follower
  /// differed?
  bool certified_paths(std::size_t f) {
    constexpr std::int64_t enough = 20;
    if (request_.problems == 0 || !totals_[f].always_answered) return false;
    std::vector<std::int64_t> asked = differing_problems_;
    for (std::int64_t n = 1; n <= std::min(enough, request_.problems); ++n) asked.push_back(n);
    asked.resize(std::min<std::size_t>(asked.size(), 2 * enough));
    return std::all_of(asked.begin(), asked.end(), [&](std::int64_t n) {
      return certified_as_leader(request_.seed, n, request_.kernels[0], followers_[f]);
    });
  }

  const fuzz_request& request_;
  const fuzz_progress& progress_;
  std::vector<std::string> followers_;
  std::vector<follower_result> totals_;  // [followers]
  std::vector<std::int64_t> differing_problems_;
  fuzz_run run_;
};

}  // namespace

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

fuzz_run run_fuzz(const fuzz_request& r, const fuzz_progress& progress) {
  return fuzzing(r, progress).run();
}

}  // namespace contct::lab
