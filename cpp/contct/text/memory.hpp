// How much memory work may take, and amounts of it in words.
#pragma once

#include <cstdint>
#include <string>

#include "contct/rooms.hpp"

namespace contct::text {

/// How many bytes a structure may take: what CONTCT_MEMORY_MIB in the environment says, in MiB, or three
/// quarters of what the machine has. Throws input_error when the variable is not a whole number of 1 or more.
[[nodiscard]] std::int64_t memory_limit();

/// "1.5 GiB", "12 MiB".
[[nodiscard]] std::string bytes_words(std::int64_t bytes);

}  // namespace contct::text
