#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "contct/write/explain.hpp"
#include "contct/write/words.hpp"

namespace contct {
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
