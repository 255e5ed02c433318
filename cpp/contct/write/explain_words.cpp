#include "contct/write/explain_words.hpp"

#include <fmt/format.h>

#include <cmath>

#include "contct/numeric/bits.hpp"

namespace contct::write {
namespace {

/// Nine digits, enough to compare by eye; the bits are given separately.
std::string number(double x) {
  return fmt::format("{:.9g}", x);
}

/// A share of a load in per cent, never rounded to all of it.
std::string per_cent(double share) {
  const std::string text = fmt::format("{:.4g}", 100.0 * share);
  return share < 1.0 && text == "100" ? "nearly 100 %" : text + " %";
}

std::string signed_one(int x) {
  return x > 0 ? "+1" : "-1";
}

sentence about(const listing_line& l, std::string words, std::string equation = {}) {
  return {l.number, std::move(words), std::move(equation)};
}

bool is_separated(const explained_pair& p) {
  return p.isep_before == separated;
}

void tell_stationary(const explained_pair& p, std::vector<sentence>& story) {
  story.push_back(about(listing::stationary, "s = 1 to begin with: the mark for \"no event\"."));
  story.push_back(
      about(listing::check_variable,
            fmt::format("SSCHK = ISEP * ISURF / d* = ({}) * ({}) / {} = {}", signed_one(p.isep_before),
                        signed_one(p.surface), number(p.d_star), number(p.s_chk)),
            "(11)"));
  if (p.way == way_to_s::stationary_event) {
    story.push_back(
        about(listing::if_check_positive,
              fmt::format("SSCHK > 0: the load {}. s = SSCHK * DELTA = {}, so small that it wins over every "
                          "advancing or receding pair.",
                          is_separated(p) ? "pushes the structure against the face" : "lifts it off the face",
                          number(p.s)),
              "(12)"));
  } else {
    story.push_back(about(
        listing::if_check_positive,
        fmt::format("SSCHK is not positive: the load {}. No event; the mark stays.",
                    is_separated(p) ? "moves the structure away from the face" : "keeps the pair closed")));
  }
}

std::string meaning_of_s(const explained_pair& p) {
  const char* const advances = is_separated(p) ? "touches its face" : "leaves its face";
  if (std::isnan(p.s)) return "That is no number, and no event.";
  if (p.s < 0) return "Negative: the structure moves away from this event.";
  if (p.s == 0) return "Zero is no progress, and no event.";
  if (p.s < 1) {
    return fmt::format("{}: it {} at {} of the residual load.", is_separated(p) ? "Advancing" : "Receding",
                       advances, per_cent(p.s));
  }
  if (p.s == 1) return "Exactly at the full load: the listing takes this for no event.";
  return fmt::format("More than 1: the residual load ends before it {}.", advances);
}

void tell_competition(const explained_pair& p, std::vector<sentence>& story) {
  if (!p.at(branch::s_positive).outcome) {
    story.push_back(about(listing::smallest, "s is not greater than 0: not a candidate.", "(6)"));
  } else if (p.took_the_lead()) {
    story.push_back(about(
        listing::smallest,
        fmt::format("0 < s < SMIN = {}: SMIN becomes s; this pair leads.", number(p.smin_before)), "(9)"));
  } else {
    story.push_back(about(listing::smallest,
                          fmt::format("s is not less than SMIN = {}: no change.", number(p.smin_before)),
                          "(9)"));
  }
}

}  // namespace

std::vector<sentence> scale_factor_story(const explained_pair& p) {
  std::vector<sentence> story;
  story.push_back(about(listing::gap,
                        fmt::format("GAP = c - D = {} - ({}) = {}", number(p.c), number(p.d), number(p.gap)),
                        "(5)"));
  if (p.way == way_to_s::no_response) {
    story.push_back(
        about(listing::if_no_response, "d* = 0: the pair does not respond to the residual load."));
    story.push_back(about(listing::no_response, "s = 1: the mark for \"no event\"."));
  } else {
    story.push_back(
        about(listing::if_no_response, fmt::format("d* = {}, not 0: the pair responds.", number(p.d_star))));
    if (p.way == way_to_s::moving) {
      story.push_back(
          about(listing::if_stationary, "|GAP| is not less than EPSGAP = 1E-10: not stationary."));
      story.push_back(
          about(listing::moving, fmt::format("s = GAP / d* = {}. {}", number(p.s), meaning_of_s(p)), "(4)"));
    } else {
      story.push_back(
          about(listing::if_stationary, "|GAP| < EPSGAP = 1E-10: at its face; the pair is stationary."));
      tell_stationary(p, story);
    }
  }
  tell_competition(p, story);
  return story;
}

std::vector<sentence> winner_story(const explained_call& c) {
  std::vector<sentence> story;
  if (c.winner < 0) {
    story.push_back(about(listing::if_no_events,
                          "SMIN is still 1: no event on the way. All of the residual "
                          "load can be applied."));
    story.push_back(about(listing::no_events_return, "RETURN. No pair is toggled."));
    return story;
  }
  story.push_back(about(listing::if_no_events,
                        fmt::format("SMIN = {}, not 1. Pair {} wins.", number(c.smin), c.winner + 1), "(9)"));
  if (c.next < 0) {
    story.push_back({0, "No other pair has an event ahead of it.", {}});
    return story;
  }
  const explained_pair& next = c.pairs[c.next];
  if (c.ulps_ahead == 0) {
    story.push_back({0, fmt::format("Pair {} has the same s, to the bit.", c.next + 1), {}});
    return story;
  }
  const double later = (next.s - c.smin) / c.smin;
  story.push_back({0,
                   fmt::format("Next would be pair {}, s = {}: {}.", c.next + 1, number(next.s),
                               later < rounding_share(c.real_bytes)
                                   ? fmt::format("later by {} ULP, which is rounding", c.ulps_ahead)
                                   : fmt::format("{:.4g} times the load", next.s / c.smin)),
                   {}});
  return story;
}

std::vector<sentence> toggle_story(const explained_call& c, const explained_pair& p) {
  std::vector<sentence> story;
  const bool within = p.at(branch::within_epsmul).outcome;
  const std::string diff = fmt::format("DIFF = |s - SMIN| / SMIN = {:.4g}", p.diff);
  story.push_back(about(listing::diff, p.pair == c.winner ? "DIFF = 0: s is SMIN." : diff + "."));
  if (!within) {
    story.push_back(about(listing::if_within, "Not less than EPSMUL = 1/256: not toggled."));
    return story;
  }
  story.push_back(about(listing::if_within, "Less than EPSMUL = 1/256: toggled."));
  story.push_back(about(listing::if_separated, is_separated(p) ? "ISEP = 1: it was separated."
                                                               : "ISEP is not 1: it was in contact."));
  story.push_back(is_separated(p) ? about(listing::make, "ISEP = -1: in contact. Make.")
                                  : about(listing::break_, "ISEP = 1: separated. Break."));
  switch (p.why) {
    case why_toggled::too_early:
      story.push_back(
          {0,
           fmt::format(
               "TAKEN ALONG: {}, {:.3g} from its face. Its own s is {}; the listing does not wait for "
               "it.",
               is_separated(p) ? "it is closed before it touches"
                               : "it is let go before it comes to its face",
               p.distance, number(p.s)),
           {}});
      break;
    case why_toggled::by_mark:
      story.push_back({0,
                       fmt::format("BY ITS MARK: this pair has no event. Its s = 1 only says so, but SMIN is "
                                   "so near to 1 that the mark lies within EPSMUL. It is {:.3g} from its "
                                   "face. The paper's step 14 does not do this.",
                                   p.distance),
                       {}});
      break;
    case why_toggled::same_moment:
      story.push_back({0, "It comes to its face at the same moment as the winner.", {}});
      break;
    default:
      break;
  }
  return story;
}

std::string_view kind_of_contact(const explained_pair& p) {
  switch (p.way) {
    case way_to_s::no_response:
      return "no response";
    case way_to_s::moving:
      return is_separated(p) ? "advancing" : "receding";
    default:
      return "stationary";
  }
}

std::string_view name_of(why_toggled why) {
  switch (why) {
    case why_toggled::winner:
      return "winner";
    case why_toggled::same_moment:
      return "same moment";
    case why_toggled::too_early:
      return "too early";
    case why_toggled::by_mark:
      return "by its mark";
    default:
      return "not toggled";
  }
}

std::uint64_t ulps_apart(double first, double second, int real_bytes) {
  return real_bytes == 4 ? ulps_between(static_cast<float>(first), static_cast<float>(second))
                         : ulps_between(first, second);
}

std::string side_by_side_words(std::string_view first_name, double first, std::string_view second_name,
                               double second, int real_bytes) {
  const std::string words = fmt::format("{} {}, {} ", first_name, hexfloat(first), second_name);
  if (same_bits(first, second)) return words + "equal to the bit";
  const std::string apart = std::isnan(first) != std::isnan(second)
                                ? "one is NaN"
                                : fmt::format("{} ULP apart", ulps_apart(first, second, real_bytes));
  return words + fmt::format("{}: {}", hexfloat(second), apart);
}

}  // namespace contct::write
