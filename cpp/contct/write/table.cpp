#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "contct/results/envelope.hpp"
#include "contct/results/path_states.hpp"
#include "contct/results/quantities.hpp"
#include "contct/results/rule_1989.hpp"
#include "contct/text/strings.hpp"
#include "contct/write/outputs.hpp"
#include "contct/write/words.hpp"

namespace contct {

namespace {

// The widths of the columns increment, share and s, each with the blanks after it.
constexpr int fixed_width = 6 + 2 + 9 + 2 + 9 + 2;
constexpr int kernels_width = 7 + 2;  // only with two or more kernels, or both rules
constexpr int load_width_at_most = 24;
constexpr int load_width_at_least = 12;
constexpr int events_width_at_least = 22;
constexpr std::size_t most_events_shown = 12;
/// A run of more steps than this has its extremes in separate tables below the steps.
constexpr std::size_t few_steps = 6;
/// If there are more combinations than this, each combination has only one row, not one for each increment.
constexpr std::size_t most_combinations_in_full = 12;
constexpr std::size_t name_width_at_most = 24;

/// Returns "make 1: node 3 below"; `pair` counts from 0.
std::string event_words(const problem& p, change what, int pair) {
  return fmt::format("{} {}: {}", change_name(what), pair + 1, face_words(p, pair));
}

/// The number of characters of the longest event of a problem.
int widest_event(const problem& p) {
  std::size_t widest = events_width_at_least;
  for (std::size_t i = 0; i < p.pairs.size(); ++i)
    widest = std::max(widest, event_words(p, change::break_, static_cast<int>(i)).size());
  return static_cast<int>(widest);
}

/// Returns the events that differ: "1989: make 3 at 0.51" (share of the step), "1989: no make 3" (pair 3).
std::vector<std::string> words_of_1989(const row_of_1989& row) {
  std::vector<std::string> words;
  for (const other_event& e : row.otherwise) {
    if (words.size() == most_events_shown) {
      words.push_back(fmt::format("1989: {} more", row.otherwise.size() - words.size()));
      break;
    }
    const std::string name = fmt::format("{} {}", change_name(e.what.what), e.what.pair + 1);
    words.push_back(e.at ? fmt::format("1989: {} at {}", name, share_words(*e.at)) : "1989: no " + name);
  }
  return words;
}

class table_printer {
 public:
  table_printer(const run_result& r, const terminal& t, bool detail)
      : run_(r),
        problem_(r.what),
        loads_(r.what),
        terminal_(t),
        detail_(detail),
        whole_ends_(detail || r.record.steps.size() <= few_steps || starts_from_zero(r.what)) {
    const int room = t.width - fixed_width - (column().empty() ? 0 : kernels_width);
    const int widest = widest_event(problem_);
    events_below_ = room < widest;
    load_width_ = std::min(load_width_at_most, events_below_ ? room : room - 2 - widest);
    if (load_width_ < load_width_at_least) load_width_ = 0;
    indent_ = events_below_ ? 4 : t.width - room + (load_width_ > 0 ? load_width_ + 2 : 0);
  }

  run_table print() {
    const bool of_combinations = starts_from_zero(problem_);
    if (of_combinations && !detail_ && problem_.steps.size() > most_combinations_in_full) {
      print_combinations();
    } else {
      for (std::size_t step = 0; step < run_.record.steps.size(); ++step) print_step(step);
    }
    if (of_combinations && problem_.steps.size() > 1) print_envelope();
    if (!whole_ends_) print_extremes();
    return {std::move(text_), legend()};
  }

 private:
  using increments = std::span<const increment_record>;

  /// The heading of the column about the kernels; empty if there is no such column.
  [[nodiscard]] std::string_view column() const {
    return run_.beside ? "1989" : run_.compared ? "kernels" : "";
  }

  /// The displacements of a matrix are u, as in the rows of steps.
  [[nodiscard]] std::string_view shown_name(std::string_view quantity) const {
    return quantity == "w" && std::holds_alternative<assembled>(problem_.geometry.kind) ? "u" : quantity;
  }

  /// Prints a step. Increments at the beginning of the step (see first_load) share one row.
  void print_step(std::size_t number) {
    const solved_step& s = run_.record.steps[number];
    const increments all = s.increments;
    for (std::size_t i = 0; i < all.size();) {
      const std::size_t first = i;
      while (!detail_ && i < all.size() && all[i].fraction <= first_load) ++i;
      if (i > first) {
        print_first_load(all.subspan(first, i - first), beside(number, first, i - first));
      } else {
        const increment_record row = ties_from(all, i);
        print_row(row, row.equal, events_of(row), beside(number, first, i - first));
      }
    }
    print_end(s);
  }

