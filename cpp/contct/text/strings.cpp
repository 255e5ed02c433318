#include "contct/text/strings.hpp"

#include <algorithm>

namespace contct::text {
namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

/// Does a character of UTF-8 go on with this byte?
bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
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
  std::string allowed;
  for (const char& c : text) {
    const bool forbidden = is_control(c) && c != '\t' && c != '\n' && c != '\r';
    allowed += forbidden ? "\xEF\xBF\xBD" : std::string_view(&c, 1);
  }
  return escaped(allowed, references);
}

std::string printable(std::string_view text, std::size_t longest) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::size_t end = std::min(text.size(), longest);
  while (end > 0 && end < text.size() && continues_character(text[end])) --end;
  std::string shown;
  for (const char c : text.substr(0, end)) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_control(c)) {
      shown.append("\\x").append(1, digits[byte / 16]).append(1, digits[byte % 16]);
    } else {
      shown += c;
    }
  }
  return end < text.size() ? shown + "..." : shown;
}

std::string in_quotes(std::string_view text) {
  return "\"" + printable(text) + "\"";
}

int edits_between(std::string_view a, std::string_view b) {
  const auto lower = [](char ch) { return ch >= 'A' && ch <= 'Z' ? static_cast<char>(ch - 'A' + 'a') : ch; };
  // edits[i][j]: from the first i characters of a to the first j of b.
  std::vector<std::vector<int>> edits(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = static_cast<int>(i);
  for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      const int replaced = edits[i - 1][j - 1] + (same ? 0 : 1);
      edits[i][j] = std::min({replaced, edits[i - 1][j] + 1, edits[i][j - 1] + 1});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  }
  return edits[a.size()][b.size()];
}

std::string did_you_mean(std::string_view found, std::span<const std::string> known) {
  constexpr std::size_t longest_word = 64;  // the table of edits grows with its square
  if (found.size() > longest_word) return "";
  std::string_view nearest;
  int least = 0;
  for (const std::string& k : known) {
    const int edits = edits_between(found, k);
    const int allowed = std::max(1, static_cast<int>(k.size()) / 3);
    if (edits > allowed || edits >= static_cast<int>(k.size())) continue;
    if (!nearest.empty() && edits >= least) continue;
    nearest = k;
    least = edits;
  }
  return nearest.empty() ? "" : " (did you mean \"" + std::string(nearest) + "\"?)";
}

}  // namespace contct::text
