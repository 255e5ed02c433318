#include "contct/session/run_result.hpp"

#include <algorithm>
#include <filesystem>

#include "contct/session/exit_status.hpp"
#include "contct/session/rule_1989.hpp"
#include "contct/text/strings.hpp"

namespace contct {

namespace {

structure_state state_of(const step_state& s) {
  structure_state end{.step = s.step,
                      .fraction = s.fraction,
                      .displacement = {s.displacement.begin(), s.displacement.end()},
                      .isep = {s.isep.begin(), s.isep.end()}};
  if (s.numbers != nullptr) end.numbers = *s.numbers;
  return end;
}

}  // namespace

void run_recorder::called(const answered_call& c) {
  smin_ = c.c.smin;
  if (parts_.calls) keep_call(c);
}

void run_recorder::keep_call(const answered_call& c) {
  ++all_calls;
  const std::string_view text = c.text.value_or("");
  all_log += text.size();
  // The text of a call is kept whole or not at all.
  if (log.size() + text.size() <= most_log && log.size() + text.size() == all_log) log += text;
  answers_ = calls.size() < most_calls;
  if (!answers_) return;
  const auto first = c.c.ss.first(std::min(most_ss, c.c.ss.size()));
  calls.push_back({0, 0, c.c.smin, {first.begin(), first.end()}, {}});
  if (compared_ != nullptr) calls.back().followers = compared_->last_answers();
}

void run_recorder::incremented(const increment& i) {
  if (std::exchange(answers_, false)) {
    calls.back().step = i.step;
    calls.back().number = i.number;
  }
  increments_.push_back({i.step,
                         i.number,
                         i.s,
                         i.fraction,
                         i.snaps,
                         {i.events.begin(), i.events.end()},
                         smin_,
                         compared_ == nullptr || compared_->last_call_equal()});
  if (!parts_.states) return;
  increment_record& kept = increments_.back();
  kept.d.assign(i.d.begin(), i.d.end());
  kept.pair_force.assign(i.pair_force.begin(), i.pair_force.end());
  kept.isep.assign(i.isep.begin(), i.isep.end());
}

void run_recorder::step_ended(const step_state& s) {
  steps.push_back({state_of(s), s.rcond, s.from_fallback, s.from_exact_path, std::exchange(increments_, {})});
  step_record& ended = steps.back();
  if (!ended.from_fallback && !ended.increments.empty()) ended.end.number = ended.increments.back().number;
}

std::string_view run_result::status() const {
  return status_name(end.status, equal);
}

const lockstep_on_path* run_result::compared_calls() const {
  if (beside) return &beside->compared;
  return compared ? &*compared : nullptr;
}

const run_recorder& run_result::record_of_calls() const {
  return beside ? beside->record : record;
}

std::string title_of(const problem& p, const std::string& file) {
  const bool named = p.title.find_first_not_of(" \t\r\n") != std::string::npos;
  if (named) return on_one_line(p.title);
  return file == "-" ? "A problem from standard input" : std::filesystem::path(file).filename().string();
}

}  // namespace contct