  /// In a run of both rules, merges the increments from `i` on that have no load between them into one row,
  /// because only rounding decides which of their pairs comes first. Moves `i` past these increments.
  [[nodiscard]] increment_record ties_from(increments all, std::size_t& i) const {
    constexpr double no_share = 1e-12;
    increment_record row = all[i++];
    if (!run_.beside || detail_) return row;
    const double s = row.s;
    std::vector<event> events = row.events;
    for (; i < all.size() && all[i].s < 1.0 && !all[i].snaps && all[i].fraction - row.fraction <= no_share;
         ++i) {
      events.insert(events.end(), all[i].events.begin(), all[i].events.end());
      row = all[i];
      row.s = s;
    }
    std::ranges::stable_sort(events, {}, &event::pair);
    row.events = std::move(events);
    return row;
  }

  [[nodiscard]] std::vector<std::string> events_of(const increment_record& i) const {
    const std::size_t shown = detail_ ? i.events.size() : std::min(i.events.size(), most_events_shown);
    std::vector<std::string> events;
    for (const event& e : std::span(i.events).first(shown))
      events.push_back(event_words(problem_, e.what, e.pair));
    if (i.events.size() > shown) events.push_back(fmt::format("{} more in --json", i.events.size() - shown));
    return events;
  }

  /// Prints the increments at the beginning of a step as one row, with counts of events if there are many.
  void print_first_load(increments begun, const row_of_1989& other) {
    std::set<int> makes;
    std::set<int> breaks;
    for (const increment_record& i : begun)
      for (const event& e : i.events) (e.what == change::make ? makes : breaks).insert(e.pair);
    const auto toggled = [](std::size_t n, const char* what) {
      return n == 0 ? "" : fmt::format("{} pair{} {}{}", n, n == 1 ? "" : "s", what, n == 1 ? "s" : "");
    };
    std::vector<std::string> words;
    for (const std::string& part : {toggled(breaks.size(), "break"), toggled(makes.size(), "make")})
      if (!part.empty()) words.push_back(part);
    if (!words.empty()) words.back() += " at first load";
    const bool few = begun.size() == 1 && makes.size() + breaks.size() <= 3;
    print_row(begun.back(), std::ranges::all_of(begun, &increment_record::equal),
              few ? events_of(begun.back()) : words, other);
  }

  [[nodiscard]] std::string row(std::string_view number, std::string_view share, std::string_view s,
                                std::string_view kernels, std::string_view load,
                                std::string_view events) const {
    std::string line = fmt::format("{:>6}  {:<9}  {:<9}  ", number, share, s);
    if (!column().empty()) line += fmt::format("{:<7}  ", kernels);
    if (load_width_ > 0) line += fmt::format("{:<{}}  ", load, load_width_);
    if (!events_below_) line += events;
    return line.erase(line.find_last_not_of(' ') + 1);
  }

  /// The differences of the 1989 path in `count` increments of a step, from increment `first`.
  [[nodiscard]] row_of_1989 beside(std::size_t step, std::size_t first, std::size_t count) const {
    row_of_1989 all;
    if (!run_.beside) return all;
    const std::vector<row_of_1989>& rows = run_.beside->rows[step];
    all.followed = !rows.empty();
    for (std::size_t i = first; all.followed && i < first + count; ++i) {
      all.otherwise.insert(all.otherwise.end(), rows[i].otherwise.begin(), rows[i].otherwise.end());
      all.reached = all.reached && rows[i].reached;
    }
    return all;
  }

  /// The text of a row in the column "1989" or "kernels", padded if painted; empty without such a column.
  [[nodiscard]] std::string cell(bool equal, const row_of_1989& other) const {
    if (run_.beside)
      return !other.followed ? "-" : !other.reached ? "ended" : other.otherwise.empty() ? "same" : "other";
    if (!run_.compared) return "";
    return equal ? painted(terminal_, paint::good, "equal") + "  "
                 : painted(terminal_, paint::bad, "DIFFER") + " ";
  }

