#include "contct/compare/lockstep.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "contct/compare/explanation.hpp"
#include "contct/outside/registry.hpp"

namespace contct::compare {
namespace {

/// How far the answer is from the leader's.
follower_answer measured(const call<double>& leader, const follower& f, const tally& before) {
  follower_answer m;
  m.values = f.compared.values - before.values;
  m.mismatches = f.compared.mismatches - before.mismatches;
  m.failed = !f.answered();
  if (m.failed || m.mismatches == 0) return m;
  m.smin_ulps = ulps_between(leader.smin, f.answer().smin);
  for (std::size_t i = 0; i < leader.ss.size(); ++i)
    m.ss_ulps = std::max(m.ss_ulps, ulps_between(leader.ss[i], f.answer().ss[i]));
  m.same_events = std::ranges::equal(leader.isep, f.answer().isep);
  return m;
}

}  // namespace

lockstep::lockstep(const kernel_facts& leader, std::vector<std::unique_ptr<kernel>> followers)
    : leader_has_text_(leader.has_text), kernels_(std::move(followers)) {
  for (const auto& k : kernels_) {
    refuse_unequal(leader, k->facts());
    followers_.emplace_back(leader, *k);
  }
}

lockstep make_lockstep(const kernel_facts& leader, std::span<const std::string> followers) {
  for (const std::string& name : followers) refuse_unequal(leader, facts_of_kernel(name));
  std::vector<std::unique_ptr<kernel>> kernels(followers.size());
  std::ranges::transform(followers, kernels.begin(), make_kernel);
  return {leader, std::move(kernels)};
}

void lockstep::called(const answered_call& c) {
  put(calls_ + 1, c.c, c.isep_before, leader_has_text_ ? std::optional(c.text) : std::nullopt);
}

void lockstep::put(std::int64_t number, const call<double>& answered, std::span<const int> isep_before,
                   std::optional<std::string_view> text) {
  ++calls_;
  last_answers_.clear();
  for (follower& f : followers_) {
    const tally before = f.compared;
    (void)f.ask(number, answered, isep_before, text);
    last_answers_.push_back(measured(answered, f, before));
  }
}

tally lockstep::compared() const {
  tally all;
  for (const follower& f : followers_) all += f.compared;
  return all;
}

const std::optional<mismatch_report>& lockstep::first() const {
  static const std::optional<mismatch_report> none;
  const std::optional<mismatch_report>* earliest = &none;
  for (const follower& f : followers_) {
    if (f.first() && (!*earliest || f.first()->call < (*earliest)->call)) earliest = &f.first();
  }
  return *earliest;
}

bool lockstep::last_call_equal() const {
  return std::none_of(last_answers_.begin(), last_answers_.end(),
                      [](const follower_answer& a) { return a.mismatches > 0; });
}

void early_toggles::called(const answered_call& c) {
  distances_.assign(c.isep_before.size(), 0.0);
  for (std::size_t i = 0; i < c.isep_before.size(); ++i) {
    const int dof = c.c.dof.dof_of(c.c.id[i]) - 1;
    const double reached = c.c.dd[dof] + c.c.smin * c.c.dtest[dof];
    if (std::isfinite(reached)) largest_ = std::max(largest_, std::abs(reached));
    if (c.c.isep[i] != c.isep_before[i]) distances_[i] = std::abs(c.c.cc[i] - reached);
  }
}

void early_toggles::incremented(const increment& i) {
  const double rounding = rounding_share(sizeof(double)) * largest_;
  for (const event& e : i.events) {
    const double distance = e.pair < std::ssize(distances_) ? distances_[e.pair] : 0.0;
    if (distance > rounding) all_.push_back({i.step, i.number, e, distance, distance / largest_});
  }
}

}  // namespace contct::compare
