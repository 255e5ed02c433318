#include "contct/lab/call_campaign.hpp"

#include <algorithm>
#include <cmath>

#include "contct/compare/follower.hpp"
#include "contct/outside/registry.hpp"

namespace contct {
namespace {

constexpr std::size_t calls_in_a_block = 2048;
constexpr std::uint64_t other_stream = 0x9e3779b97f4a7c15;  // so that the two generators do not run in step

}  // namespace

void nearness::take_in(const call<double>& leader, const call_outputs& follower, const mismatch& d) {
  if (d.field == "answer") {
    always_answered = false;
    return;
  }
  most_ulps = std::max(most_ulps, ulps_between(leader.smin, follower.smin));
  for (std::size_t i = 0; i < leader.ss.size(); ++i) {
    most_ulps = std::max(most_ulps, ulps_between(leader.ss[i], follower.ss[i]));
    same_events = same_events && leader.isep[i] == follower.isep[i];
  }
}

void count_toggles(const call<double>& answered, std::span<const int> isep_before, event_counts& counts) {
  constexpr double epsgap = 1e-10;
  for (std::size_t i = 0; i < isep_before.size(); ++i) {
    if (answered.isep[i] == isep_before[i]) continue;
    ++(answered.isep[i] == in_contact ? counts.make : counts.break_);
    const auto dof = static_cast<std::size_t>(answered.dof.dof_of(answered.id[i]) - 1);
    counts.stationary += std::abs(answered.cc[i] - answered.dd[dof]) < epsgap ? 1 : 0;
  }
}

call_source::call_source(std::uint64_t seed, int real_bytes)
    : real_bytes_(real_bytes),
      random_r8_(seed),
      adversarial_r8_(seed ^ other_stream),
      random_r4_(seed),
      adversarial_r4_(seed ^ other_stream) {}

const call_inputs<double>& call_source::at(std::uint64_t number) {
  const bool random = number % 2 == 1;
  if (real_bytes_ == 8) return random ? random_r8_.at(number) : adversarial_r8_.at(number);
  const call_inputs<float>& narrow = random ? random_r4_.at(number) : adversarial_r4_.at(number);
  wide_.dd.resize(narrow.dd.size());
  wide_.dtest.resize(narrow.dtest.size());
  for (std::size_t i = 0; i < narrow.pairs(); ++i) {
    const std::size_t dof = narrow.dof_of_pair(i);
    wide_.dd[dof] = narrow.dd[dof];
    wide_.dtest[dof] = narrow.dtest[dof];
  }
  wide_.cc.assign(narrow.cc.begin(), narrow.cc.end());
  wide_.id = narrow.id;
  wide_.isep = narrow.isep;
  wide_.isurf = narrow.isurf;
  wide_.dof = narrow.dof;
  return wide_;
}

call_campaign::call_campaign(const std::string& leader, const std::vector<std::string>& followers,
                             std::uint64_t seed)
    : source_(seed, facts_of_kernel(leader).real_bytes) {
  for (const std::string& name : followers) refuse_unequal(facts_of_kernel(leader), facts_of_kernel(name));
  leader_ = make_kernel(leader);
  for (const std::string& name : followers) {
    kernels_.push_back(make_kernel(name));
    followers_.push_back({name, {}, {}, {}, {}});
  }
  texts_.resize(followers.size());
}

call_campaign::~call_campaign() = default;

int call_campaign::real_bytes() const {
  return leader_->facts().real_bytes;
}

void call_campaign::put(std::uint64_t first, std::uint64_t last, std::uint64_t stride,
                        const std::function<void(std::uint64_t)>& progress) {
  for (std::uint64_t number = first; number <= last; number += stride) {
    put_one(number);
    if (block_.size() < calls_in_a_block) continue;
    compare_texts();
    if (progress) progress(static_cast<std::uint64_t>(calls_));
  }
  compare_texts();
}

void call_campaign::put_one(std::uint64_t number) {
  const call_inputs<double>& in = source_.at(number);
  call<double> answered = leads_.prepare(in);
  leader_->answer(answered);
  ++calls_;
  branches_.count(answered, in.isep);
  count_toggles(answered, in.isep, events_);
  for (std::size_t f = 0; f < kernels_.size(); ++f) {
    const auto found = put_to(*kernels_[f], answered, in.isep, std::nullopt, text_equality::bytes, follows_,
                              followers_[f].compared);
    if (!found) continue;
    followers_[f].near.take_in(answered, follows_, *found);
    note(f, number, *found, answered, in);
  }
  block_.push_back(number);
}

/// Unit 26 of all the calls since the last time.
void call_campaign::compare_texts() {
  const std::string text = leader_->take_text();
  for (std::size_t f = 0; f < kernels_.size(); ++f) {
    texts_[f] = kernels_[f]->take_text();
    const bool both = leader_->facts().has_text && kernels_[f]->facts().has_text;
    if (!both || block_.empty()) continue;
    tally& t = followers_[f].compared;
    tally whole;
    const text_equality equality = text_equality_of(leader_->facts(), kernels_[f]->facts());
    if (!compare_text(text, texts_[f], whole, equality)) {
      t.values += static_cast<std::int64_t>(block_.size());
    } else {
      find_text_difference(f);
    }
  }
  block_.clear();
}

/// The block once more, call by call.
void call_campaign::find_text_difference(std::size_t follower) {
  tally again;
  for (const std::uint64_t number : block_) {
    const call_inputs<double>& in = source_.at(number);
    call<double> answered = leads_.prepare(in);
    leader_->answer(answered);
    const std::string text = leader_->take_text();
    call_outputs mine;
    call<double> asked = mine.prepare(in);
    std::string its_text;
    try {
      kernels_[follower]->answer(asked);
      its_text = kernels_[follower]->take_text();
    } catch (const kernel_failure&) {
      continue;  // counted already
    }
    const text_equality equality = text_equality_of(leader_->facts(), kernels_[follower]->facts());
    if (const auto found = compare_text(text, its_text, again, equality))
      note(follower, number, *found, answered, in);
  }
  followers_[follower].compared.values += again.values;
  followers_[follower].compared.mismatches += again.mismatches;
}

void call_campaign::note(std::size_t follower, std::uint64_t number, const mismatch& d,
                         const call<double>& answered, const call_inputs<double>& in) {
  campaign_follower& h = followers_[follower];
  for (const mismatch_report& known : h.mismatch_reports) {
    if (known.where.field == d.field) return;
  }
  h.mismatch_reports.push_back({static_cast<std::int64_t>(number), leader_->facts().name, h.name, d,
                                decisions_of(answered, in.isep, leader_->facts().real_bytes)});
  h.calls.push_back(number);
}

}  // namespace contct
