#include "contct/compare/lockstep.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "contct/compare/follower.hpp"
#include "contct/outside/registry.hpp"

namespace contct {
namespace {

/// How far the answer is from the leader's.
follower_answer measured(const call<double>& leader, const call_outputs& answer, const tally& before,
                         const tally& after, bool failed) {
  follower_answer m{after.values - before.values, after.mismatches - before.mismatches, 0, 0, failed};
  if (failed) return m;
  m.smin_ulps = ulps_between(leader.smin, answer.smin);
  for (std::size_t i = 0; i < answer.ss.size(); ++i)
    m.ss_ulps = std::max(m.ss_ulps, ulps_between(leader.ss[i], answer.ss[i]));
  return m;
}

}  // namespace

lockstep::lockstep(kernel_facts leader, std::vector<std::unique_ptr<kernel>> followers)
    : leader_(std::move(leader)), followers_(std::move(followers)) {
  for (const auto& f : followers_) refuse_unequal(leader_, f->facts());
}

lockstep make_lockstep(const kernel_facts& leader, std::span<const std::string> followers) {
  for (const std::string& name : followers) refuse_unequal(leader, facts_of_kernel(name));
  std::vector<std::unique_ptr<kernel>> kernels;
  kernels.reserve(followers.size());
  for (const std::string& name : followers) kernels.push_back(make_kernel(name));
  return {leader, std::move(kernels)};
}

void lockstep::called(const answered_call& c) {
  ++calls_;
  last_call_equal_ = true;
  last_answers_.clear();
  for (const auto& f : followers_) ask(*f, c);
}

void lockstep::ask(kernel& follower, const answered_call& c) {
  const auto text = leader_.has_text ? std::optional(c.text) : std::nullopt;
  const tally before = tally_;
  const auto found = put_to(follower, c.c, c.isep_before, text, text_equality_of(leader_, follower.facts()),
                            answered_, tally_);
  last_answers_.push_back(measured(c.c, answered_, before, tally_, found && found->field == "answer"));
  if (!found) return;
  last_call_equal_ = false;
  if (first_) return;
  first_ = mismatch_report{calls_, leader_.name, follower.facts().name, *found,
                           decisions_of(c.c, c.isep_before, leader_.real_bytes)};
}

}  // namespace contct
