// Reading problem files (TOML).
#pragma once

#include <string>
#include <string_view>

#include "contct/read/named_files.hpp"
#include "contct/structure/problem.hpp"
#include "contct/text/input_text.hpp"

namespace contct::read {

/// Read and check the problem in the file at `path`; "-" is standard input.
/// Throws input_error: nothing is half-accepted. `keep`: whether problem::written and the like are filled,
/// for exact arithmetic; then it throws as written_numbers does. `allowed`: where files may be that it names.
/// `among`: the ranks that read a matrix by parts, not for exact arithmetic; null: it is read here.
[[nodiscard]] problem read_problem(const std::string& path, literals keep = literals::dropped,
                                   reach allowed = reach::own_folder, distributed::ranks* among = nullptr);

/// The same for text already in memory; `file` is its name in messages.
[[nodiscard]] problem parse_problem(std::string_view text, std::string_view file,
                                    literals keep = literals::dropped, reach allowed = reach::own_folder,
                                    distributed::ranks* among = nullptr);

}  // namespace contct::read
