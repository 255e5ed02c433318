// What the listing did in a call, in sentences, each with the line of fortran/contct.f that did it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contct/path/path_observers.hpp"

namespace contct {

/// A sentence about a line of fortran/contct.f.
struct sentence {
  listing_line at;  ///< number 0: no line
  std::string words;
  std::string equation{};  ///< of the paper: "(4)", "lemma 2"; or empty
};
inline constexpr listing_line no_line{0, {}};

/// "advancing", "receding", "stationary" or "no response".
[[nodiscard]] std::string_view kind_name(way_to_s way, bool is_separated);
[[nodiscard]] inline std::string_view kind_name(const explained_pair& p) {
  return kind_name(p.way, p.isep_before == separated);
}
/// "winner", "too early", ..
[[nodiscard]] std::string_view name_of(why_toggled why);

/// How a pair came to its s: the body of the DO 10 loop.
[[nodiscard]] std::vector<sentence> scale_factor_story(const explained_pair& p);

/// Which pair won, and by how much: from SMIN to the IF that returns.
[[nodiscard]] std::vector<sentence> winner_story(const explained_call& c);

/// Whether a pair was toggled, and why: the body of the DO 30 loop. The call had an event.
[[nodiscard]] std::vector<sentence> toggle_story(const explained_call& c, const explained_pair& p);

}  // namespace contct
