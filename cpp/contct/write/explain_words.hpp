// Sentences on what the listing did, each with the line that did it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "contct/compare/explanation.hpp"

namespace contct::write {

/// A sentence about a line of fortran/contct.f.
struct sentence {
  int line = 0;  ///< 0: no line
  std::string words;
  std::string equation;  ///< of the paper: "(4)", "lemma 2"; or empty
};

/// How pair `p` came to its s: the body of the DO 10 loop.
[[nodiscard]] std::vector<sentence> scale_factor_story(const explained_pair& p);

/// Which pair won, and by how much: from SMIN to the IF that returns.
[[nodiscard]] std::vector<sentence> winner_story(const explained_call& c);

/// Whether pair `p` was toggled, and why: the body of the DO 30 loop. `c` had an event.
[[nodiscard]] std::vector<sentence> toggle_story(const explained_call& c, const explained_pair& p);

/// "advancing", "receding", "stationary", "no response".
[[nodiscard]] std::string_view kind_of_contact(const explained_pair& p);

/// "winner", "same moment", "too early", "by its mark", "not toggled".
[[nodiscard]] std::string_view name_of(why_toggled why);

/// How far two numbers of kernels of `real_bytes` are apart in ULP.
[[nodiscard]] std::uint64_t ulps_apart(double first, double second, int real_bytes);

/// "fortran 0x1p-2, cpp equal to the bit", or by how many ULP they differ.
[[nodiscard]] std::string side_by_side_words(std::string_view first_name, double first,
                                             std::string_view second_name, double second, int real_bytes);

}  // namespace contct::write
