#include "contct/write/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "contct/matrix/cholesky.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

// increment, share and s, each with the blanks behind it: what every row has.
constexpr int fixed_width = 6 + 2 + 9 + 2 + 9 + 2;
constexpr int kernels_width = 7 + 2;  // where there are two or more
constexpr int load_width_at_most = 24;
constexpr int load_width_at_least = 12;
constexpr int events_width_at_least = 22;
constexpr std::size_t most_events_shown = 12;
/// At no larger share of its load, a step has only begun: structures that rest on their faces let go at once.
constexpr double first_load = 1e-12;

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

}  // namespace

std::string share_words(double x) {
  for (int digits = 8; digits > 1; --digits) {
    std::string text = fmt::format("{:.{}g}", x, digits);
    if (x < 1.0 && text == "1") return fmt::format("1-{:.0e}", 1.0 - x);
    if (text.size() <= 9) return text;
  }
  return fmt::format("{:.1g}", x);
}

table::table(const problem& p, const lockstep* compared, const certifier& judged, const terminal& t,
             bool detail)
    : problem_(p),
      loads_(p),
      compared_(compared),
      judged_(judged),
      terminal_(t),
      deflecting_(deflecting_nodes(p)),
      detail_(detail) {
  const int room = t.width - fixed_width - (compared == nullptr ? 0 : kernels_width);
  const int widest = widest_event(p);
  events_below_ = room < widest;
  load_width_ = std::min(load_width_at_most, events_below_ ? room : room - 2 - widest);
  if (load_width_ < load_width_at_least) load_width_ = 0;
  indent_ = events_below_ ? 4 : t.width - room + (load_width_ > 0 ? load_width_ + 2 : 0);
}

std::string table::row(std::string_view number, std::string_view share, std::string_view s,
                       std::string_view kernels, std::string_view load, std::string_view events) const {
  std::string line = fmt::format("{:>6}  {:<9}  {:<9}  ", number, share, s);
  if (compared_ != nullptr) line += fmt::format("{}  ", kernels);
  if (load_width_ > 0) line += fmt::format("{:<{}}  ", load, load_width_);
  if (!events_below_) line += events;
  return line.erase(line.find_last_not_of(' ') + 1);
}

std::string table::agreement() const {
  if (compared_ == nullptr) return "";
  return compared_->last_call_equal() && first_load_.equal ? painted(terminal_, paint::good, "equal") + "  "
                                                           : painted(terminal_, paint::bad, "DIFFER") + " ";
}

void table::incremented(const increment& i) {
  last_events_.assign(i.events.begin(), i.events.end());
  const std::size_t shown = detail_ ? i.events.size() : std::min(i.events.size(), most_events_shown);
  std::vector<std::string> events;
  for (const event& e : i.events.first(shown)) events.push_back(event_words(problem_, e.what, e.pair));
  if (i.events.size() > shown) events.push_back(fmt::format("{} more in --json", i.events.size() - shown));
  if (i.fraction > first_load || detail_) {
    flush_first_load();
    return print_row(i, agreement(), events);
  }
  for (const event& e : i.events)
    (e.what == change::make ? first_load_.makes : first_load_.breaks).insert(e.pair);
  first_load_.last = {i.step, i.number, i.s, i.fraction, {}, i.snaps};
  ++first_load_.increments;
  first_load_.equal = first_load_.equal && (compared_ == nullptr || compared_->last_call_equal());
  first_load_.events = std::move(events);
}

/// One such increment with a few events has a row as any other.
void table::flush_first_load() {
  if (first_load_.increments == 0) return;
  const auto toggled = [](std::size_t n, const char* what) {
    return n == 0 ? "" : fmt::format("{} pair{} {}{}", n, n == 1 ? "" : "s", what, n == 1 ? "s" : "");
  };
  std::vector<std::string> words;
  for (const std::string& part :
       {toggled(first_load_.breaks.size(), "break"), toggled(first_load_.makes.size(), "make")})
    if (!part.empty()) words.push_back(part);
  if (!words.empty()) words.back() += " at first load";
  const bool few = first_load_.increments == 1 && first_load_.makes.size() + first_load_.breaks.size() <= 3;
  const auto said = std::exchange(first_load_, {});
  first_load_.equal = said.equal;
  print_row(said.last, agreement(), few ? said.events : words);
  first_load_.equal = true;
}

