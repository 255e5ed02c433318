#include "contct/text/markup.hpp"

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

std::string markup_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '>') {
      safe += "&gt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else if (is_control(c) && c != '\t' && c != '\n' && c != '\r') {
      safe += "\xEF\xBF\xBD";
    } else {
      safe += c;
    }
  }
  return safe;
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

}  // namespace contct::text
