// Reads problem files (TOML).
#pragma once

#include <string>
#include <string_view>

#include "contct/read/toml_reader.hpp"
#include "contct/structure/problem.hpp"
#include "contct/text/input_text.hpp"

namespace contct {

/// Reads and checks the problem in the file at `path`; "-" is standard input. Throws input_error if anything
/// in the file is not allowed. A number means the shortest decimal that reads as its double;
/// problem::warnings names other numbers. `allowed`: where the files may be that the problem file names.
[[nodiscard]] problem read_problem(const std::string& path, reach allowed = reach::own_folder);

/// Reads and checks the problem in `text`, as read_problem does; `file` is the name of the text in messages.
[[nodiscard]] problem parse_problem(std::string_view text, std::string_view file,
                                    reach allowed = reach::own_folder);

}  // namespace contct
