// What makes bash, zsh and fish complete the words of contct, from what the parser knows.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace contct {

[[nodiscard]] std::string bash_completion(const CLI::App& program);
[[nodiscard]] std::string zsh_completion(const CLI::App& program);
[[nodiscard]] std::string fish_completion(const CLI::App& program);

/// Add `contct completion`.
void add_completion(CLI::App& program);

}  // namespace contct
