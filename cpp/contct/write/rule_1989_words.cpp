#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contct/results/rule_1989.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

/// Returns "1.2 kN, 4 % of the largest of its kind".
std::string size_words(const run_result& r, const state_difference& d) {
  return fmt::format("{:.3g}{}, {} of the largest of its kind", std::abs(d.value - d.right),
                     unit_of(r.what, d.what), percent_words(d.share));
}

std::string wrong_words(const run_result& r, const state_difference& d) {
  const std::string unit = unit_of(r.what, d.what);
  return fmt::format(
      "the 1989 rule is wrong in step {}: the {} of {} is {:.6g}{} instead of {:.6g}{}: off by {}", d.step,
      name_of(d.what).words, d.at, d.value, unit, d.right, unit, size_words(r, d));
}

/// The words for states that agree within the tolerance, with the largest difference in `all`. `all` must not
/// be empty.
std::string agreement_words(const run_result& r, std::span<const state_difference> all) {
  constexpr double ten_digits = 1e-10;  // smaller differences depend on the LAPACK in use
  const auto worst = std::ranges::max_element(all, {}, &state_difference::share);
  const bool is_rounded = std::ranges::any_of(all, &state_difference::but_for_rounding);
  const std::string start = fmt::format("the 1989 rule comes to the same states{}{}",
                                        r.beside->same_events ? "" : " by other events",
                                        is_rounded ? ", but for numbers that are only rounding" : "");
  const std::string_view other = is_rounded ? "other " : "";
  if (worst->share < ten_digits)
    return fmt::format("{}: every {}number agrees to 10 digits or more", start, other);
  return fmt::format("{}: the largest {}difference is in the {} of {} in step {}: {}", start, other,
                     name_of(worst->what).words, worst->at, worst->step, size_words(r, *worst));
}

/// The ends of all steps that were not solved.
std::vector<const path_end*> unsolved(const path_end& end) {
  std::vector<const path_end*> all;
  if (end.status != path_status::solved) all.push_back(&end);
  for (const path_end& other : end.others) all.push_back(&other);
  return all;
}

const path_end* in_step(const std::vector<const path_end*>& ends, int step) {
  const auto found = std::ranges::find(ends, step, &path_end::step);
  return found == ends.end() ? nullptr : *found;
}

/// Compares the ends of all steps that the answer or the 1989 rule does not solve.
std::vector<std::string> ended_words(const run_result& r) {
  const std::vector<const path_end*> mine = unsolved(r.end);
  const std::vector<const path_end*> its = unsolved(r.beside->end);
  std::vector<std::string> lines;
  for (const path_end* end : its) {
    const path_end* const right = in_step(mine, end->step);
    if (right != nullptr && right->status == end->status &&
        std::abs(right->fraction - end->fraction) <= same_share)
      continue;
    lines.push_back(fmt::format("the path of the 1989 rule ends {} (the answer does not depend on it): {}",
                                right == nullptr ? "early" : "otherwise", end_words(r.what, *end, false)));
  }
  for (const solved_step& s : r.beside->record.steps) {
    const path_end* const right = s.fraction == 1.0 ? in_step(mine, s.step) : nullptr;
    if (right != nullptr && right->status == path_status::mechanism)
      lines.push_back("the 1989 rule is wrong in " + step_words(r.what, s.step) +
                      ": it reaches the full load, under which there is no equilibrium");
  }
  if (lines.empty() && !its.empty()) return {"the path of the 1989 rule ends in the same way"};
  return first_of(std::move(lines));
}

std::string advice_words(const run_result& r, int step) {
  return fmt::format("contct explain {} --step {} shows which line of the listing causes the error", r.file,
                     step);
}

/// For combinations, of which there may be hundreds: one line, and one more about the first error.
std::vector<std::string> combination_words(const run_result& r, const std::vector<std::string>& ended) {
  const std::vector<state_difference>& all = r.beside->differences;
  const std::size_t followed = r.beside->only.empty() ? r.what.steps.size() : r.beside->only.size();
  const auto wrong = std::ranges::count_if(all, &state_difference::is_wrong);
  const std::string in =
      followed == r.what.steps.size()
          ? counted(followed, "combination")
          : fmt::format("{} of {} combinations (all: --compare all)", followed, r.what.steps.size());
  if (wrong == 0 && ended.empty())
    return all.empty() ? std::vector<std::string>()
                       : std::vector{fmt::format("in {} {}", in, agreement_words(r, all))};
  if (wrong == 0) return {fmt::format("in {} {}", in, ended.front())};
  const auto first = std::ranges::find_if(all, &state_difference::is_wrong);
  return {fmt::format("in {} the 1989 rule, which is not the answer, is wrong in {}", in, wrong),
          wrong_words(r, *first) + "; " + advice_words(r, first->step)};
}

}  // namespace

std::vector<std::string> rule_1989_words(const run_result& r) {
  constexpr std::size_t most_named = 4;
  std::vector<std::string> lines;
  if (!r.beside) return lines;
  lines = ended_words(r);
  if (starts_from_zero(r.what)) return combination_words(r, lines);
  const std::vector<state_difference>& all = r.beside->differences;
  std::size_t wrong = 0;
  int first = 0;
  for (const state_difference& d : all) {
    if (!d.is_wrong()) continue;
    if (++wrong <= most_named) lines.push_back(wrong_words(r, d));
    if (first == 0) first = d.step;
  }
  if (wrong > most_named)
    lines.push_back(fmt::format("the 1989 rule is wrong in {} more steps", wrong - most_named));
  if (wrong > 0) lines.push_back(advice_words(r, first));
  if (wrong == 0 && !all.empty()) lines.push_back(agreement_words(r, all));
  return lines;
}

}  // namespace contct
