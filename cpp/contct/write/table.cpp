#include "contct/write/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "contct/matrix/cholesky.hpp"
#include "contct/write/certificate_text.hpp"
#include "contct/write/frame_numbers.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

// increment, share, s and kernels, each with the blanks behind it: what every row has.
constexpr int fixed_width = 6 + 2 + 9 + 2 + 9 + 2 + 7 + 2;
constexpr int load_width_at_most = 24;
constexpr int load_width_at_least = 12;
constexpr int events_width_at_least = 24;
constexpr std::size_t most_events_shown = 12;

/// "make 1: node 3 below".
std::string event_words(const problem& p, change what, int pair) {
  const contact_pair& at = p.pairs[pair];
  return fmt::format("{} {}: {} {}", change_name(what), pair + 1, place_words(p.geometry, at.node),
                     surface_name(at.surface));
}

/// Columns that any one event of a problem may take.
int widest_event(const problem& p) {
  std::size_t widest = events_width_at_least;
  for (std::size_t i = 0; i < p.pairs.size(); ++i)
    widest = std::max(widest, event_words(p, change::break_, static_cast<int>(i)).size());
  return static_cast<int>(widest);
}

/// With as many digits, nine at most, as fit.
std::string deflection_words(const model& m, const extreme& most, int width) {
  const std::string at = place_words(m, most.at);
  const char* const name = std::holds_alternative<assembled>(m.kind) ? "u" : "w";
  std::string text;
  for (int digits = 9; digits >= 3; --digits) {
    text = fmt::format("{} = {:.{}g} at {}", name, most.value, digits, at);
    if (static_cast<int>(text.size()) <= width) break;
  }
  return text;
}

void trim(std::string& line) {
  line.erase(line.find_last_not_of(' ') + 1);
}

}  // namespace

std::string share_words(double x) {
  for (int digits = 8; digits > 1; --digits) {
    std::string text = fmt::format("{:.{}g}", x, digits);
    if (x < 1.0 && text == "1") return fmt::format("1-{:.0e}", 1.0 - x);
    if (text.size() <= 9) return text;
  }
  return fmt::format("{:.1g}", x);
}

table::table(const problem& p, const lockstep* compared, const certifier& judged, const terminal& t)
    : problem_(p), loads_(p), compared_(compared), judged_(judged), terminal_(t) {
  const int room = t.width - fixed_width;
  const int widest = widest_event(p);
  events_below_ = room < widest;
  load_width_ = std::min(load_width_at_most, events_below_ ? room : room - 2 - widest);
  if (load_width_ < load_width_at_least) load_width_ = 0;
  indent_ = events_below_ ? 4 : t.width - room + (load_width_ > 0 ? load_width_ + 2 : 0);
}

void table::print_heading() {
  headed_ = true;
  std::string line = fmt::format("{:>6}  {:<9}  {:<9}  {:<7}  ", "incr", "share", "s", "kernels");
  if (load_width_ > 0) line += fmt::format("{:<{}}  ", "load", load_width_);
  if (!events_below_) line += "events";
  trim(line);
  fmt::print("{}\n", painted(terminal_, paint::strong, line));
}

std::string table::agreement() const {
  const std::string word = compared_ == nullptr ? "one" : compared_->last_call_equal() ? "equal" : "DIFFER";
  const std::string blanks(7 - word.size(), ' ');
  if (compared_ == nullptr) return word + blanks;
  return painted(terminal_, compared_->last_call_equal() ? paint::good : paint::bad, word) + blanks;
}

std::vector<std::string> table::event_lines(const increment& i) const {
  std::vector<std::string> events;
  for (std::size_t k = 0; k < std::min(i.events.size(), most_events_shown); ++k) {
    const event& e = i.events[k];
    events.push_back(event_words(problem_, e.what, e.pair));
  }
  if (i.events.size() > most_events_shown)
    events.push_back(fmt::format("{} more in --json", i.events.size() - most_events_shown));
  return wrap(events, terminal_.width - indent_);
}

void table::incremented(const increment& i) {
  if (!headed_) print_heading();
  std::string line = fmt::format("{:>6}  {:<9}  {:<9}  {}  ", fmt::format("{}.{}", i.step, i.number),
                                 share_words(i.fraction), i.snaps ? "snap" : share_words(i.s), agreement());
  if (load_width_ > 0)
    line += fmt::format("{:<{}}  ", loads_.words_at(i.step, i.fraction, load_width_), load_width_);
  std::vector<std::string> events = event_lines(i);
  if (!events_below_ && !events.empty()) {
    line += events.front();
    events.erase(events.begin());
  }
  trim(line);
  fmt::print("{}\n", line);
  for (const std::string& more : events) fmt::print("{:{}}{}\n", "", indent_, more);
}

void table::step_ended(const step_state& s) {
  extreme most{0, s.displacement[0]};
  for (int node = 0; node < nodes(problem_.geometry); ++node)
    most.take(node, deflection_of(problem_, s.displacement, node));
  const auto closed = std::count(s.isep.begin(), s.isep.end(), in_contact);
  std::string label = events_below_ ? "end " : "   end  ";
  const int width = terminal_.width - static_cast<int>(label.size());
  std::vector<std::string> items = {deflection_words(problem_.geometry, most, width),
                                    fmt::format("{} of {} in contact", closed, s.isep.size()),
                                    fmt::format("{} digits", digits_left(s.rcond)),
                                    certificate_mark(judged_.steps().back())};
  if (s.from_fallback) items.emplace_back("ended by the oracle");
  for (const std::string& line : wrap(items, width)) {
    fmt::print("{}\n", painted(terminal_, paint::quiet, label + line));
    label.assign(label.size(), ' ');
  }
}

}  // namespace contct::write
