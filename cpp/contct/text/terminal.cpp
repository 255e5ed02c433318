#include "contct/text/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

#include "contct/text/strings.hpp"

namespace contct {
namespace {

/// The value of an environment variable; empty if the variable is not set.
std::string_view environment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? std::string_view() : value;
}

/// The code of each `paint`, then the code that ends a colour.
constexpr std::array<std::string_view, 5> codes = {"\033[32m", "\033[1;31m", "\033[2m", "\033[1m", "\033[0m"};

/// The colour code at the start of `text`; empty if there is none.
std::string_view leading_code(std::string_view text) {
  const auto* const found =
      std::ranges::find_if(codes, [text](std::string_view c) { return text.starts_with(c); });
  return found == codes.end() ? std::string_view() : *found;
}

}  // namespace

terminal look_at_terminal() {
  constexpr int narrowest = 40;
  constexpr int widest = 160;
  terminal t;
  const bool interactive = isatty(STDOUT_FILENO) != 0;
  winsize size{};
  if (const std::string_view columns = environment("COLUMNS"); !columns.empty()) {
    if (std::from_chars(columns.data(), columns.data() + columns.size(), t.width).ec != std::errc{})
      t.width = 80;
  } else if (interactive && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    t.width = size.ws_col;
  }
  t.width = t.width <= 0 ? 80 : std::clamp(t.width, narrowest, widest);
  const std::string_view kind = environment("TERM");
  t.color = interactive && environment("NO_COLOR").empty() && !kind.empty() && kind != "dumb";
  return t;
}

std::string painted(const terminal& t, paint p, std::string_view text) {
  if (!t.color) return terminal_text(text);
  return std::string(codes[static_cast<std::size_t>(p)]).append(terminal_text(text)).append(codes.back());
}

std::string shown_in_colour(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::string_view code = leading_code(text);
    const std::size_t plain = code.empty() ? text.find('\033', 1) : 0;
    out.append(code).append(terminal_text(text.substr(0, plain)));
    text.remove_prefix(code.empty() ? std::min(plain, text.size()) : code.size());
  }
  return out;
}

std::vector<std::string> wrap(const std::vector<std::string>& items, int width) {
  const std::size_t columns = width;
  std::vector<std::string> lines;
  for (std::string item : items) {
    if (!lines.empty() && lines.back().size() + 2 + item.size() <= columns) {
      lines.back() += "; " + item;
      continue;
    }
    while (item.size() > columns) {
      std::size_t blank = item.rfind(' ', columns);
      if (blank == std::string::npos || blank == 0) blank = item.find(' ', columns);
      if (blank == std::string::npos) break;
      lines.push_back(item.substr(0, blank));
      item.erase(0, blank + 1);
    }
    lines.push_back(item);
  }
  return lines;
}

}  // namespace contct
