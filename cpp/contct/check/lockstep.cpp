#include "contct/check/lockstep.hpp"

#include <stdexcept>
#include <utility>

namespace contct {

namespace {

std::string words(const kernel_facts& k) {
  return "\"" + k.name + "\" (" + std::to_string(k.real_bytes) + "-byte REAL, rule \"" + k.rule + "\")";
}

}  // namespace

void refuse_unequal(const kernel_facts& leader, const kernel_facts& follower) {
  if (follower.real_bytes == leader.real_bytes && follower.rule == leader.rule) return;
  const bool precision = follower.real_bytes != leader.real_bytes;
  throw std::invalid_argument(words(leader) + " and " + words(follower) + " differ in " +
                              (precision ? "precision" : "rule") +
                              " and cannot be equal to the bit; compare them with --free-run");
}

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
  for (const auto& f : followers_) ask(*f, c);
}

void lockstep::ask(kernel& follower, const answered_call& c) {
  ss_.assign(c.c.ss.size(), 0.0);
  isep_.assign(c.isep_before.begin(), c.isep_before.end());
  call<double> copy = c.c;
  copy.ss = ss_;
  copy.isep = isep_;
  copy.smin = 0.0;
  follower.answer(copy);
  note(follower, compare<double>({c.c.smin, c.c.ss, c.c.isep}, {copy.smin, ss_, isep_}, tally_));
  const std::string text = follower.take_text();
  if (leader_.has_text && follower.facts().has_text) note(follower, compare_text(c.text, text, tally_));
}

void lockstep::note(const kernel& follower, const std::optional<divergence>& found) {
  if (!found) return;
  last_call_equal_ = false;
  if (!first_) first_ = first_divergence{calls_, follower.facts().name, *found};
}

}  // namespace contct
