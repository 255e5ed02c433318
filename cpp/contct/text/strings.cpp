#include "contct/text/strings.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

namespace contct {
namespace {

/// The first UTF-8 character of a text, and its length in bytes; 0 bytes if the text does not begin with one.
struct decoded {
  char32_t character = 0;
  std::size_t bytes = 0;
};

decoded first_character(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  constexpr char32_t least[] = {0, 0, 0x80, 0x800, 0x10000};  // [bytes] the least character of this length
  if (lead < 0xc2 || lead > 0xf4 || bytes > text.size()) return {};
  char32_t character = lead & (0x7fU >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return {};
    character = character << 6U | (byte(i) & 0x3fU);
  }
  const bool surrogate = character >= 0xd800 && character <= 0xdfff;
  if (character < least[bytes] || character > 0x10ffff || surrogate) return {};
  return {character, bytes};
}

/// True for control characters, and for characters that change the direction of the text after them.
bool is_obeyed(char32_t c) {
  const bool control = c < 0x20 || (c >= 0x7f && c <= 0x9f);
  return control || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
}

/// Replaces by `replacement(bytes)` every character of is_obeyed that is not in `kept`, and every byte that
/// is not UTF-8.
template <class Replacement>
std::string replaced(std::string_view text, std::string_view kept, const Replacement& replacement) {
  const auto plain = [](char c) { return c >= ' ' && c <= '~'; };
  const auto first =
      static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), plain) - text.begin());
  std::string out(text.substr(0, first));
  text.remove_prefix(first);
  while (!text.empty()) {
    const decoded d = first_character(text);
    const std::string_view bytes = text.substr(0, std::max<std::size_t>(d.bytes, 1));
    const bool stays = d.bytes > 0 && (!is_obeyed(d.character) || kept.find(bytes) != std::string_view::npos);
    out += stays ? std::string(bytes) : replacement(bytes);
    text.remove_prefix(bytes.size());
  }
  return out;
}

std::string in_hexadecimal(std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text.append("\\x").append(1, digits[byte / 16]).append(1, digits[byte % 16]);
  }
  return text;
}

/// True for a byte of a UTF-8 character after its first byte.
bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// The least number of edits from one word to another (Damerau-Levenshtein). An edit inserts, deletes or
/// replaces a character, or swaps two neighbours.
int edits_between(const std::string& a, const std::string& b) {
  // edits[i][j]: the edits from the first i characters of a to the first j characters of b.
  std::vector<std::vector<int>> edits(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      const int replaced = edits[i - 1][j - 1] + (same ? 0 : 1);
      edits[i][j] = std::min({replaced, edits[i - 1][j] + 1, edits[i][j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[a.size()][b.size()];
}

}  // namespace

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) {
    if (&word != &words.front()) text += between;
    text += word;
  }
  return text;
}

std::string counted(std::size_t n, std::string_view what) {
  return std::to_string(n).append(" ").append(what).append(n == 1 ? "" : what.ends_with("ch") ? "es" : "s");
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::string escaped(std::string_view text, std::span<const escape> escapes) {
  std::string out;
  for (const char& c : text) {
    const auto found = std::ranges::find(escapes, c, &escape::character);
    out += found == escapes.end() ? std::string_view(&c, 1) : found->text;
  }
  return out;
}

std::string markup_text(std::string_view text) {
  constexpr escape references[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  const std::string allowed =
      replaced(text, "\t\n\r", [](std::string_view) { return std::string("\xEF\xBF\xBD"); });
  return escaped(allowed, references);
}

std::string terminal_text(std::string_view text) {
  return replaced(text, "\n", in_hexadecimal);
}

std::string printable(std::string_view text, std::size_t longest) {
  std::size_t end = std::min(text.size(), longest);
  constexpr std::size_t most_back = 3;  // bytes of a UTF-8 character after its first byte
  for (std::size_t i = 0; i < most_back && end > 0 && end < text.size() && continues_character(text[end]);
       ++i)
    --end;
  const std::string line = replaced(text.substr(0, end), "", in_hexadecimal);
  return end < text.size() ? line + "..." : line;
}

std::string on_one_line(std::string_view text) {
  constexpr escape blank[] = {{'\n', " "}, {'\r', " "}, {'\t', " "}};
  return terminal_text(escaped(text, blank));
}

std::string percent_words(double share) {
  constexpr double most_as_a_power = 100.0;
  const double percent = 100.0 * share;
  char text[40];
  (void)std::snprintf(text, sizeof text, percent < most_as_a_power || percent > 1e9 ? "%.2g %%" : "%.0f %%",
                      percent);
  return text;
}

std::string field_words(std::string_view text, std::string_view kind) {
  constexpr std::size_t longest = 32;
  constexpr std::size_t no_secret = 3;
  constexpr std::string_view of_numbers = "0123456789+-.,_eEdDxXpP \t";
  constexpr escape lower[] = {{'A', "a"}, {'F', "f"}, {'I', "i"}, {'N', "n"}, {'+', ""}, {'-', ""}};
  const std::string word = text.size() <= longest ? escaped(text, lower) : "";  // lower case, without signs
  const bool number_like = text.find_first_of("0123456789") < text.size() &&
                           text.find_first_not_of(of_numbers) == std::string_view::npos;
  if (number_like || text.size() <= no_secret || word == "nan" || word == "inf")
    return "\"" + printable(text, longest) + "\"";
  return std::string(kind) + " of " + std::to_string(text.size()) + (text.size() == 1 ? " byte" : " bytes");
}

std::string json_escaped(std::string_view json) {
  return replaced(json, "\n", [](std::string_view bytes) {
    std::array<char, 8> code{};
    (void)std::snprintf(code.data(), code.size(), "\\u%04x",
                        static_cast<unsigned>(first_character(bytes).character));
    return std::string(code.data());
  });
}

std::string in_quotes(std::string_view text) {
  return "\"" + printable(text) + "\"";
}

std::string did_you_mean(std::string_view found, std::span<const std::string> known) {
  constexpr std::size_t longest_word = 64;  // time and memory grow with the square of the length
  if (found.size() > longest_word) return "";
  std::string_view nearest;
  int least = 0;
  for (const std::string& k : known) {
    const int edits = edits_between(lower_case(found), lower_case(k));
    const int allowed = std::max(1, static_cast<int>(k.size()) / 3);
    if (edits > allowed || edits >= static_cast<int>(k.size())) continue;
    if (!nearest.empty() && edits >= least) continue;
    nearest = k;
    least = edits;
  }
  return nearest.empty() ? "" : " (did you mean \"" + std::string(nearest) + "\"?)";
}

}  // namespace contct
