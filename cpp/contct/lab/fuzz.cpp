#include "contct/lab/fuzz.hpp"

#include <algorithm>
#include <chrono>

#include "contct/lab/problem_campaign.hpp"
#include "contct/lab/reproduce.hpp"
#include "contct/outside/registry.hpp"

namespace contct {
namespace {

constexpr std::uint64_t few_ulps = 64;

/// The calls that a divergence needs to be seen again: itself, or with those before it, where a kernel keeps
/// something from call to call.
struct lead {
  bool found = false;
  mismatch_report what;
  call_sequence calls;
};

class fuzzing {
 public:
  fuzzing(const fuzz_request& r, const fuzz_progress& progress)
      : request_(r),
        progress_(progress),
        followers_(r.kernels.begin() + 1, r.kernels.end()),
        near_(followers_.size()),
        leads_(followers_.size()) {
    run_.result.request = r;
    for (const std::string& name : followers_)
      run_.result.followers.push_back({name, {}, equality_level::bits, 0, {}});
  }

  fuzz_run go() {
    const auto started = std::chrono::steady_clock::now();
    hunt_calls();
    hunt_problems();
    for (std::size_t f = 0; f < followers_.size(); ++f) conclude(f);
    run_.result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return std::move(run_);
  }

 private:
  void hunt_calls() {
    call_campaign h(request_.kernels[0], followers_, request_.seed);
    const auto first = static_cast<std::uint64_t>(request_.shard);
    const auto stride = static_cast<std::uint64_t>(request_.shards);
    h.put(first, static_cast<std::uint64_t>(request_.calls), stride, [this](std::uint64_t done) {
      if (progress_) progress_(static_cast<std::int64_t>(done), request_.calls / request_.shards, "calls");
    });
    fuzz_result& r = run_.result;
    r.calls = h.calls();
    r.branches = h.branches();
    r.events = h.events();
    for (std::size_t f = 0; f < followers_.size(); ++f) {
      const campaign_follower& its = h.followers()[f];
      r.followers[f].compared = its.compared;
      near_[f] = its.near;
      if (!its.mismatch_reports.empty()) remember(f, its);
    }
  }

  /// The earliest finding of the hunt on calls, with the calls before it.
  void remember(std::size_t f, const campaign_follower& its) {
    const auto earliest = std::min_element(its.calls.begin(), its.calls.end());
    leads_[f].found = true;
    leads_[f].what = its.mismatch_reports[static_cast<std::size_t>(earliest - its.calls.begin())];
    constexpr std::uint64_t most_before = 40;
    call_source source(request_.seed, facts_of_kernel(request_.kernels[0]).real_bytes);
    const auto stride = static_cast<std::uint64_t>(request_.shards);
    const auto number = *earliest;
    const std::uint64_t before = std::min<std::uint64_t>(most_before, (number - 1) / stride);
    for (std::uint64_t k = before + 1; k-- > 0;) leads_[f].calls.push_back(source.at(number - k * stride));
  }

  void hunt_problems() {
    for (std::int64_t number = request_.shard; number <= request_.problems; number += request_.shards) {
      const problem_in_lockstep p = follow_in_lockstep(request_.seed, static_cast<std::uint64_t>(number),
                                                       request_.kernels[0], followers_);
      take_in(p, number);
      if (progress_)
        progress_(++run_.result.problems, request_.problems / request_.shards, "problems");
      else
        ++run_.result.problems;
    }
  }

  void take_in(const problem_in_lockstep& p, std::int64_t number) {
    fuzz_result& r = run_.result;
    r.calls += p.calls;
    r.branches.add(p.branches);
    r.events.make += p.events.make;
    r.events.break_ += p.events.break_;
    r.events.stationary += p.events.stationary;
    for (std::size_t f = 0; f < followers_.size(); ++f) {
      r.followers[f].compared.values += p.each[f].compared.values;
      r.followers[f].compared.mismatches += p.each[f].compared.mismatches;
      if (!p.each[f].first) continue;
      diverging_problems_.push_back(static_cast<std::uint64_t>(number));
      near_[f].most_ulps = std::max(near_[f].most_ulps, p.each[f].near.most_ulps);
      near_[f].same_events = near_[f].same_events && p.each[f].near.same_events;
      near_[f].always_answered = near_[f].always_answered && p.each[f].near.always_answered;
      if (leads_[f].found) continue;
      leads_[f] = {true, *p.each[f].first, p.each[f].calls_up_to_it};
    }
  }

  /// The highest rung of a follower, and its divergence made small.
  void conclude(std::size_t f) {
    fuzz_follower& its = run_.result.followers[f];
    its.most_ulps = near_[f].most_ulps;
    its.highest = highest_rung(f);
    if (!leads_[f].found) return;
    its.mismatch_reports = words_of(leads_[f].what);
    const std::unique_ptr<kernel> leader = make_kernel(request_.kernels[0]);
    const std::string& field = leads_[f].what.where.field;
    // A kernel that hangs takes its time for every try.
    const int most_tries = field == "answer" ? 60 : 4000;
    if (auto small = shrunk_case(*leader, its.name, leads_[f].calls, field, most_tries)) {
      its.mismatch_reports.push_back("shrunk to " + std::to_string(small->calls.size()) + " call(s), " +
                                     std::to_string(small->calls.back().pairs()) +
                                     " pair(s): " + words_of(small->what)[0]);
      run_.cases.push_back(std::move(*small));
    } else {
      its.mismatch_reports.emplace_back(
          "it could not be seen again by fresh kernels: the kernel is no function of its calls");
    }
  }

  equality_level highest_rung(std::size_t f) {
    if (run_.result.followers[f].compared.mismatches == 0) return equality_level::bits;
    const nearness& n = near_[f];
    if (n.always_answered && n.same_events)
      return n.most_ulps <= few_ulps ? equality_level::ulps : equality_level::events;
    return certified_paths(f) ? equality_level::certificate : equality_level::none;
  }

  /// Are the follower's own paths certified, at least where it diverged?
  bool certified_paths(std::size_t f) {
    constexpr std::uint64_t enough = 20;
    if (request_.problems == 0 || !near_[f].always_answered) return false;
    std::vector<std::uint64_t> asked = diverging_problems_;
    for (std::uint64_t n = 1;
         n <= std::min<std::uint64_t>(enough, static_cast<std::uint64_t>(request_.problems)); ++n)
      asked.push_back(n);
    asked.resize(std::min<std::size_t>(asked.size(), 2 * enough));
    return std::all_of(asked.begin(), asked.end(), [&](std::uint64_t n) {
      return certified_as_leader(request_.seed, n, request_.kernels[0], followers_[f]);
    });
  }

  const fuzz_request& request_;
  const fuzz_progress& progress_;
  std::vector<std::string> followers_;
  std::vector<nearness> near_;
  std::vector<lead> leads_;
  std::vector<std::uint64_t> diverging_problems_;
  fuzz_run run_;
};

}  // namespace

fuzz_run run_fuzz(const fuzz_request& r, const fuzz_progress& progress) {
  return fuzzing(r, progress).go();
}

}  // namespace contct
