// The program's standard streams, and what goes wrong with them.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "contct/rooms.hpp"

namespace contct::app {

/// Take the place of standard streams that are closed, so that no file of ours gets their number
/// and, with it, what is printed.
void hold_standard_streams();

/// "contct: ..." on standard error. Where nobody can be told, the exit status still tells.
template <class... Arguments>
void complain(fmt::format_string<Arguments...> words, Arguments&&... arguments) {
  const std::string line = "contct: " + fmt::format(words, std::forward<Arguments>(arguments)...) + "\n";
  (void)std::fputs(line.c_str(), stderr);
}

}  // namespace contct::app
