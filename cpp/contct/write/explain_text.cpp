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

namespace {

std::string number(double x) {
  return fmt::format("{:.9g}", x);
}

/// A share of a load in per cent. A share below 1 is never rounded to 100 %.
std::string per_cent(double share) {
  const std::string text = fmt::format("{:.4g}", 100.0 * share);
  return share < 1.0 && text == "100" ? "nearly 100 %" : text + " %";
}

bool is_separated(const explained_pair& p) {
  return p.isep_before == separated;
}

/// The effect of the load on a pair at its face, from the sign of SSCHK.
sentence check_of_sign(const explained_pair& p) {
  const bool open = is_separated(p);
  if (p.set_s == listing::if_check_positive)
    return {
        listing::if_check_positive,
        fmt::format("SSCHK > 0: the load {}. s = SSCHK * DELTA = {}, so small that it wins over every "
                    "advancing or receding pair.",
                    open ? "pushes the structure against the face" : "lifts it off the face", number(p.s)),
        "(12)"};
  return {listing::if_check_positive,
          fmt::format("SSCHK is not positive: the load {}. No event: s stays 1.",
                      open ? "moves the structure away from the face" : "keeps the pair in contact")};
}

std::string meaning_of_s(const explained_pair& p) {
  const char* const advances = is_separated(p) ? "touches its face" : "leaves its face";
  if (std::isnan(p.s)) return "s is NaN: no event.";
  if (p.s < 0) return "Negative: the structure moves away from this event.";
  if (p.s == 0) return "Zero: no progress, and no event.";
  if (p.s < 1) {
    return fmt::format("{}: it {} at {} of the residual load.", is_separated(p) ? "Advancing" : "Receding",
                       advances, per_cent(p.s));
  }
  if (p.s == 1) return "Exactly at the full load: the listing treats this as no event.";
  return fmt::format("More than 1: the residual load ends before it {}.", advances);
}

/// Whether the s of the pair becomes SMIN.
sentence competition(const explained_pair& p) {
  if (!p.is_true(branch::s_positive))
    return {listing::smallest, "s is not greater than 0: not a candidate.", "(6)"};
  const std::string beaten = number(p.smin_before);
  return {listing::smallest,
          p.took_the_lead() ? fmt::format("0 < s < SMIN = {}: SMIN becomes s; this pair leads.", beaten)
                            : fmt::format("s is not less than SMIN = {}: no change.", beaten),
          "(9)"};
}

/// The sentence about the pair with the next larger s.
std::string runner_up(const explained_call& c) {
  if (c.next < 0) return "No other pair has an event to come.";
  if (c.ulps_ahead == 0) return fmt::format("Pair {} has the same s, to the bit.", c.next + 1);
  const double next = c.pairs[c.next].s;
  const double later = (next - c.smin) / c.smin;
  return fmt::format("Next would be pair {}, s = {}: {}.", c.next + 1, number(next),
                     later < rounding_share(c.real_bytes)
                         ? fmt::format("later by {} ULP, a rounding difference", c.ulps_ahead)
                         : fmt::format("{:.4g} times the load", next / c.smin));
}

/// The reason why a pair other than the winner was toggled; otherwise empty.
std::string reason_for_toggle(const explained_pair& p) {
  if (p.why == why_toggled::too_early)
    return fmt::format(
        "TOO EARLY: {}, {:.3g} from its face. Its own s is {}, but the listing toggles it at SMIN.",
        is_separated(p) ? "it is put in contact before it touches"
                        : "it is separated before it reaches its face",
        p.distance, number(p.s));
  if (p.why == why_toggled::by_mark)
    return fmt::format(
        "BY ITS MARK: this pair has no event, and s = 1 only marks this; but SMIN is so near to 1 that DIFF "
        "is "
        "below EPSMUL. The pair is {:.3g} from its face. The paper's step 14 does not toggle such a pair.",
        p.distance);
  if (p.why == why_toggled::same_moment) return "The pair reaches its face at the same moment as the winner.";
  return "";
}

}  // namespace

