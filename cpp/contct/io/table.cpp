#include "contct/io/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "contct/io/result_json.hpp"
#include "contct/structure/cholesky.hpp"

namespace contct {
namespace {

// increment, share, s and kernels with their blanks; the load where there is room; events get the rest.
constexpr int fixed_width = 6 + 2 + 9 + 2 + 9 + 2 + 7 + 2;
constexpr int load_width_at_most = 24;
constexpr int events_width_at_least = 24;
constexpr std::size_t most_events_shown = 12;

/// A number in at most nine columns, with as many digits as fit.
std::string short_number(double x) {
  for (int digits = 8; digits > 1; --digits) {
    std::string text = fmt::format("{:.{}g}", x, digits);
    if (text.size() <= 9) return text;
  }
  return fmt::format("{:.1g}", x);
}

}  // namespace

table::table(const problem& p, const lockstep* compared, const terminal& t)
    : problem_(p),
      loads_(p),
      compared_(compared),
      terminal_(t),
      load_width_(std::min(load_width_at_most, t.width - fixed_width - 2 - events_width_at_least)),
      events_width_(t.width - fixed_width) {
  if (load_width_ < 12) load_width_ = 0;  // a narrow terminal: no room for loads
  if (load_width_ > 0) events_width_ -= load_width_ + 2;
  events_width_ = std::max(events_width_, 10);
}

void table::print_heading() {
  headed_ = true;
  std::string line = fmt::format("{:>6}  {:<9}  {:<9}  {:<7}  ", "incr", "share", "s", "kernels");
  if (load_width_ > 0) line += fmt::format("{:<{}}  ", "load", load_width_);
  line += "events";
  fmt::print("{}\n", painted(terminal_, paint::strong, line));
}

std::string table::agreement() const {
  const std::string word = compared_ == nullptr ? "one" : compared_->last_call_equal() ? "equal" : "DIFFER";
  std::string padded = fmt::format("{:<7}", word);
  if (compared_ == nullptr) return padded;
  return painted(terminal_, compared_->last_call_equal() ? paint::good : paint::bad, padded);
}

std::string table::event_words(const event& e) const {
  const contact_pair& p = problem_.pairs[static_cast<std::size_t>(e.pair)];
  return fmt::format("{} {}: node {} {}", change_name(e.what), e.pair + 1, p.node + 1,
                     surface_name(p.surface));
}

void table::incremented(const increment& i) {
  if (!headed_) print_heading();
  std::string line = fmt::format("{:>6}  {:<9}  {:<9}  {}", fmt::format("{}.{}", i.step, i.number),
                                 short_number(i.fraction), short_number(i.s), agreement());
  if (load_width_ > 0)
    line += fmt::format("  {:<{}}", loads_.words_at(i.step, i.fraction, load_width_), load_width_);
  std::vector<std::string> events;
  for (std::size_t k = 0; k < std::min(i.events.size(), most_events_shown); ++k) {
    events.push_back(event_words(i.events[k]));
  }
  if (i.events.size() > most_events_shown) {
    events.push_back(fmt::format("and {} more (--json has all)", i.events.size() - most_events_shown));
  }
  const std::vector<std::string> lines = wrap(events, events_width_);
  if (lines.empty()) {
    line.erase(line.find_last_not_of(' ') + 1);
  } else {
    line += "  " + lines[0];
  }
  fmt::print("{}\n", line);
  const int indent = terminal_.width - events_width_;
  for (std::size_t k = 1; k < lines.size(); ++k) fmt::print("{:{}}{}\n", "", indent, lines[k]);
}

void table::step_ended(const step_state& s) {
  std::size_t largest = 0;
  for (std::size_t i = 0; i < s.displacement.size(); i += 2) {
    if (std::abs(s.displacement[i]) > std::abs(s.displacement[largest])) largest = i;
  }
  const auto closed = std::count(s.isep.begin(), s.isep.end(), in_contact);
  const std::vector<std::string> items = {
      fmt::format("w = {:.9g} at node {}", s.displacement[largest], largest / 2 + 1),
      fmt::format("{} of {} pairs in contact", closed, s.isep.size()),
      fmt::format("{} digits", digits_left(s.rcond))};
  const char* label = "   end  ";
  for (const std::string& line : wrap(items, terminal_.width - 8)) {
    fmt::print("{}\n", painted(terminal_, paint::quiet, std::exchange(label, "        ") + line));
  }
}

}  // namespace contct
