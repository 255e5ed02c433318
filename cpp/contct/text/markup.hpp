// Text from a file or a person, made safe for markup and for messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "contct/rooms.hpp"

namespace contct::text {

/// Text for between the tags and in the quoted attributes of HTML and XML. Control characters, which XML 1.0
/// does not allow, become U+FFFD; tabs and line ends stay.
[[nodiscard]] std::string markup_text(std::string_view text);

/// Text for a one-line message: every control character as \xNN, and at most the first `longest` bytes, cut
/// between characters, with "..." behind them.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 60);

/// The same in quotation marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace contct::text
