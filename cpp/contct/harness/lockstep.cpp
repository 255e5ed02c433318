#include "contct/harness/lockstep.hpp"

#include <algorithm>

#include "contct/kernel/registry.hpp"

namespace contct {
namespace {

std::vector<std::unique_ptr<kernel>> made(const kernel_facts& leader, std::span<const std::string> names) {
  for (const std::string& name : names) refuse_unequal(leader, facts_of_kernel(name));
  std::vector<std::unique_ptr<kernel>> kernels(names.size());
  std::ranges::transform(names, kernels.begin(), make_kernel);
  return kernels;
}

}  // namespace

lockstep::lockstep(const kernel_facts& leader, std::vector<std::unique_ptr<kernel>> followers)
    : kernels_(std::move(followers)) {
  for (const auto& k : kernels_) {
    refuse_unequal(leader, k->facts());
    followers_.emplace_back(leader, *k);
  }
}

lockstep::lockstep(const kernel_facts& leader, std::span<const std::string> followers)
    : lockstep(leader, made(leader, followers)) {}

void lockstep::put(const answered_call& c) {
  ++calls_;
  for (follower& f : followers_) (void)f.ask(c);
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
  return std::ranges::none_of(followers_, [](const follower& f) { return f.last().mismatches > 0; });
}

std::vector<follower_answer> lockstep::last_answers() const {
  std::vector<follower_answer> all;
  for (const follower& f : followers_) all.push_back(f.last());
  return all;
}

}  // namespace contct
