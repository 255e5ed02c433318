// Command lines to start from: under --help, in the manual, and run by the tests as they stand.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::app {

struct example {
  std::string_view command;    ///< "run"
  std::string_view arguments;  ///< what follows it, separated by blanks
  std::string_view text;       ///< what it is good for
};

/// Of one command, or all of them.
[[nodiscard]] std::vector<example> examples_of(std::string_view command = {});

/// "contct run beam.toml"
[[nodiscard]] std::string line_of(const example& e);

}  // namespace contct::app
