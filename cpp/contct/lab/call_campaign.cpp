#include "contct/lab/call_campaign.hpp"

#include <algorithm>
#include <cmath>

#include "contct/kernel/contct.hpp"
#include "contct/outside/registry.hpp"

namespace contct::lab {
namespace {

constexpr std::size_t calls_in_a_block = 2048;
constexpr std::uint64_t most_calls_before = 40;  // that a kernel with a memory may need for its mismatch

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

call_campaign::call_campaign(const std::string& leader, const std::vector<std::string>& followers,
                             std::uint64_t seed)
    : results_(followers.size()), source_(seed, facts_of_kernel(leader).real_bytes) {
  for (const std::string& name : followers) refuse_unequal(facts_of_kernel(leader), facts_of_kernel(name));
  leader_ = make_kernel(leader);
  for (const std::string& name : followers) {
    kernels_.push_back(make_kernel(name));
    followers_.emplace_back(leader_->facts(), *kernels_.back());
  }
}

void call_campaign::run(std::uint64_t first, std::uint64_t last, std::uint64_t stride,
                        const std::function<void(std::int64_t)>& progress) {
  stride_ = stride;
  for (std::uint64_t number = first; number <= last; number += stride) {
    put(number);
    if (block_.size() < calls_in_a_block) continue;
    compare_texts();
    if (progress) progress(counts_.calls);
  }
  compare_texts();
}

void call_campaign::put(std::uint64_t number) {
  const call_inputs<double>& in = source_.at(number);
  call<double> answered = leader_outputs_.prepare(in);
  leader_->answer(answered);
  counts_.count(answered, in.isep);
  for (std::size_t f = 0; f < followers_.size(); ++f) {
    if (followers_[f].ask(static_cast<std::int64_t>(number), answered, in.isep, std::nullopt))
      results_[f].note_difference(answered, followers_[f]);
  }
  block_.push_back(number);
}

/// Compare unit 26 of all the calls since the last time.
void call_campaign::compare_texts() {
  const std::string text = leader_->take_text();
  for (follower& f : followers_) {
    const std::string its_text = f.asked().take_text();
    const bool both = leader_->facts().has_text && f.asked().facts().has_text;
    if (!both || block_.empty()) continue;
    tally whole;
    if (compare_text(text, its_text, whole, f.equality()))
      find_text_difference(f);
    else
      f.compared.values += static_cast<std::int64_t>(block_.size());
  }
  block_.clear();
}

/// Put the block once more, and compare the text call by call.
void call_campaign::find_text_difference(follower& f) {
  call_outputs its_outputs;
  for (const std::uint64_t number : block_) {
    const call_inputs<double>& in = source_.at(number);
    call<double> answered = leader_outputs_.prepare(in);
    leader_->answer(answered);
    const std::string text = leader_->take_text();
    call<double> asked = its_outputs.prepare(in);
    try {
      f.asked().answer(asked);
    } catch (const kernel_failure&) {
      continue;  // counted already
    }
    if (const auto found = compare_text(text, f.asked().take_text(), f.compared, f.equality()))
      f.note(static_cast<std::int64_t>(number), *found, answered, in.isep);
  }
}

std::vector<follower_result> call_campaign::results() {
  for (std::size_t f = 0; f < followers_.size(); ++f) {
    follower_result& r = results_[f];
    r.compared = followers_[f].compared;
    r.first = followers_[f].first();
    r.calls.clear();
    if (!r.first) continue;
    const auto number = static_cast<std::uint64_t>(r.first->call);
    const std::uint64_t before = std::min(most_calls_before, (number - 1) / stride_);
    for (std::uint64_t k = before + 1; k-- > 0;) r.calls.push_back(source_.at(number - k * stride_));
  }
  return results_;
}

}  // namespace contct::lab