void table::print_row(const increment& i, std::string_view kernels, const std::vector<std::string>& events) {
  if (!std::exchange(headed_, true)) {
    const std::string heading = row("incr", "share", "s", "kernels", "load", "events");
    print_text(fmt::format("{}\n", painted(terminal_, paint::strong, heading)));
  }
  std::vector<std::string> lines = wrap(events, terminal_.width - indent_);
  if (events_below_ || lines.empty()) lines.insert(lines.begin(), "");
  snapped_ = snapped_ || i.snaps;
  print_text(fmt::format("{}\n", row(fmt::format("{}.{}", i.step, i.number), share_words(i.fraction),
                                     i.snaps ? "snap" : share_words(i.s), kernels,
                                     loads_.words_at(i.step, i.fraction, load_width_), lines.front())));
  for (const std::string& more : std::span(lines).subspan(1))
    print_text(fmt::format("{:{}}{}\n", "", indent_, more));
}

void table::step_ended(const step_state& s) {
  flush_first_load();
  ended_ = true;
  // Where the path ends at a pair's opening, its status is as it was before, without force.
  auto closed = std::count(s.isep.begin(), s.isep.end(), in_contact);
  for (const event& e : last_events_)
    if (e.what == change::break_ && s.isep[e.pair] == in_contact) --closed;
  last_events_.clear();
  std::string label = events_below_ ? "end " : "   end  ";
  const int width = terminal_.width - static_cast<int>(label.size());
  std::vector<std::string> items = {fmt::format("{} of {} in contact", closed, s.isep.size()),
                                    certificate_mark(judged_.steps().back())};
  if (const std::optional<certificate>& judged = judged_.steps().back())
    items.insert(items.begin() + 1, digits_words(*judged));
  if (const std::string& name = problem_.steps[s.step - 1].name; !name.empty())
    items.insert(items.begin(), on_one_line(name));
  if (s.from_exact_path)
    items.emplace_back("from the exact path");
  else if (s.from_fallback)
    items.emplace_back("from the reference solution");
  for (const std::string& line : wrap(items, width)) {
    print_text(fmt::format("{}\n", label + line));
    label.assign(label.size(), ' ');
  }
  const step_results r = results_of(problem_, loads_.at(s.step, s.fraction), s, deflecting_);
  for (const std::string& largest : largest_lines(problem_, r, width, sizes_))
    for (const std::string& line : wrap({largest}, width))
      print_text(fmt::format("{}\n", painted(terminal_, paint::strong, label + line)));
  if (detail_) print_text(detail_tables(problem_, s, r));
}

std::vector<std::string> table::legend() const {
  std::vector<std::string> words;
  if (headed_)
    words = {"share: share of the step applied so far",
             "s: share of the remaining load that the increment applies"};
  if (snapped_) words.emplace_back("snap: a rigid-body motion at constant load");
  if (headed_ && compared_ != nullptr) words.emplace_back("kernels: whether their bits are equal");
  if (ended_) words.emplace_back("digits: correct in every number");
  return words;
}

