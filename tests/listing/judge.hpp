// An undo, carried out and judged.
#pragma once

#include <string>

#include "listing/errata.hpp"
#include "listing/outcome.hpp"

namespace contct_test {

/// What is seen when `u` is carried out on the listing. "source-only" when the battery notices
/// nothing and the checksum does. Throws std::runtime_error when the undo does not apply, or when
/// its compiler options spoil the untouched listing as well.
outcome carry_out(const undo& u, const std::string& listing);

/// What was seen, in words.
std::string in_words(const outcome& seen);

/// Empty when `seen` is what `u` expects; else what is wrong.
std::string objection(const undo& u, const outcome& seen);

}  // namespace contct_test
