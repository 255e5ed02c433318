// The numbers of a problem file and where they stand.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

namespace contct {

/// A number in a file, and where it stands.
struct written_number {
  std::string key;  ///< "step[1].point[2].w"
  double value = 0;
  bool is_whole = false;
  int line = 0, column = 0, length = 0;  ///< from 1, in code points
  std::string_view literal = {};         ///< as it stands there
  bool is_shortest = true;               ///< is the literal the shortest decimal of its double?
};

/// All finite numbers of a document, in the order in which they stand. `text` is the document's.
[[nodiscard]] std::vector<written_number> numbers_in(const toml::table& document, std::string_view text);

/// A warning for each number of the document, `text` in the file `file`, that is not the shortest decimal of
/// its double, in the order in which they stand; of many, for the first ten, and how many there are.
[[nodiscard]] std::vector<std::string> rounding_warnings(const toml::table& document, std::string_view text,
                                                         std::string_view file);

}  // namespace contct
