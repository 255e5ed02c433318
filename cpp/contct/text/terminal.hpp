// What the terminal can show.
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

/// `text` in colour where `t` has it.
[[nodiscard]] std::string painted(const terminal& t, paint p, std::string_view text);

/// Items joined by "; ", in lines of at most `width` columns as far as the words allow: an item longer
/// than a line goes on in the next.
[[nodiscard]] std::vector<std::string> wrap(const std::vector<std::string>& items, int width);

}  // namespace contct
