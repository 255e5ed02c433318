// Joins and compares words, and escapes text that may contain anything for markup, messages and terminals.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace contct {

/// Joins `words`, with `between` in between. fmt::join would take half a second to compile in each file that
/// uses it.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between);

/// Returns "1 node", "3 nodes", "2 mismatches": a number and the noun `what`, in the plural unless `n` is 1.
[[nodiscard]] std::string counted(std::size_t n, std::string_view what);

/// Cut the first line off `text`, without its end.
std::string_view take_line(std::string_view& text);

/// Without capitals, of ASCII.
[[nodiscard]] std::string lower_case(std::string_view text);

/// A character and its replacement.
struct escape {
  char character;
  std::string_view text;
};
/// Replaces each character of `text` that is in `escapes`.
[[nodiscard]] std::string escaped(std::string_view text, std::span<const escape> escapes);

/// Escapes text between tags and in quoted attributes of HTML and XML. Characters that `terminal_text`
/// escapes become U+FFFD, because XML 1.0 does not allow all of them; tabs and line ends are kept.
[[nodiscard]] std::string markup_text(std::string_view text);

/// Escapes text so that it has no effect on a terminal: \xNN replaces every byte of a control character (C0,
/// DEL, C1), of a mark that reorders text (U+202A to U+202E, U+2066 to U+2069), and of bytes that are not
/// UTF-8. Line ends are kept.
[[nodiscard]] std::string terminal_text(std::string_view text);

/// As `terminal_text`, but for one line: escapes line ends too, and cuts a text of more than `longest` bytes
/// between two characters, with "..." at its end.
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 60);

/// As `terminal_text`, for a whole title or name: blanks replace line ends and tabs.
[[nodiscard]] std::string on_one_line(std::string_view text);

/// A share in per cent: "3 %", "0.0001 %".
[[nodiscard]] std::string percent_words(double share);

/// As `printable`, in quotation marks.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// Describes a field or a line of a file for a message. Quotes the beginning of a text that looks like
/// numbers or has at most 3 bytes. Of any other text tells only the length, "a word of 5 bytes", because a
/// file that a problem names may contain text that a message must not reveal.
[[nodiscard]] std::string field_words(std::string_view text, std::string_view kind = "a word");

/// Replaces the characters of JSON that `terminal_text` escapes, which occur only in strings, by \uNNNN.
[[nodiscard]] std::string json_escaped(std::string_view json);

/// A JSON value as text, indented by `indent` blanks, or on one line if `indent` is negative. Bytes that are
/// not UTF-8 become U+FFFD.
template <class Json>
[[nodiscard]] std::string json_text(const Json& value, int indent = -1) {
  return json_escaped(value.dump(indent, ' ', false, Json::error_handler_t::replace));
}

/// Returns " (did you mean \"stiffness\"?)" with the word of `known` nearest to `found`; of equally near
/// words, the first. Empty if every word needs more edits than a third of its letters.
[[nodiscard]] std::string did_you_mean(std::string_view found, std::span<const std::string> known);

}  // namespace contct
