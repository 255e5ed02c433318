// Joins and compares words, and escapes text from a file or a person for markup, messages and terminals.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contct {

/// Joins `words`, with `between` in between. fmt::join does the same, but takes half a second to compile in
/// each file that uses it.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between);

/// "1 node", "3 nodes", "2 mismatches".
[[nodiscard]] std::string counted(std::size_t n, std::string_view what);

/// `text` with ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string_view text);

/// A character and its replacement.
struct escape {
  char character;
  std::string_view text;
};
[[nodiscard]] std::string escaped(std::string_view text, std::span<const escape> escapes);

/// Escapes text between tags and in quoted attributes of HTML and XML. Characters that `terminal_text`
/// escapes become U+FFFD, because XML 1.0 does not allow all of them; tabs and line ends are kept.
[[nodiscard]] std::string markup_text(std::string_view text);

/// Escapes text so that it has no effect on a terminal: \xNN replaces every byte of a control character (C0,
/// DEL, C1), of a mark that reorders text (U+202A to U+202E, U+2066 to U+2069), and of bytes that are not
/// UTF-8. Line ends are kept.
[[nodiscard]] std::string terminal_text(std::string_view text);

/// As `terminal_text`, but for one line: escapes line ends too, and shows at most the first `longest` bytes,
/// cut between characters, then "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 60);

/// As `terminal_text`, for a whole title or name: blanks replace line ends and tabs.
[[nodiscard]] std::string on_one_line(std::string_view text);

/// A share in per cent: "3 %", "0.0001 %".
[[nodiscard]] std::string percent_words(double share);

/// `printable` in quotation marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// A field or a line of a file for a message. If it looks like numbers or has at most 3 bytes: its beginning,
/// in quotation marks. Otherwise only its length, "a word of 5 bytes", because a file that a problem names
/// may contain text that a message must not reveal.
[[nodiscard]] std::string field_words(std::string_view text, std::string_view kind = "a word");

/// JSON with \uNNNN for the characters that `terminal_text` escapes, which occur only in its strings.
[[nodiscard]] std::string json_escaped(std::string_view json);

/// A JSON value as text, indented by `indent` blanks, or on one line if it is negative. Bytes that are not
/// UTF-8 become U+FFFD.
template <class Json>
[[nodiscard]] std::string json_text(const Json& value, int indent = -1) {
  return json_escaped(value.dump(indent, ' ', false, Json::error_handler_t::replace));
}

/// " (did you mean \"stiffness\"?)" with the nearest of `known`, at most a third of its letters wrong; the
/// first of equally near words. Empty if no word is that near.
[[nodiscard]] std::string did_you_mean(std::string_view found, std::span<const std::string> known);

}  // namespace contct
