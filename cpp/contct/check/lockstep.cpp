#include "contct/check/lockstep.hpp"

#include <stdexcept>
#include <utility>

#include "contct/conform/follower.hpp"

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
  const auto text = leader_.has_text ? std::optional(c.text) : std::nullopt;
  const auto found = put_to(follower, c.c, c.isep_before, text, text_equality_of(leader_, follower.facts()),
                            answered_, tally_);
  if (!found) return;
  last_call_equal_ = false;
  if (first_) return;
  first_ = finding{calls_, leader_.name, follower.facts().name, *found,
                   decisions_of(c.c, c.isep_before, leader_.real_bytes)};
}

}  // namespace contct
