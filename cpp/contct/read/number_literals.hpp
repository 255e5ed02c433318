// The numbers of a problem file as they are written, for exact arithmetic.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "contct/structure/problem.hpp"

namespace contct::read {

/// All such numbers of a document, `text` in the file `file`, each value once. Throws input_error with both
/// places where two literals read as the same double but are different numbers, and for a number that is not
/// 0 but reads as 0. toml++ itself refuses reals of more than 128 characters.
[[nodiscard]] std::vector<written_number> written_numbers(const toml::table& document, std::string_view text,
                                                          std::string_view file);

/// A number in a file, and where it stands.
struct placed_number {
  std::string key;  ///< "step[1].point[2].w"
  double value = 0;
  bool is_whole = false;
  int line = 0, column = 0, length = 0;  ///< from 1, in code points
};

/// All finite numbers of a document, in the order in which they stand.
[[nodiscard]] std::vector<placed_number> placed_numbers(const toml::table& document, std::string_view text);

}  // namespace contct::read
