#include "contct/check/lockstep.hpp"

#include <stdexcept>
#include <utility>

namespace contct {

lockstep::lockstep(kernel_facts leader, std::vector<std::unique_ptr<kernel>> followers)
    : leader_(std::move(leader)), followers_(std::move(followers)) {
  for (const auto& f : followers_) {
    const kernel_facts& facts = f->facts();
    if (facts.real_bytes != leader_.real_bytes || facts.rule != leader_.rule) {
      throw std::invalid_argument("\"" + leader_.name + "\" and \"" + facts.name +
                                  "\" differ in precision or rule and cannot be equal to the bit; "
                                  "compare them with --free-run");
    }
  }
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
