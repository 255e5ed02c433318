// The numbers of a problem file as they are written, for exact arithmetic.
#pragma once

#include <toml++/toml.h>

#include <string_view>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct::read {

/// All such numbers of a document, `text` in the file `file`, each value once. Throws input_error with both
/// places where two literals read as the same double but are different numbers, and for a number that is not
/// 0 but reads as 0. toml++ itself refuses reals of more than 128 characters.
[[nodiscard]] std::vector<written_number> written_numbers(const toml::table& document, std::string_view text,
                                                          std::string_view file);

}  // namespace contct::read
