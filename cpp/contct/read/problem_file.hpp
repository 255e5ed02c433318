// Reading problem files (TOML).
#pragma once

#include <string>
#include <string_view>

#include "contct/model/problem.hpp"
#include "contct/read/toml_reader.hpp"
#include "contct/text/input_text.hpp"

namespace contct {

/// Read and check the problem in the file at `path`; "-" is standard input.
/// Throws input_error: nothing is half-accepted. A number means the shortest decimal that reads as its
/// double; one that is written as another is in problem::warnings. `allowed`: where files may be that it
/// names.
[[nodiscard]] problem read_problem(const std::string& path, reach allowed = reach::own_folder);

/// The same for text already in memory; `file` is its name in messages.
[[nodiscard]] problem parse_problem(std::string_view text, std::string_view file,
                                    reach allowed = reach::own_folder);

}  // namespace contct
