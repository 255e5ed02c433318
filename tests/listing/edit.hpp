// The text of the listing, edited.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "listing/errata.hpp"

namespace contct_test {

/// The listing with every replacement made. Throws std::runtime_error when a `from` does not
/// occur exactly once, or lies in a comment: undoing an erratum has to touch a statement.
std::string edited(std::string listing, const std::vector<replacement>& replacements);

/// The text with every run of blanks and line ends made one blank: as the OCR shows it.
std::string in_one_line(std::string_view text);

}  // namespace contct_test
