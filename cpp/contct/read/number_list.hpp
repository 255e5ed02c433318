// Which nodes or elements: [1, 3, 5], "2..20" or "all".
#pragma once

#include <string_view>
#include <vector>

#include "contct/read/toml_reader.hpp"

namespace contct {

/// Read the list under `key`: numbers from 1 to `count` in the file, from 0 in the answer, in the
/// order given. "all" gives every one of them. A number that stands twice is refused.
[[nodiscard]] std::vector<int> read_numbers(const table_reader& table, std::string_view key, int count);

}  // namespace contct