  void print_row(const increment_record& i, bool equal, std::vector<std::string> events,
                 const row_of_1989& other) {
    for (std::string& words : words_of_1989(other)) events.push_back(std::move(words));
    if (!std::exchange(headed_, true)) print_heading(row("incr", "share", "s", column(), "load", "events"));
    std::vector<std::string> lines = wrap(events, terminal_.width - indent_);
    if (events_below_ || lines.empty()) lines.insert(lines.begin(), "");
    snapped_ = snapped_ || i.snaps;
    text_ += row(fmt::format("{}.{}", i.step, i.number), share_words(i.fraction),
                 i.snaps ? "snap" : share_words(i.s), cell(equal, other),
                 loads_.words_at(i.step, i.fraction, load_width_), lines.front()) +
             '\n';
    for (const std::string& more : std::span(lines).subspan(1))
      text_ += fmt::format("{:{}}{}\n", "", indent_, more);
  }

  void print_end(const solved_step& s) {
    std::string label = events_below_ ? "end " : "   end  ";
    const int width = terminal_.width - static_cast<int>(label.size());
    std::vector<std::string> items = {
        fmt::format("{} of {} in contact", s.pairs_in_contact(), s.isep.size())};
    if (s.judged) items.push_back(digits_words(*s.judged));
    items.emplace_back(!s.judged ? "no certificate" : s.judged->certified ? "certified" : "NOT certified");
    if (const std::string& name = problem_.steps[s.step - 1].name; !name.empty())
      items.insert(items.begin(), on_one_line(name));
    if (s.from == origin::exact_path)
      items.emplace_back("from the exact path");
    else if (s.from == origin::reference)
      items.emplace_back("from the reference solution");
    for (const std::string& line : wrap(items, width)) {
      text_ += label + line + '\n';
      label.assign(label.size(), ' ');
    }
    const step_results r(problem_, s);
    for (std::size_t i = 0; i < r.ranges().size(); ++i) extremes_[i].emplace_back(s.step, r.ranges()[i]);
    std::vector<std::string> lines = largest_lines(r, width, whole_ends_);
    std::ranges::move(watch_lines(r), std::back_inserter(lines));
    if (whole_ends_) std::ranges::move(sum_lines(r), std::back_inserter(lines));
    for (const std::string& unbroken : lines)
      for (const std::string& line : wrap({unbroken}, width))
        text_ += painted(terminal_, paint::strong, label + line) + '\n';
    if (detail_) text_ += detail_tables(r);
  }

  [[nodiscard]] std::vector<std::string> legend() const {
    std::vector<std::string> words;
    if (headed_)
      words = {"share: share of the step applied so far",
               "s: share of the remaining load that the increment applies"};
    if (snapped_) words.emplace_back("snap: a rigid-body motion at constant load");
    if (headed_ && run_.compared) words.emplace_back("kernels: whether their bits are equal");
    if (headed_ && run_.beside)
      words.emplace_back("1989: whether that rule has the same events" +
                         std::string(run_.beside->only.empty() ? "" : "; - where it was not followed"));
    if (run_.record.steps.empty()) return words;
    words.emplace_back("digits: correct in every number");
    const auto rows = quantities_of(problem_, on::element_ends);
    if (std::holds_alternative<beam>(problem_.geometry.kind) && rows.back()->in == unit::stress)
      words.emplace_back("stress: M / W of the lower fibre; the upper fibre has the opposite sign");
    return words;
  }

  void print_heading(std::string_view words) { text_ += painted(terminal_, paint::strong, words) + '\n'; }

  void print_combinations() {
    std::size_t width = 11;
    for (const load& l : problem_.steps) width = std::max(width, std::min(l.name.size(), name_width_at_most));
    print_heading(fmt::format("{:<{}}  {:>4}  {:>7}  {:<38} {}", "combination", width, "incr", "contact",
                              "largest", "at its end"));
    for (const solved_step& s : run_.record.steps) {
      const std::optional<certificate>& judged = s.judged;
      const std::string verdict = s.fraction < 1.0    ? "share " + share_words(s.fraction) + " of its load"
                                  : !judged           ? "no equilibrium"
                                  : judged->certified ? "certified, " + digits_words(*judged)
                                                      : "NOT certified";
      const step_results r(problem_, s);
      std::string largest;
      std::string place;
      if (!r.ranges().empty()) {
        const value_range* const moment = bending(problem_, r.ranges());
        const value_range& range = moment != nullptr ? *moment : r.ranges().front();
        largest = fmt::format("{} {:.6g}", shown_name(range.name), range.largest().value + 0.0);
        place = place_words(problem_.geometry, range.largest());
      }
      text_ += fmt::format("{:<{}}  {:>4}  {:>7}  {:<20}{:<18} {}\n",
                           printable(problem_.steps[s.step - 1].name, name_width_at_most - 3), width,
                           s.increments.size(), s.pairs_in_contact(), largest, place, verdict);
    }
  }

