// The manual page, from what the parser knows.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace contct {

/// contct(1), in the man macros of roff.
[[nodiscard]] std::string manual_page(const CLI::App& program);

/// Add `contct man`.
void add_man(CLI::App& program);

}  // namespace contct
