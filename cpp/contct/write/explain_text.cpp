#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "contct/number/bits.hpp"
#include "contct/write/explain.hpp"
#include "contct/write/words.hpp"

namespace contct {

std::uint64_t ulps_apart(double first, double second, int real_bytes) {
  return real_bytes == 4 ? ulps_between(static_cast<float>(first), static_cast<float>(second))
                         : ulps_between(first, second);
}

std::string side_by_side_words(const explained_kernels& of, double first, double second) {
  const std::string words = fmt::format("{} and {} are ", of.names[0], of.names[1]);
  if (same_bits(first, second)) return words + "equal to the bit";
  if (std::isnan(first) != std::isnan(second)) return words + "different: one is NaN";
  return words + fmt::format("{} ULP apart", ulps_apart(first, second, of.real_bytes));
}

std::string text_of(const terminal& screen, const sentence& t, bool loud) {
  constexpr int margin = 6;
  constexpr int statement_width = 49;
  constexpr int width_with_statements = 120;
  std::string head = t.at.number > 0 ? fmt::format("{:>4}  ", t.at.number) : std::string(margin, ' ');
  if (screen.width >= width_with_statements) head += fmt::format("{:<{}}", t.at.statement, statement_width);
  const int room = screen.width - static_cast<int>(head.size());
  std::vector<std::string> lines = wrap({t.words}, room);
  if (!t.equation.empty()) {
    const auto free = room - static_cast<int>(lines.back().size() + t.equation.size());
    if (free < 1) lines.emplace_back();
    lines.back() += fmt::format("{:>{}}", t.equation, room - static_cast<int>(lines.back().size()));
  }
  std::string text;
  for (const std::string& line : lines) {
    text += head + (loud ? painted(screen, paint::bad, line) : line) + "\n";
    head.assign(head.size(), ' ');
  }
  return text;
}

namespace {

class increment_printer {
 public:
  increment_printer(const explained_kernels& of, const terminal& t, const explained_increment& i)
      : of_(of), terminal_(t), i_(i) {}

  std::string text(bool first) {
    if (first && !of_.what.title.empty()) say(paint::strong, on_one_line(of_.what.title));
    if (first)
      say(paint::quiet,
          "On the left: line numbers of the listing, fortran/contct.f. On the right: equations of the "
          "paper.");
    out_ += "\n";
    const load& aim = of_.what.steps[i_.what.step - 1];
    const std::string name = aim.from_zero ? ", " + on_one_line(aim.name) : "";
    const std::string heading = fmt::format("Step {}{}, increment {}", i_.what.step, name, i_.what.number);
    say(paint::strong, heading);
    say(paint::strong, std::string(heading.size(), '-'));
    print_load();
    for (const explained_pair& p : i_.call.pairs) {
      if (of_.wants(p)) print_pair(p);
    }
    print_winner();
    print_toggles();
    print_outcome();
    return std::move(out_);
  }

 private:
  void say(paint p, const std::string& words) {
    for (const std::string& line : wrap({words}, terminal_.width)) out_ += painted(terminal_, p, line) + "\n";
  }

  void say(const sentence& t, bool loud = false) { out_ += text_of(terminal_, t, loud); }

  void say_side_by_side(std::string_view what, double first, double second) {
    const std::string words = side_by_side_words(of_, first, second);
    say({no_line, fmt::format("{}: {}", what, words)}, words.find("equal to the bit") == std::string::npos);
  }

  void print_load() {
    constexpr int room = 24;
    const std::string now = of_.loads.words_at(i_.what.step, i_.fraction_before, room);
    const std::string aim = of_.loads.words_at(i_.what.step, 1.0, room);
    if (now.empty() || aim.empty()) return;
    say(paint::quiet, fmt::format("The residual load leads from {} to {}.", now, aim));
  }

  void print_pair(const explained_pair& p) {
    out_ += "\n";
    say(paint::strong, heading_of(p, entry_words(of_.what, on::pairs, p.pair)));
    for (const sentence& t : scale_factor_story(p)) say(t);
    if (i_.other != nullptr) say_side_by_side("s", p.s, i_.other->ss[p.pair]);
  }

  void print_winner() {
    out_ += "\n";
    say(paint::strong, "The smallest s");
    for (const sentence& t : winner_story(i_.call)) say(t);
    if (i_.other != nullptr) say_side_by_side("SMIN", i_.call.smin, i_.other->smin);
    if (!i_.call.narrowest) return;
    constexpr std::uint64_t close = 1'000'000;
    say({no_line, i_.call.narrowest->ulps <= close
                      ? "The narrowest decision of this call: " + words_of(*i_.call.narrowest) + "."
                      : "No decision of this call was close."});
  }