std::string csv_field(std::string_view raw) {
  // Spreadsheets take a cell that begins so for a formula.
  constexpr std::string_view beginnings[] = {"=",  "+",      "-",      "@",      "\t",
                                             "\r", "\uff1d", "\uff0b", "\uff0d", "\uff20"};
  const std::string_view behind_blanks = raw.substr(std::min(raw.find_first_not_of(" \n"), raw.size()));
  const bool formula =
      std::ranges::any_of(beginnings, [&](std::string_view b) { return behind_blanks.starts_with(b); });
  std::string text = (formula ? "'" : "") + terminal_text(raw);
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

run_csv::run_csv(const problem& p, const lockstep* compared, const frame_keeper& states, int watched,
                 output_file& increments, output_file* pairs)
    : problem_(p),
      loads_(p),
      compared_(compared),
      states_(states),
      watched_(watched),
      increments_(increments),
      pairs_(pairs) {
  increments_.write("step,increment,kind,s,share,force,events,closed,open,at_face,smin,kernels,node,w\r\n");
  if (pairs_ != nullptr) pairs_->write("step,increment,pair,node,surface,state,look,w,gap,force\r\n");
}

void run_csv::called(const answered_call& c) {
  if (pending_) write_pending();
  smin_ = c.c.smin;
  agreement_ = compared_ == nullptr ? "" : compared_->last_call_equal() ? "equal" : "differ";
}

void run_csv::incremented(const increment& i) {
  last_ = {i.step,
           i.number,
           i.snaps ? "snap" : "load",
           i.s,
           i.fraction,
           {i.events.begin(), i.events.end()},
           {i.d.begin(), i.d.end()},
           {i.isep.begin(), i.isep.end()},
           states_.latest().pair_forces,
           {}};
  const frame& now = states_.latest();
  if (!now.displacement.empty()) last_.watched = deflection_of(problem_, now, watched_);
  pending_ = true;
}

void run_csv::step_ended(const step_state& s) {
  if (!pending_ || last_.step != s.step || s.from_fallback) {
    if (pending_) write_pending();
    last_ = {s.step, 0, s.from_fallback ? "rescue" : "end", 0.0, s.fraction, {}, {}, {}, {}, {}};
    agreement_ = "";
  }
  last_.isep.assign(s.isep.begin(), s.isep.end());
  last_.watched = deflection_of(problem_, s.displacement, watched_);
  last_.forces = states_.frames().back().pair_forces;
  last_.w.clear();
  for (const contact_pair& p : problem_.pairs)
    last_.w.push_back(deflection_of(problem_, s.displacement, p.node));
  write_pending();
}

void run_csv::write_pending() {
  pending_ = false;
  pair_counts n;
  for (std::size_t i = 0; i < last_.w.size(); ++i)
    ++n.of(look_of(problem_.pairs[i], last_.w[i], last_.isep[i] == in_contact));
  std::vector<std::string> events;
  for (const event& e : last_.events) events.push_back(fmt::format("{} {}", change_name(e.what), e.pair + 1));
  const bool called = last_.number > 0;
  const double force = loads_.force_at(last_.step, last_.fraction);
  increments_.write(fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", last_.step, last_.number,
                                last_.kind, called ? fmt::format("{}", last_.s) : "", last_.fraction, force,
                                csv_field(fmt::format("{}", fmt::join(events, ", "))), n.closed, n.open,
                                n.at_face, called && smin_ ? fmt::format("{}", *smin_) : "", agreement_,
                                csv_field(place_name(problem_.geometry, watched_)),
                                last_.watched ? fmt::format("{}", *last_.watched) : ""));
  if (pairs_ == nullptr) return;
  for (std::size_t i = 0; i < last_.w.size(); ++i) {
    const contact_pair& p = problem_.pairs[i];
    const pair_reading r = reading_of(p, last_.w[i], last_.isep[i] == in_contact);
    pairs_->write(fmt::format("{},{},{},{},{},{},{},{},{},{}\r\n", last_.step, last_.number, i + 1,
                              csv_field(place_name(problem_.geometry, p.node)), surface_name(p.surface),
                              state_name(last_.isep[i]), look_name(r.look), r.w, r.gap, last_.forces[i]));
  }
}

void run_csv::finish() {
  increments_.finish();
  if (pairs_ != nullptr) pairs_->finish();
}

