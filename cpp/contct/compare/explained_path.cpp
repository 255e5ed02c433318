#include "contct/compare/explained_path.hpp"

#include <algorithm>
#include <utility>

namespace contct::compare {

explained_path::explained_path(kernel_facts leader, std::unique_ptr<kernel> second, increments_wanted wanted,
                               sink to)
    : leader_(std::move(leader)), second_(std::move(second)), wanted_(wanted), to_(std::move(to)) {
  if (!second_) return;
  refuse_unequal(leader_, second_->facts());
  follower_.emplace(leader_, *second_);
}

void explained_path::called(const answered_call& c) {
  ++calls_;
  if (number_++ == 0) ++steps_;
  if (follower_)
    (void)follower_->ask(calls_, c.c, c.isep_before, leader_.has_text ? std::optional(c.text) : std::nullopt);
  // Calls that are not wanted are explained too: the largest deflection decides what is rounding in later
  // ones.
  call_ = explain(c.c, c.isep_before, leader_.real_bytes, largest_);
}

void explained_path::incremented(const increment& i) {
  const double before = std::exchange(fraction_, i.fraction);
  if (wanted_.step == 0 || wanted_.step == i.step) most_increments_ = std::max(most_increments_, i.number);
  if (!wanted_.holds(i.step, i.number)) return;
  ++explained_;
  const bool answered = follower_ && follower_->answered();
  to_({i, before, call_, answered ? &follower_->answer() : nullptr,
       follower_ ? follower_->difference() : std::nullopt, call_.winner >= 0 && i.events.empty()});
}

const std::optional<mismatch_report>& explained_path::first() const {
  static const std::optional<mismatch_report> none;
  return follower_ ? follower_->first() : none;
}

void explained_path::step_ended(const step_state& /*s*/) {
  number_ = 0;
  fraction_ = 0.0;
}

}  // namespace contct::compare