  /// Prints the least and largest value of each quantity, each with its combination.
  void print_envelope() {
    const envelope e = envelope_of(run_);
    if (e.states == 0) return;
    text_ += '\n';
    print_heading("all combinations");
    for (const auto& [row, at, part] : e.values) print_range(*row, at[0], "");
    for (const auto& [row, at, part] : e.watched)
      print_range(*row, at[0], on_one_line(problem_.watches[part].name) + ", ");
    for (const auto& [row, at, part] : e.lists)
      if (row->where != on::pairs || contacts_of(problem_) > 0) print_listed(*row, at);
  }

  void print_range(const quantity_row& row, const envelope::range& of, const std::string& before) {
    for (const auto bound : {&envelope::range::least, &envelope::range::most})
      print_extreme(bound, row, shown_name(row.key), of, before + place_words(problem_.geometry, of.*bound));
  }

  void print_extreme(envelope::reached envelope::range::*bound, const quantity_row& row,
                     std::string_view name, const envelope::range& of, const std::string& at) {
    const envelope::reached& reached = of.*bound;
    text_ +=
        fmt::format("{:<17} {:<19} {:<22} {}\n",
                    fmt::format("{} {}", bound == &envelope::range::least ? "least" : "largest", name),
                    fmt::format("{:.6g}{}", reached.value + 0.0, unit_words(problem_, row.in, reached.node)),
                    at, on_one_line(problem_.steps[reached.step - 1].name));
  }

  /// Prints the extremes of each support, bed, hinge and pair, or of all of them together if there are many.
  void print_listed(const quantity_row& row, std::span<const envelope::range> all) {
    constexpr std::size_t most_listed = 12;
    const list_row& list = list_of(row.where);
    for (const auto bound : {&envelope::range::least, &envelope::range::most}) {
      const bool is_least = bound == &envelope::range::least;
      const auto size_of = [&](const envelope::range& r) { return (is_least ? -1 : 1) * (r.*bound).value; };
      std::span<const envelope::range> told = all.first(list.count(problem_));
      if (told.size() > most_listed)
        told = told.subspan(std::ranges::max_element(told, {}, size_of) - told.begin(), 1);
      for (const envelope::range& of : told) {
        const envelope::reached& reached = of.*bound;
        const bool is_known = reached.step > 0 && (row.where != on::pairs || reached.value > 0.0) &&
                              !(is_least && row.words.starts_with("largest"));
        if (!is_known) continue;
        const auto i = static_cast<std::size_t>(&of - all.data());
        std::string at =
            list.entry.empty() ? name_before(problem_, row.where, i) : numbered_words(problem_, row.where, i);
        if (reached.node >= 0)
          at += (list.entry.empty() ? "" : ", ") + place_words(problem_.geometry, reached);
        print_extreme(bound, row, row.key.substr(row.key.rfind('_') + 1), of, at);
      }
    }
  }

  /// Prints a table for each quantity, with one row for each step.
  void print_extremes() {
    for (const auto& [number, of_steps] : extremes_) {
      text_ += '\n';
      print_heading(fmt::format("{:<8}  {:>12}  {:<24}  {:>12}  at", shown_name(of_steps.front().second.name),
                                "least", "at", "largest"));
      for (const auto& [step, v] : of_steps)
        text_ += fmt::format("step {:<3}  {:>12.6g}  {:<24}  {:>12.6g}  {}\n", step, v.least.value + 0.0,
                             place_words(problem_.geometry, v.least), v.most.value + 0.0,
                             place_words(problem_.geometry, v.most));
    }
  }

  const run_result& run_;
  const problem& problem_;
  load_path loads_;
  const terminal& terminal_;
  bool detail_;
  bool whole_ends_;
  int load_width_ = 0;                     // 0: there is no room for a column of loads
  int indent_ = 0;                         // indent of the events
  bool events_below_ = false;              // on a narrow terminal events have separate lines
  bool headed_ = false, snapped_ = false;  // true: a heading, a snap was printed
  /// By the index of a quantity in step_results::ranges: each step (from 1) with its range.
  std::map<std::size_t, std::vector<std::pair<int, value_range>>> extremes_;
  std::string text_;
};

}  // namespace

run_table table_of(const run_result& r, const terminal& t, bool detail) {
  return table_printer(r, t, detail).print();
}

}  // namespace contct
