// The ends of many steps on the terminal: combinations one a row, and tables of what is least and largest.
#include <fmt/format.h>

#include <algorithm>

#include "contct/session/step_results.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/table.hpp"
#include "contct/write/words.hpp"

namespace contct {
namespace {

constexpr std::size_t name_width_at_most = 24;

std::string row_of(const run_result& r, const load_path& loads, std::size_t i, std::size_t name_width) {
  const step_record& s = r.record.steps[i];
  const std::optional<certificate>& judged = r.judged.steps()[i];
  const step_results at_end = results_of(r.what, loads.at(s.end.step, s.end.fraction), s.end);
  const std::string verdict = !judged             ? "no equilibrium"
                              : judged->certified ? "certified, " + digits_words(*judged)
                                                  : "NOT certified";
  std::string largest;
  std::string place;
  if (!at_end.ranges.empty()) {
    const value_range* const moment = bending(at_end.ranges);
    const value_range& range = moment != nullptr ? *moment : at_end.ranges.front();
    largest = fmt::format("{} {:.6g}", range.name, range.largest().value);
    place = place_words(r.what.geometry, range.largest());
  }
  return fmt::format(
      "{:<{}}  {:>4}  {:>7}  {:<20}{:<18} {}\n",
      printable(r.what.steps[s.end.step - 1].name, name_width_at_most - 3), name_width, s.increments.size(),
      std::ranges::count(s.end.isep, in_contact), largest, place,
      s.end.fraction < 1.0 ? "share " + share_words(s.end.fraction) + " of its load" : verdict);
}

/// "moment  -12.3 kN m  node 9, x = 4  HL-93 at 3".
template <class Value>
std::string line_of(const problem& p, std::string_view what, double value, const std::string& place,
                    const envelope::reached<Value>& at, std::string_view quantity) {
  return fmt::format("{:<15} {:<19} {:<22} {}\n", what,
                     fmt::format("{:.6g}{}", value, unit_words(p, quantity)), place,
                     on_one_line(p.steps[at.step - 1].name));
}

}  // namespace

std::string extremes_text(const problem& p, const terminal& t, const extremes_of_steps& extremes) {
  std::string text;
  for (const auto& [number, of_steps] : extremes) {
    const auto heading = fmt::format("{:<8}  {:>12}  {:<24}  {:>12}  at", of_steps.front().second.name,
                                     "least", "at", "largest");
    text += "\n" + painted(t, paint::strong, heading) + "\n";
    for (const auto& [step, v] : of_steps)
      text += fmt::format("step {:<3}  {:>12.6g}  {:<24}  {:>12.6g}  {}\n", step, v.least.value,
                          place_words(p.geometry, v.least), v.most.value, place_words(p.geometry, v.most));
  }
  return text;
}

std::string envelope_text(const problem& p, const envelope& e) {
  std::string text;
  for (std::size_t i = 0; i < e.names.size(); ++i)
    for (const bool least : {true, false}) {
      const auto& at = least ? e.values[i].least : e.values[i].most;
      text += line_of(p, fmt::format("{} {}", least ? "least" : "largest", e.names[i]), at.value.value,
                      place_words(p.geometry, at.value), at, e.names[i]);
    }
  const auto force = std::ranges::max_element(e.pairs, {}, [](const auto& at) { return at.value; });
  if (force != e.pairs.end() && force->value > 0.0)
    text += line_of(p, "largest contact", force->value, fmt::format("pair {}", force - e.pairs.begin() + 1),
                    *force, "force");
  return text;
}

std::string combination_rows(const run_result& r, const terminal& t) {
  const load_path loads(r.what);
  std::size_t width = 11;
  for (const load& l : r.what.steps) width = std::max(width, std::min(l.name.size(), name_width_at_most));
  std::string text = painted(t, paint::strong,
                             fmt::format("{:<{}}  {:>4}  {:>7}  {:<38} {}", "combination", width, "incr",
                                         "contact", "largest", "at its end")) +
                     "\n";
  for (std::size_t i = 0; i < r.record.steps.size(); ++i) text += row_of(r, loads, i, width);
  return text;
}

}  // namespace contct
