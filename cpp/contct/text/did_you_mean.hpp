// What somebody may have meant who mistyped a word: the nearest one that there is.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace contct {

/// The least number of edits that lead from one word to the other (Damerau-Levenshtein): a character put in,
/// left out, or replaced, or two neighbours swapped. Capital letters are not told from small ones.
[[nodiscard]] int edits_between(std::string_view a, std::string_view b);

/// The one of `known` that `found` was meant to be: the nearest, the first of equals, and at most a third of
/// its letters wrong. Empty where none is near.
[[nodiscard]] std::string_view nearest(std::string_view found, std::span<const std::string> known);

/// " (did you mean \"stiffness\"?)", or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view found, std::span<const std::string> known);

}  // namespace contct
