// Words joined and compared, and text from a file or a person made safe for markup and for messages.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contct {

/// `words` with `between` between each two of them. fmt::join does the same, and takes half a second to
/// compile wherever it is used.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between);

/// "1 node", "3 nodes", "2 mismatches".
[[nodiscard]] std::string counted(std::size_t n, std::string_view what);

/// Without capitals, of ASCII.
[[nodiscard]] std::string lower_case(std::string_view text);

/// A character and its replacement.
struct escape {
  char character;
  std::string_view text;
};
[[nodiscard]] std::string escaped(std::string_view text, std::span<const escape> escapes);

/// Text for between the tags and in the quoted attributes of HTML and XML. Characters that `terminal_text`
/// escapes become U+FFFD, since XML 1.0 does not allow all of them; tabs and line ends stay.
[[nodiscard]] std::string markup_text(std::string_view text);

/// Text without effect on a terminal: \xNN replaces every byte of a control character (C0, DEL, C1), of a
/// mark that reorders what is written (U+202A to U+202E, U+2066 to U+2069), and of bytes that are not UTF-8.
/// Line ends stay.
[[nodiscard]] std::string terminal_text(std::string_view text);

/// The same for one line: line ends too are escaped, and at most the first `longest` bytes are shown, cut
/// between characters, followed by "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 60);

/// The same for all of a title or a name: blanks replace line ends and tabs.
[[nodiscard]] std::string on_one_line(std::string_view text);

/// A share in per cent: "3 %", "0.0001 %".
[[nodiscard]] std::string percent_words(double share);

/// `printable` in quotation marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A field or a line of a file for a message: the beginning, in quotation marks, of what looks like numbers
/// or has at most 3 bytes; otherwise only how long it is, "a word of 5 bytes". A file that a problem names
/// may hold text that the message must not reveal.
[[nodiscard]] std::string field_words(std::string_view text, std::string_view kind = "a word");

/// JSON in which \uNNNN replaces characters that `terminal_text` escapes: they occur only in its strings.
[[nodiscard]] std::string json_escaped(std::string_view json);

/// A JSON value as text, indented by so many blanks or on one line. Bytes that are not UTF-8 become U+FFFD.
template <class Json>
[[nodiscard]] std::string json_text(const Json& value, int indent = -1) {
  return json_escaped(value.dump(indent, ' ', false, Json::error_handler_t::replace));
}

/// " (did you mean \"stiffness\"?)": the nearest of `known`, the first of equals, with at most a third of its
/// letters wrong. Empty where none is near.
[[nodiscard]] std::string did_you_mean(std::string_view found, std::span<const std::string> known);

}  // namespace contct
