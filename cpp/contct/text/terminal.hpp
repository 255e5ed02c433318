// The properties of the terminal, and text wrapped to its width.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace contct {

/// How to print to standard output.
struct terminal {
  int width = 80;      ///< columns
  bool color = false;  ///< ANSI colours are understood and wanted
};

/// Look at standard output: a terminal gives its own width, anything else has 80 columns unless
/// COLUMNS says otherwise. Colour only on a terminal, and never under NO_COLOR or TERM=dumb.
[[nodiscard]] terminal look_at_terminal();

enum class paint { good, bad, quiet, strong };

/// `text`, escaped by `terminal_text`, in colour if `t` has colours.
[[nodiscard]] std::string painted(const terminal& t, paint p, std::string_view text);

/// As `terminal_text`, but the codes of `painted` stay.
[[nodiscard]] std::string shown_in_colour(std::string_view text);

/// Items joined by "; ", in lines of at most `width` bytes. An item longer than a line is broken at blanks; a
/// word longer than a line has one of its own.
[[nodiscard]] std::vector<std::string> wrap(const std::vector<std::string>& items, int width);

}  // namespace contct