std::string_view kind_name(const explained_pair& p) {
  if (p.set_s == listing::no_response) return "no response";
  if (p.set_s != listing::moving) return "stationary";
  return is_separated(p) ? "advancing" : "receding";
}

std::string heading_of(const explained_pair& p, const std::string& place) {
  return fmt::format("Pair {}, {}, face {}, {}: {}", p.pair + 1, place, surface_name(p.surface),
                     is_separated(p) ? "separated" : "in contact", kind_name(p));
}

std::string_view name_of(why_toggled why) {
  constexpr std::string_view names[] = {"not toggled", "winner", "same moment", "too early", "by its mark"};
  return names[static_cast<std::size_t>(why)];
}

std::vector<sentence> scale_factor_story(const explained_pair& p) {
  const sentence gap{listing::gap,
                     fmt::format("GAP = c - D = {} - ({}) = {}", number(p.c), number(p.d), number(p.gap)),
                     "(5)"};
  const sentence responds{listing::if_no_response,
                          fmt::format("d* = {}, not 0: the pair responds.", number(p.d_star))};
  if (p.set_s == listing::no_response)
    return {gap,
            {listing::if_no_response, "d* = 0: the pair does not respond to the residual load."},
            {listing::no_response, "s = 1: the mark for \"no event\"."},
            competition(p)};
  if (p.set_s == listing::moving)
    return {gap,
            responds,
            {listing::if_stationary, "|GAP| is not less than EPSGAP = 1E-10: not stationary."},
            {listing::moving, fmt::format("s = GAP / d* = {}. {}", number(p.s), meaning_of_s(p)), "(4)"},
            competition(p)};
  return {gap,
          responds,
          {listing::if_stationary, "|GAP| < EPSGAP = 1E-10: at its face; the pair is stationary."},
          {listing::stationary, "s = 1 to begin with: the mark for \"no event\"."},
          {listing::check_variable,
           fmt::format("SSCHK = ISEP * ISURF / d* = ({:+}) * ({:+}) / {} = {}", p.isep_before, p.surface,
                       number(p.d_star), number(p.s_chk)),
           "(11)"},
          check_of_sign(p),
          competition(p)};
}

std::vector<sentence> winner_story(const explained_call& c) {
  if (c.winner < 0)
    return {{listing::if_no_events,
             "SMIN is still 1: no pair has an event. All of the residual load can be applied."},
            {listing::write_20, "WRITE: unit 26 receives the line of FORMAT 20."},
            {listing::no_events_return, "RETURN. No pair is toggled."}};
  return {{listing::if_no_events,
           fmt::format("SMIN = {}, not 1. Pair {} wins.", number(c.smin), c.winner + 1), "(9)"},
          {no_line, runner_up(c)}};
}

std::vector<sentence> toggle_story(const explained_call& c, const explained_pair& p) {
  std::vector<sentence> story = {
      {listing::diff, p.pair == c.winner ? "DIFF = 0: s is SMIN."
                                         : fmt::format("DIFF = |s - SMIN| / SMIN = {:.4g}.", p.diff)}};
  if (!p.is_true(branch::within_epsmul)) {
    story.push_back({listing::if_within, "DIFF is not less than EPSMUL = 1/256: not toggled."});
    return story;
  }
  story.push_back({listing::if_within, "DIFF is less than EPSMUL = 1/256: toggled."});
  if (is_separated(p)) {
    story.push_back({listing::if_separated, "ISEP = 1: it was separated."});
    story.push_back({listing::make, "ISEP = -1: in contact. Make."});
  } else {
    story.push_back({listing::if_separated, "ISEP is not 1: it was in contact."});
    story.push_back({listing::break_, "ISEP = 1: separated. Break."});
  }
  if (std::string reason = reason_for_toggle(p); !reason.empty())
    story.push_back({no_line, std::move(reason)});
  return story;
}

}  // namespace contct