namespace {

/// The quantity whose extremes stand for the bending of the structure.
const value_range* bending(const std::vector<value_range>& ranges) {
  const value_range* most = nullptr;
  for (const value_range& r : ranges) {
    const bool is_moment = r.name == "moment" || r.name == "mx" || r.name == "my" || r.name == "mxy";
    if (is_moment &&
        (most == nullptr || std::abs(r.largest().value) > (1 + 1e-9) * std::abs(most->largest().value)))
      most = &r;
  }
  return most;
}

std::string pair_place(const problem& p, std::size_t pair) {
  const contact_pair& at = p.pairs[pair];
  return fmt::format("pair {}, {} {}", pair + 1, place_words(p.geometry, at.node), surface_name(at.surface));
}

}  // namespace

std::vector<std::string> largest_lines(const problem& p, const step_results& r, int width,
                                       sizes_so_far& sizes) {
  std::vector<std::string> lines;
  const auto add = [&](std::string_view name, double value, std::string_view quantity,
                       const std::string& at) {
    double& size = sizes[std::string(name)];
    size = std::max(size, std::abs(value));
    const bool is_none = is_rounding(value, size);
    const std::string with_unit = fmt::format("{:.6g}", is_none ? 0.0 : value) + unit_words(p, quantity);
    std::string line = fmt::format("{:<14}{:<18}{}", name, with_unit, is_none ? "" : at);
    line.erase(line.find_last_not_of(' ') + 1);
    if (static_cast<int>(line.size()) > width) line = fmt::format("{} {}, {}", name, with_unit, at);
    lines.push_back(std::move(line));
  };
  if (!r.ranges.empty()) {
    const placed_value& w = r.ranges.front().largest();
    add(std::holds_alternative<assembled>(p.geometry.kind) ? "u" : "w", w.value, "w",
        place_words(p.geometry, w));
  }
  if (const value_range* const m = bending(r.ranges))
    add(m->name, m->largest().value, m->name, place_words(p.geometry, m->largest()));
  if (const auto pair = r.hardest_pair())
    add("contact force", r.pairs[*pair].force, "force", pair_place(p, *pair));
  if (const auto i = r.hardest_support(p))
    add("reaction", r.reactions[*i], "force", place_words(p.geometry, p.supports[*i].node));
  return lines;
}

std::string detail_tables(const problem& p, const step_state& s, const step_results& r) {
  std::string text;
  const auto line = [&text]<class... A>(fmt::format_string<A...> words, A&&... all) {
    text += fmt::format(words, std::forward<A>(all)...) + '\n';
  };
  const std::string_view node = node_name(p.geometry);
  if (!r.pairs.empty())
    line("{:>8} {:>10}  {:<8} {:<10} {:>14} {:>14}", "pair", node, "surface", "state", "gap", "force");
  for (std::size_t i = 0; i < r.pairs.size(); ++i)
    line("{:>8} {:>10}  {:<8} {:<10} {:>14.7g} {:>14.7g}", i + 1,
         on_one_line(place_name(p.geometry, p.pairs[i].node)), surface_name(p.pairs[i].surface),
         state_name(s.isep[i]), r.pairs[i].gap, r.pairs[i].force);
  if (!r.reactions.empty()) line("{:>19}  {:<8} {:>25}", node, "dof", "reaction");
  for (std::size_t i = 0; i < r.reactions.size(); ++i)
    line("{:>19}  {:<8} {:>25.7g}", on_one_line(place_name(p.geometry, p.supports[i].node)),
         dof_names(p.geometry)[p.supports[i].dof], r.reactions[i]);
  if (r.elements.elements() == 0) return text;
  line("{:>8}  {:<8} {}", "element", "at its",
       r.elements.places == 2 ? "left and right end" : "four corners");
  for (std::size_t e = 0; e < r.elements.elements(); ++e) {
    for (std::size_t name = 0; name < r.elements.names.size(); ++name) {
      std::string row =
          fmt::format("{:>8}  {:<8}", name == 0 ? std::to_string(e + 1) : "", r.elements.names[name]);
      for (const double value : r.elements.at(e, name)) row += fmt::format(" {:>14.7g}", value);
      text += row + '\n';
    }
  }
  return text;
}

}  // namespace contct::write
