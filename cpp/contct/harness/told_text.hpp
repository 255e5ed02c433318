// What a kernel's unit-26 text tells: the events, and the statement that wrote a wrong line.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "contct/harness/explanation.hpp"

namespace contct {

/// The event of each pair [pairs] that a kernel's unit-26 text reports. Pairs beyond 999, which I3 cannot
/// print, have none.
[[nodiscard]] std::vector<std::optional<change>> told_by(std::string_view text, std::size_t pairs);

/// The statement that is at fault if a kernel writes the text `got` instead of `right`, judged by the first
/// line that differs: the FORMAT if only the form of the numbers differs; line 53 if the node is `last_node`;
/// otherwise the WRITE.
[[nodiscard]] const listing_line& fault_of_text(std::string_view right, std::string_view got, int last_node);

}  // namespace contct
