#include "contct/exact/exact_companion.hpp"

#include <algorithm>
#include <stdexcept>

namespace contct::exact {

bool exact_companion::is_behind_last(const path::increment& i) const {
  if (!last_ || i.step < last_->step) return false;
  return i.step > last_->step || (last_->increment > 0 && i.number > last_->increment);
}

void exact_companion::incremented(const path::increment& i) {
  has_call_ = false;
  if (parted_ || !stopped_.empty() || is_behind_last(i)) return;
  try {
    has_call_ = path_.next();
  } catch (const std::runtime_error& e) {  // too_long is one
    stopped_ = e.what();
    return;
  }
  if (!has_call_) {
    stopped_ = path_.status() == path_status::mechanism
                   ? "it ends before: the structure has become a mechanism"
                   : "it ends before, at the limit of increments";
    parted_ = {i.step, i.number};
    return;
  }
  if (!std::ranges::equal(path_.call().led_to.events, i.events)) parted_ = {i.step, i.number};
}

}  // namespace contct::exact
