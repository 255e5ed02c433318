#include "contct/write/explain_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "contct/write/table.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

/// "1, 3" for the pairs that were toggled for this reason.
std::string pairs_toggled(const explained_call& c, why_toggled why) {
  std::vector<int> pairs;
  for (const explained_pair& p : c.pairs)
    if (p.why == why) pairs.push_back(p.pair + 1);
  return fmt::format("{}", fmt::join(pairs, ", "));
}

/// "make 1, break 3", "too early: 3": the events of an increment, and those that came at the wrong place.
std::vector<std::string> summary_words(const explained_increment& i) {
  constexpr std::size_t most_named = 12;
  std::vector<std::string> events;
  for (const event& e : i.what.events.first(std::min(i.what.events.size(), most_named)))
    events.push_back(fmt::format("{} {}", change_name(e.what), e.pair + 1));
  if (i.what.events.size() > most_named)
    events.push_back(fmt::format("{} more", i.what.events.size() - most_named));
  std::vector<std::string> words = {
      events.empty() ? i.left_undone ? "no event: the load left after it is rounding" : "no event"
                     : fmt::format("{}", fmt::join(events, ", "))};
  if (i.left_undone) return words;
  if (const std::string early = pairs_toggled(i.call, why_toggled::too_early); !early.empty())
    words.push_back("too early: " + early);
  if (const std::string marked = pairs_toggled(i.call, why_toggled::by_mark); !marked.empty())
    words.push_back("by its mark: " + marked);
  return words;
}

}  // namespace

void explain_summary::add(const explained_increment& i) {
  constexpr int indent = 6 + 2 + 9 + 2;
  ++increments_;
  std::string head = fmt::format("{:>6}  {:<9}  ", fmt::format("{}.{}", i.what.step, i.what.number),
                                 share_words(i.what.fraction));
  for (const std::string& line : wrap(summary_words(i), terminal_.width - indent)) {
    lines_ += head + line + "\n";
    head.assign(indent, ' ');
  }
}

std::string explain_summary::take() {
  std::string text;
  if (!std::exchange(headed_, true)) {
    if (!title_.empty()) text = painted(terminal_, paint::strong, title_) + "\n";
    text +=
        painted(terminal_, paint::strong, fmt::format("{:>6}  {:<9}  {}", "incr", "share", "events")) + "\n";
  }
  return text + std::exchange(lines_, "");
}

std::string explain_summary::end() const {
  const std::vector<std::string> advice = {
      fmt::format("{} increments; share: share of the step applied so far", increments_),
      "explain one with --increment STEP.INCREMENT, a step with --step, all with --all"};
  std::string text = "\n";
  for (const std::string& line : wrap(advice, terminal_.width)) text += line + "\n";
  return text;
}

}  // namespace contct::write
