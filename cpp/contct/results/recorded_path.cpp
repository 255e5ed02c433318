#include "contct/results/recorded_path.hpp"

#include <algorithm>
#include <utility>

#include "contct/kernel/registry.hpp"
#include "contct/path/solve_problem.hpp"
#include "contct/proof/exact_means.hpp"

namespace contct {

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

void run_recorder::take(std::vector<solved_step> ends) {
  for (solved_step& s : ends) {
    solved_step& ended = steps.emplace_back(std::move(s));
    for (increment_record& i : increments_)
      if (i.step == ended.step) ended.increments.push_back(std::move(i));
    if (ended.from == origin::path && !ended.increments.empty())
      ended.number = ended.increments.back().number;
  }
  increments_.clear();
}

void recorded_path::take(solved_path followed) {
  end = std::move(followed.end);
  record.take(std::move(followed.steps));
}

recorded_path path_of(const std::string& kernel, const problem& p, const linear_structure& s,
                      const std::string& engine, observer* shown, int max_increments) {
  recorded_path own;
  std::vector<observer*> all = {&own.record, shown};
  std::erase(all, nullptr);
  certifier proof(p, s, exact_means_of(p));
  own.take(follow(p, s, engine_for(facts_of_kernel(kernel), engine, s), *make_kernel(kernel), all, &proof,
                  max_increments));
  return own;
}

bool recorded_path::all_certified() const {
  return std::ranges::all_of(record.steps,
                             [](const solved_step& s) { return s.judged && s.judged->certified; });
}

}  // namespace contct
