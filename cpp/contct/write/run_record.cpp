#include "contct/write/run_record.hpp"

#include <algorithm>

namespace contct {

void run_record::called(const answered_call& c) {
  ++all_calls;
  all_log += c.text.size();
  // Whole calls only: a text is never cut in the middle of an event.
  if (log.size() + c.text.size() <= most_log && log.size() + c.text.size() == all_log) log += c.text;
  answers_ = calls.size() < most_calls;
  if (!answers_) return;
  call_record r;
  r.smin = c.c.smin;
  r.ss.assign(c.c.ss.begin(), c.c.ss.begin() + static_cast<std::ptrdiff_t>(std::min(most_ss, c.c.ss.size())));
  if (compared_ != nullptr) r.followers = compared_->last_answers();
  calls.push_back(std::move(r));
}

void run_record::incremented(const increment& i) {
  if (answers_) {
    calls.back().step = i.step;
    calls.back().number = i.number;
  }
  answers_ = false;
  if (all_increments++ >= most_increments) return;
  increments.push_back({i.step, i.number, i.s, i.fraction, i.snaps, {i.events.begin(), i.events.end()}});
}

}  // namespace contct
