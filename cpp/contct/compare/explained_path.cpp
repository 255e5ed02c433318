#include "contct/compare/explained_path.hpp"

#include <algorithm>
#include <utility>

#include "contct/compare/follower.hpp"

namespace contct {

explained_path::explained_path(kernel_facts leader, std::unique_ptr<kernel> second, increments_wanted wanted,
                               sink to)
    : leader_(std::move(leader)), second_(std::move(second)), wanted_(wanted), to_(std::move(to)) {
  if (second_) refuse_unequal(leader_, second_->facts());
}

void explained_path::called(const answered_call& c) {
  ++calls_;
  if (number_++ == 0) ++steps_;
  if (second_) ask_second(c);
  // Explained even where nobody asks: the largest deflection decides what is rounding later on.
  call_ = explain(c.c, c.isep_before, leader_.real_bytes, largest_);
}

void explained_path::ask_second(const answered_call& c) {
  const auto text = leader_.has_text ? std::optional(c.text) : std::nullopt;
  apart_ = put_to(*second_, c.c, c.isep_before, text, text_equality_of(leader_, second_->facts()), answered_,
                  tally_);
  if (!apart_ || first_) return;
  first_ = mismatch_report{calls_, leader_.name, second_->facts().name, *apart_,
                           decisions_of(c.c, c.isep_before, leader_.real_bytes)};
}

void explained_path::incremented(const increment& i) {
  const double before = std::exchange(fraction_, i.fraction);
  if (wanted_.step == 0 || wanted_.step == i.step) most_increments_ = std::max(most_increments_, i.number);
  if (!wanted_.holds(i.step, i.number)) return;
  ++told_;
  const bool answered = second_ != nullptr && !(apart_ && apart_->field == "answer");
  to_({i, before, call_, answered ? &answered_ : nullptr, apart_, call_.winner >= 0 && i.events.empty()});
}

void explained_path::step_ended(const step_state& /*s*/) {
  number_ = 0;
  fraction_ = 0.0;
}

}  // namespace contct
