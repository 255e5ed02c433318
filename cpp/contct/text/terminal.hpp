// The properties of the terminal, and text wrapped to its width.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contct {

struct terminal {
  int width = 80;      ///< columns
  bool color = false;  ///< true: print ANSI colours
};

/// Finds out how to print to standard output. The width is COLUMNS if set, else the terminal's, else 80
/// columns. Colours are used only on a terminal, and not under NO_COLOR or TERM=dumb.
[[nodiscard]] terminal look_at_terminal();

enum class paint { good, bad, quiet, strong };

/// Returns `text`, escaped by `terminal_text`, in the style `p` if `t` has colours.
[[nodiscard]] std::string painted(const terminal& t, paint p, std::string_view text);

/// As `terminal_text`, but keeps the codes of `painted`.
[[nodiscard]] std::string shown_in_colour(std::string_view text);

/// Joins items by "; " in lines of at most `width` bytes. An item longer than a line is broken at blanks; a
/// word longer than a line has a line to itself.
[[nodiscard]] std::vector<std::string> wrap(const std::vector<std::string>& items, int width);

}  // namespace contct
