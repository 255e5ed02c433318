#include "contct/io/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace contct {
namespace {

bool is_set(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

}  // namespace

terminal look_at_terminal() {
  constexpr int narrowest = 40;
  constexpr int widest = 160;
  terminal t;
  const bool interactive = isatty(STDOUT_FILENO) != 0;
  winsize size{};
  if (is_set("COLUMNS")) {
    t.width = std::atoi(std::getenv("COLUMNS"));
  } else if (interactive && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    t.width = size.ws_col;
  }
  t.width = t.width <= 0 ? 80 : std::clamp(t.width, narrowest, widest);
  const char* const kind = std::getenv("TERM");
  t.color = interactive && !is_set("NO_COLOR") && kind != nullptr && std::string_view(kind) != "dumb";
  return t;
}

std::string painted(const terminal& t, paint p, std::string_view text) {
  if (!t.color) return std::string(text);
  const char* code = "";
  switch (p) {
    case paint::good:
      code = "\033[32m";
      break;
    case paint::bad:
      code = "\033[1;31m";
      break;
    case paint::quiet:
      code = "\033[2m";
      break;
    case paint::strong:
      code = "\033[1m";
      break;
  }
  return std::string(code) + std::string(text) + "\033[0m";
}

}  // namespace contct