  void print_toggles() {
    if (i_.call.winner < 0) return;
    for (const explained_pair& p : i_.call.pairs) {
      if (!of_.wants(p)) continue;
      out_ += "\n";
      say(paint::strong, fmt::format("Pair {}: {}", p.pair + 1, name_of(p.why)));
      for (const sentence& t : toggle_story(i_.call, p))
        say(t, t.at.number == 0 && p.why != why_toggled::same_moment);
      if (i_.other != nullptr && i_.other->isep[p.pair] != p.isep_after)
        say({no_line, fmt::format("ISEP: {} {}, {} {}: DIFFERENT", of_.names[0], p.isep_after, of_.names[1],
                                  i_.other->isep[p.pair])},
            true);
    }
  }

  void print_outcome() {
    out_ += "\n";
    if (i_.left_undone) {
      say(paint::quiet,
          "After this event the remaining load would be only rounding. The driver, not CONTCT, restores ISEP "
          "and applies the whole residual load.");
    }
    if (i_.what.s == 1.0) {
      say(paint::quiet, "The whole residual load is applied: D + d* is the new D (10). The step ends here.");
    } else {
      say(paint::quiet, fmt::format("The share s = {} of the residual load is applied: D + s d* is the new D "
                                    "(10). The share of the step is now {}.",
                                    share_words(i_.what.s), share_words(i_.what.fraction)));
    }
    if (i_.apart && i_.other == nullptr)
      say(paint::bad, fmt::format("{} gave no answer: {}", of_.names[1], i_.apart->follower));
    if (i_.apart && i_.apart->field == "text")
      say(paint::bad, fmt::format(R"(Unit 26, line {}: {} wrote "{}", {} wrote "{}")", i_.apart->index,
                                  of_.names[0], i_.apart->leader, of_.names[1], i_.apart->follower));
  }

  const explained_kernels& of_;
  const terminal& terminal_;
  const explained_increment& i_;
  std::string out_;
};

/// Returns the pairs that were toggled for the reason `why`: "1, 3".
std::string pairs_toggled(const explained_call& c, why_toggled why) {
  std::vector<int> pairs;
  for (const explained_pair& p : c.pairs)
    if (p.why == why) pairs.push_back(p.pair + 1);
  return fmt::format("{}", fmt::join(pairs, ", "));
}

/// Returns the events of an increment, "make 1, break 3", and wrongly toggled pairs, "too early: 3".
std::vector<std::string> summary_words(const explained_increment& i) {
  constexpr std::size_t most_named = 12;
  const std::span<const event> events = i.what.events;
  std::vector<std::string> words = {event_names(events.first(std::min(events.size(), most_named)))};
  if (events.empty())
    words[0] = i.left_undone ? "the event is undone: the remaining load would be only rounding" : "no event";
  if (events.size() > most_named) words[0] += fmt::format(", {} more", events.size() - most_named);
  if (i.left_undone) return words;
  if (const std::string early = pairs_toggled(i.call, why_toggled::too_early); !early.empty())
    words.push_back("too early: " + early);
  if (const std::string marked = pairs_toggled(i.call, why_toggled::by_mark); !marked.empty())
    words.push_back("by its mark: " + marked);
  return words;
}

/// The lines above a summary: the title of the problem, which may be empty, and the headings of the columns.
std::string summary_head(const terminal& t, const std::string& title) {
  return (title.empty() ? "" : painted(t, paint::strong, title) + "\n") +
         painted(t, paint::strong, fmt::format("{:>6}  {:<9}  {}", "incr", "share", "events")) + "\n";
}

/// One increment of a summary: number, share of the step, and summary_words.
std::string summary_line(const terminal& t, const explained_increment& i) {
  constexpr int indent = 6 + 2 + 9 + 2;
  std::string text;
  std::string head = fmt::format("{:>6}  {:<9}  ", fmt::format("{}.{}", i.what.step, i.what.number),
                                 share_words(i.what.fraction));
  for (const std::string& line : wrap(summary_words(i), t.width - indent)) {
    text += head + line + "\n";
    head.assign(indent, ' ');
  }
  return text;
}

std::string summary_end(const terminal& t, std::size_t increments) {
  const std::vector<std::string> advice = {
      fmt::format("{} increments; share: share of the step applied so far", increments),
      "to explain an increment: --increment STEP.INCREMENT; a step: --step STEP; all: --all"};
  std::string text = "\n";
  for (const std::string& line : wrap(advice, t.width)) text += line + "\n";
  return text;
}

}  // namespace

explain_text::explain_text(explained_kernels of, const terminal& t, bool all)
    : of_(std::move(of)), terminal_(t), all_(all), summary_(summary_head(t, of_.what.title)) {}

std::string explain_text::add(const explained_increment& i) {
  ++increments_;
  const bool in_full = all_ || increments_ <= most_told_in_full;
  std::string text;
  if (in_full) text = increment_printer(of_, terminal_, i).text(increments_ == 1);
  if (all_) return text;
  in_full_ += text;
  summary_ += summary_line(terminal_, i);
  if (in_full) return "";
  in_full_.clear();
  return std::exchange(summary_, "");
}

std::string explain_text::finish() {
  if (all_ || increments_ == 0) return "";
  return increments_ <= most_told_in_full ? in_full_ : summary_end(terminal_, increments_);
}

}  // namespace contct
