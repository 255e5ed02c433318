#include "contct/write/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "contct/numeric/bits.hpp"
#include "contct/write/table.hpp"
#include "contct/write/words.hpp"

namespace contct::write {
namespace {

using json = nlohmann::ordered_json;

/// A sentence about a line of fortran/contct.f.
struct sentence {
  listing_line at;  // number 0: no line
  std::string words;
  std::string equation{};  // of the paper: "(4)", "lemma 2"; or empty
};
constexpr listing_line no_line{0, {}};

/// Nine digits, enough to compare by eye; the bits are given separately.
std::string number(double x) {
  return fmt::format("{:.9g}", x);
}

/// A share of a load in per cent, never rounded to all of it.
std::string per_cent(double share) {
  const std::string text = fmt::format("{:.4g}", 100.0 * share);
  return share < 1.0 && text == "100" ? "nearly 100 %" : text + " %";
}

bool is_separated(const explained_pair& p) {
  return p.isep_before == separated;
}

/// What the load does to a pair at its face, from the sign of SSCHK.
sentence check_of_sign(const explained_pair& p) {
  const bool open = is_separated(p);
  if (p.way == way_to_s::stationary_event)
    return {
        listing::if_check_positive,
        fmt::format("SSCHK > 0: the load {}. s = SSCHK * DELTA = {}, so small that it wins over every "
                    "advancing or receding pair.",
                    open ? "pushes the structure against the face" : "lifts it off the face", number(p.s)),
        "(12)"};
  return {listing::if_check_positive,
          fmt::format("SSCHK is not positive: the load {}. No event; the mark stays.",
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
  if (p.s == 1) return "Exactly at the full load: the listing takes this for no event.";
  return fmt::format("More than 1: the residual load ends before it {}.", advances);
}

/// Whether the pair becomes the one to beat.
sentence competition(const explained_pair& p) {
  if (!p.at(branch::s_positive).outcome)
    return {listing::smallest, "s is not greater than 0: not a candidate.", "(6)"};
  const std::string beaten = number(p.smin_before);
  return {listing::smallest,
          p.took_the_lead() ? fmt::format("0 < s < SMIN = {}: SMIN becomes s; this pair leads.", beaten)
                            : fmt::format("s is not less than SMIN = {}: no change.", beaten),
          "(9)"};
}

/// What is to be said of the candidate behind the winner.
std::string runner_up(const explained_call& c) {
  if (c.next < 0) return "No other pair has an event ahead of it.";
  if (c.ulps_ahead == 0) return fmt::format("Pair {} has the same s, to the bit.", c.next + 1);
  const double next = c.pairs[c.next].s;
  const double later = (next - c.smin) / c.smin;
  return fmt::format("Next would be pair {}, s = {}: {}.", c.next + 1, number(next),
                     later < rounding_share(c.real_bytes)
                         ? fmt::format("later by {} ULP, which is rounding", c.ulps_ahead)
                         : fmt::format("{:.4g} times the load", next / c.smin));
}

/// Why a pair that is not the winner was toggled; nothing of others.
std::string reason_for_toggle(const explained_pair& p) {
  if (p.why == why_toggled::too_early)
    return fmt::format(
        "TOO EARLY: {}, {:.3g} from its face. Its own s is {}; the listing does not wait for it.",
        is_separated(p) ? "it is put in contact before it touches"
                        : "it is separated before it comes to its face",
        p.distance, number(p.s));
  if (p.why == why_toggled::by_mark)
    return fmt::format(
        "BY ITS MARK: this pair has no event. Its s = 1 is only the mark for that, but SMIN is so near to 1 "
        "that the mark lies within EPSMUL. It is {:.3g} from its face. The paper's step 14 does not do this.",
        p.distance);
  if (p.why == why_toggled::same_moment) return "It comes to its face at the same moment as the winner.";
  return "";
}

/// How a pair came to its s: the body of the DO 10 loop.
std::vector<sentence> scale_factor_story(const explained_pair& p) {
  const sentence gap{listing::gap,
                     fmt::format("GAP = c - D = {} - ({}) = {}", number(p.c), number(p.d), number(p.gap)),
                     "(5)"};
  const sentence responds{listing::if_no_response,
                          fmt::format("d* = {}, not 0: the pair responds.", number(p.d_star))};
  if (p.way == way_to_s::no_response)
    return {gap,
            {listing::if_no_response, "d* = 0: the pair does not respond to the residual load."},
            {listing::no_response, "s = 1: the mark for \"no event\"."},
            competition(p)};
  if (p.way == way_to_s::moving)
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

/// Which pair won, and by how much: from SMIN to the IF that returns.
std::vector<sentence> winner_story(const explained_call& c) {
  if (c.winner < 0)
    return {{listing::if_no_events,
             "SMIN is still 1: no event on the way. All of the residual load can be applied."},
            {listing::no_events_return, "RETURN. No pair is toggled."}};
  return {{listing::if_no_events,
           fmt::format("SMIN = {}, not 1. Pair {} wins.", number(c.smin), c.winner + 1), "(9)"},
          {no_line, runner_up(c)}};
}

/// Whether a pair was toggled, and why: the body of the DO 30 loop. The call had an event.
std::vector<sentence> toggle_story(const explained_call& c, const explained_pair& p) {
  std::vector<sentence> story = {
      {listing::diff, p.pair == c.winner ? "DIFF = 0: s is SMIN."
                                         : fmt::format("DIFF = |s - SMIN| / SMIN = {:.4g}.", p.diff)}};
  if (!p.at(branch::within_epsmul).outcome) {
    story.push_back({listing::if_within, "Not less than EPSMUL = 1/256: not toggled."});
    return story;
  }
  story.push_back({listing::if_within, "Less than EPSMUL = 1/256: toggled."});
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

std::string_view kind_of_contact(const explained_pair& p) {
  return kind_name(p.way, is_separated(p));
}

std::string_view name_of(why_toggled why) {
  constexpr std::string_view names[] = {"not toggled", "winner", "same moment", "too early", "by its mark"};
  return names[static_cast<std::size_t>(why)];
}

}  // namespace

std::uint64_t ulps_apart(double first, double second, int real_bytes) {
  return real_bytes == 4 ? ulps_between(static_cast<float>(first), static_cast<float>(second))
                         : ulps_between(first, second);
}

std::string_view kind_name(way_to_s way, bool is_separated) {
  if (way == way_to_s::no_response) return "no response";
  if (way != way_to_s::moving) return "stationary";
  return is_separated ? "advancing" : "receding";
}

std::string side_by_side_words(std::string_view first_name, double first, std::string_view second_name,
                               double second, int real_bytes, bool hex) {
  const std::string words = hex ? fmt::format("{} {}, {} ", first_name, hexfloat(first), second_name)
                                : fmt::format("{} and {} are ", first_name, second_name);
  if (same_bits(first, second)) return words + "equal to the bit";
  const std::string apart = std::isnan(first) != std::isnan(second)
                                ? (hex ? "one is NaN" : "different: one is NaN")
                                : fmt::format("{} ULP apart", ulps_apart(first, second, real_bytes));
  return words + (hex ? fmt::format("{}: {}", hexfloat(second), apart) : apart);
}

namespace {

/// The text of one increment.
class increment_printer {
 public:
  increment_printer(const explained_kernels& of, const terminal& t, bool hex, const explained_increment& i,
                    const explain_addition* more)
      : of_(of), terminal_(t), hex_(hex), i_(i), more_(more) {}

  std::string text(bool first) {
    if (first && !of_.what.title.empty()) say(paint::strong, on_one_line(of_.what.title));
    if (first)
      say(paint::quiet,
          "On the left: line numbers of the listing, fortran/contct.f. On the right: equations of the "
          "paper.");
    out_ += "\n";
    const std::string heading = fmt::format("Step {}, increment {}", i_.what.step, i_.what.number);
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

  /// "  38  s = GAP / d* = 0.25.                 (4)"; where there is room, with the statement behind its
  /// number.
  void say(const sentence& t, bool loud = false) {
    constexpr int margin = 6;
    constexpr int statement_width = 49;
    constexpr int width_with_statements = 120;
    std::string head = t.at.number > 0 ? fmt::format("{:>4}  ", t.at.number) : std::string(margin, ' ');
    if (terminal_.width >= width_with_statements)
      head += fmt::format("{:<{}}", t.at.statement, statement_width);
    const int room = terminal_.width - static_cast<int>(head.size());
    std::vector<std::string> lines = wrap({t.words}, room);
    if (!t.equation.empty()) {
      const auto free = room - static_cast<int>(lines.back().size() + t.equation.size());
      if (free >= 1) {
        lines.back() += std::string(free, ' ') + t.equation;
      } else {
        lines.push_back(fmt::format("{:>{}}", t.equation, room));
      }
    }
    for (const std::string& line : lines) {
      out_ += head + (loud ? painted(terminal_, paint::bad, line) : line) + "\n";
      head.assign(head.size(), ' ');
    }
  }

  void say_side_by_side(std::string_view what, double first, double second) {
    const std::string words =
        side_by_side_words(of_.names[0], first, of_.names[1], second, of_.real_bytes, hex_);
    say({no_line, fmt::format("{}: {}", what, words)}, words.find("equal to the bit") == std::string::npos);
  }

  void say(const explain_addition::remarks& remarks) {
    for (const added_remark& r : remarks) say({no_line, r.words}, r.loud);
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
    say(paint::strong, fmt::format("Pair {}, {}, face {}, {}: {}", p.pair + 1,
                                   place_words(of_.what.geometry, p.node - 1), surface_name(p.surface),
                                   is_separated(p) ? "separated" : "in contact", kind_of_contact(p)));
    for (const sentence& t : scale_factor_story(p)) say(t);
    if (i_.other != nullptr) say_side_by_side("s", p.s, i_.other->ss[p.pair]);
    if (more_ != nullptr) say(more_->of_s(of_, i_, p));
  }

  void print_winner() {
    out_ += "\n";
    say(paint::strong, "The smallest s");
    for (const sentence& t : winner_story(i_.call)) say(t);
    if (i_.other != nullptr) say_side_by_side("SMIN", i_.call.smin, i_.other->smin);
    if (more_ != nullptr) say(more_->of_smin(of_, i_));
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
          "After this event only rounding would be left of the load. The driver, not CONTCT, restores ISEP "
          "and applies the whole residual load.");
    }
    if (i_.what.s == 1.0) {
      say(paint::quiet, "The whole residual load is applied: D + d* is the new D (10). The step ends here.");
    } else {
      say(paint::quiet, fmt::format("The share s = {} of the residual load is applied: D + s d* is the new D "
                                    "(10). The share of the step is now {}.",
                                    share_words(i_.what.s), share_words(i_.what.fraction)));
    }
    if (more_ != nullptr) {
      for (const added_remark& r : more_->of_end(of_, i_)) say(r.loud ? paint::bad : paint::quiet, r.words);
    }
    if (i_.apart && i_.other == nullptr)
      say(paint::bad, fmt::format("{} gave no answer: {}", of_.names[1], i_.apart->follower));
    if (i_.apart && i_.apart->field == "text")
      say(paint::bad, fmt::format(R"(Unit 26, line {}: {} wrote "{}", {} wrote "{}")", i_.apart->index,
                                  of_.names[0], i_.apart->leader, of_.names[1], i_.apart->follower));
  }

  const explained_kernels& of_;
  const terminal& terminal_;
  bool hex_;
  const explained_increment& i_;
  const explain_addition* more_;
  std::string out_;
};

json story_json(const std::vector<sentence>& story) {
  return list_of(story, [](const sentence& t) {
    json entry;
    if (t.at.number > 0) entry = {{"line", t.at.number}, {"statement", t.at.statement}};
    entry["words"] = t.words;
    if (!t.equation.empty()) entry["equation"] = t.equation;
    return entry;
  });
}

/// The IFs that were reached, in the listing's order, each with its margin.
json branches_json(const explained_pair& p) {
  json list = json::array();
  for (std::size_t b = 0; b < branch_names.size(); ++b) {
    const taken_branch& t = p.taken[b];
    if (!t.reached) continue;
    json& entry = list.emplace_back(json{{"if", branch_conditions[b]}, {"outcome", t.outcome}});
    if (static_cast<branch>(b) != branch::was_separated) entry["ulps"] = t.ulps;
  }
  return list;
}

/// A number of both kernels: as both have it, and how far they are apart.
json both_json(const explained_kernels& of, double first, const double* second) {
  json out = {{of.names[0], hexfloat(first)}};
  if (second == nullptr) return out;
  out[of.names[1]] = hexfloat(*second);
  out["ulps"] = ulps_apart(first, *second, of.real_bytes);
  return out;
}

json pair_json(const explained_kernels& of, const explained_increment& i, const explain_addition* more,
               const explained_pair& p) {
  json out = {{"pair", p.pair + 1}};
  put_place(out, of.what.geometry, p.node - 1);
  out.update({{"surface", surface_name(p.surface)},
              {"before", state_name(p.isep_before)},
              {"after", state_name(p.isep_after)},
              {"kind", kind_of_contact(p)},
              {"c", p.c},
              {"d", p.d},
              {"d_star", p.d_star},
              {"gap", p.gap},
              {"s", p.s}});
  if (p.at(branch::check_positive).reached) out["s_chk"] = p.s_chk;
  if (p.at(branch::within_epsmul).reached) out["diff"] = p.diff;
  out.update({{"leads", p.took_the_lead()}, {"toggled", p.toggled()}, {"why", name_of(p.why)}});
  if (p.toggled()) out["distance_from_face"] = p.distance;
  out["branches"] = branches_json(p);
  out["bits"] = both_json(of, p.s, i.other == nullptr ? nullptr : &i.other->ss[p.pair]);
  if (i.other != nullptr) out["isep"] = {{of.names[0], p.isep_after}, {of.names[1], i.other->isep[p.pair]}};
  if (more != nullptr) more->put_pair(out, of, i, p);
  std::vector<sentence> story = scale_factor_story(p);
  if (i.call.winner >= 0) std::ranges::move(toggle_story(i.call, p), std::back_inserter(story));
  out["story"] = story_json(story);
  return out;
}

json winner_json(const explained_call& c) {
  if (c.winner < 0) return nullptr;
  json out = {{"pair", c.winner + 1}};
  if (c.next >= 0)
    out.update({{"next_pair", c.next + 1}, {"next_s", c.pairs[c.next].s}, {"ulps_ahead", c.ulps_ahead}});
  return out;
}

json narrowest_json(const std::optional<decision>& d) {
  if (!d) return nullptr;
  json out = {{"if", branch_conditions[index_of(d->what)]}, {"outcome", d->outcome}, {"ulps", d->ulps}};
  if (d->pair >= 0) out["pair"] = d->pair + 1;
  return out;
}

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

std::string summary_head(const terminal& t, const std::string& title) {
  return (title.empty() ? "" : painted(t, paint::strong, title) + "\n") +
         painted(t, paint::strong, fmt::format("{:>6}  {:<9}  {}", "incr", "share", "events")) + "\n";
}

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
      "explain one with --increment STEP.INCREMENT, a step with --step, all with --all"};
  std::string text = "\n";
  for (const std::string& line : wrap(advice, t.width)) text += line + "\n";
  return text;
}

void explain_text::print(const explained_increment& i, const explain_addition* more) {
  ++increments_;
  const bool in_full = detail_.all || increments_ <= most_told_in_full;
  std::string text;
  if (in_full) text = increment_printer(of_, terminal_, detail_.hex, i, more).text(increments_ == 1);
  if (detail_.all) return print_text(text);
  in_full_ += text;
  summary_ += summary_line(terminal_, i);
  if (in_full) return;
  in_full_.clear();
  print_text(std::exchange(summary_, ""));
}

void explain_text::finish() {
  if (detail_.all || increments_ == 0) return;
  print_text(increments_ <= most_told_in_full ? in_full_ : summary_end(terminal_, increments_));
}

explain_json::explain_json(explained_kernels of, output_file& out)
    : of_(std::move(of)),
      document_(out,
                {{"format", "contct-explain-1"},
                 {"title", of_.what.title},
                 {"kernels", of_.names},
                 {"real_bytes", of_.real_bytes}},
                "increments") {}

void explain_json::write(const explained_increment& i, const explain_addition* more) {
  json out = {{"step", i.what.step},
              {"increment", i.what.number},
              {"fraction_before", i.fraction_before},
              {"fraction", i.what.fraction},
              {"s", i.what.s},
              {"load", load_json(of_.what.geometry, of_.loads, i.what.step, i.what.fraction)},
              {"smin", both_json(of_, i.call.smin, i.other == nullptr ? nullptr : &i.other->smin)},
              {"winner", winner_json(i.call)},
              {"narrowest", narrowest_json(i.call.narrowest)},
              {"left_undone", i.left_undone},
              {"story", story_json(winner_story(i.call))}};
  if (i.apart)
    out["apart"] = {{"field", i.apart->field},
                    {"index", i.apart->index},
                    {of_.names[0], i.apart->leader},
                    {of_.names[1], i.apart->follower}};
  if (more != nullptr) more->put_increment(out, of_, i);
  out["pairs"] = nullptr;
  const bool all = of_.pair == 0;
  document_.add(out, {{"pairs", all ? i.call.pairs.size() : 1, [&](std::size_t k) {
                         return pair_json(of_, i, more, i.call.pairs[all ? k : of_.pair - 1]);
                       }}});
}

void explain_json::finish(std::string_view status, const explained_path& path) {
  json compared = nullptr;
  if (of_.names.size() > 1) compared = agreement_json(path.calls(), path.compared());
  document_.finish({{"lockstep", compared}, {"status", status}});
}

}  // namespace contct::write
