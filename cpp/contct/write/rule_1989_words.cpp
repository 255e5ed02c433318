#include <fmt/format.h>

#include <algorithm>

#include "contct/session/rule_1989.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

/// "1.2 kN, 4 % of the largest of its kind".
std::string size_words(const run_result& r, const state_difference& d) {
  return fmt::format("{:.3g}{}, {} of the largest of its kind", std::abs(d.value - d.right),
                     unit_of(r.what, d.what), percent_words(d.share));
}

std::string wrong_words(const run_result& r, const state_difference& d) {
  const std::string unit = unit_of(r.what, d.what);
  return fmt::format(
      "the 1989 rule is wrong in step {}: the {} of {} is {:.6g}{}, right is {:.6g}{}: off by {}", d.step,
      name_of_kind(d.what), d.at, d.value, unit, d.right, unit, size_words(r, d));
}

/// How closely states agree, none of which is wrong; `all` is not empty.
std::string agreement_words(const run_result& r, std::span<const state_difference> all) {
  constexpr double ten_digits = 1e-10;  // what lies below depends on the LAPACK in use
  const auto worst = std::ranges::max_element(all, {}, &state_difference::share);
  const std::string start = fmt::format("the 1989 rule comes to the same states{}",
                                        r.beside->same_events ? "" : " by other events");
  if (worst->share < ten_digits) return start + ": every number agrees to 10 digits or more";
  return fmt::format("{}: the largest difference is that of the {} of {} in step {}: {}", start,
                     name_of_kind(worst->what), worst->at, worst->step, size_words(r, *worst));
}

std::string ended_words(const run_result& r) {
  const path_end& end = r.beside->end;
  if (end.status == path_status::solved) return "";
  if (end.status == r.end.status && end.step == r.end.step)
    return "the path of the 1989 rule ends in the same way";
  return "the path of the 1989 rule is lost (the answer does not depend on it): " +
         end_words(r.what, end, false);
}

}  // namespace

std::vector<std::string> rule_1989_words(const run_result& r) {
  constexpr std::size_t most_named = 4;
  std::vector<std::string> lines;
  if (!r.beside) return lines;
  if (std::string ended = ended_words(r); !ended.empty()) lines.push_back(std::move(ended));
  const std::vector<state_difference>& all = r.beside->differences;
  std::size_t wrong = 0;
  int first = 0;
  for (const state_difference& d : all) {
    if (!d.is_wrong()) continue;
    if (++wrong <= most_named) lines.push_back(wrong_words(r, d));
    if (first == 0) first = d.step;
  }
  if (wrong > most_named) lines.push_back(fmt::format("it is wrong in {} more steps", wrong - most_named));
  if (wrong > 0)
    lines.push_back(
        fmt::format("contct explain {} --step {} shows which line of the listing does it", r.file, first));
  if (wrong == 0 && !all.empty()) lines.push_back(agreement_words(r, all));
  return lines;
}

}  // namespace contct
