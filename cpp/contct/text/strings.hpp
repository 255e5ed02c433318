// Words joined and compared, and text from a file or a person made safe for markup and for messages.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::text {

/// `words` with `between` between each two of them. fmt::join does the same, and takes half a second to
/// compile wherever it is used.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between);

/// A character, and what is written for it.
struct escape {
  char character;
  std::string_view text;
};
[[nodiscard]] std::string escaped(std::string_view text, std::span<const escape> escapes);

/// Text for between the tags and in the quoted attributes of HTML and XML. Control characters, which XML 1.0
/// does not allow, become U+FFFD; tabs and line ends stay.
[[nodiscard]] std::string markup_text(std::string_view text);

/// Text for a one-line message: every control character as \xNN, and at most the first `longest` bytes, cut
/// between characters, with "..." behind them.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 60);

/// The same in quotation marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// The least number of edits between two words (Damerau-Levenshtein): a character inserted, deleted or
/// replaced, or two neighbours swapped. Case does not count.
[[nodiscard]] int edits_between(std::string_view a, std::string_view b);

/// " (did you mean \"stiffness\"?)": the nearest of `known`, the first of equals, with at most a third of its
/// letters wrong. Empty where none is near.
[[nodiscard]] std::string did_you_mean(std::string_view found, std::span<const std::string> known);

}  // namespace contct::text
