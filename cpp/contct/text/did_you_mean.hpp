// The known word nearest to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "contct/rooms.hpp"

namespace contct::text {

/// The least number of edits between two words (Damerau-Levenshtein): a character inserted, deleted or
/// replaced, or two neighbours swapped. Case does not count.
[[nodiscard]] int edits_between(std::string_view a, std::string_view b);

/// The nearest of `known`, the first of equals, with at most a third of its letters wrong. Empty where none
/// is near.
[[nodiscard]] std::string_view nearest(std::string_view found, std::span<const std::string> known);

/// " (did you mean \"stiffness\"?)", or nothing.
[[nodiscard]] std::string did_you_mean(std::string_view found, std::span<const std::string> known);

}  // namespace contct::text
