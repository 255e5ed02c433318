// How much memory a structure may take.
#pragma once

#include <cstdint>

#include "contct/rooms.hpp"

namespace contct::read {

/// Bytes: what CONTCT_MEMORY_MIB in the environment says, in MiB, or three quarters of what the machine has.
/// Throws input_error when the variable is not a whole number of 1 or more.
[[nodiscard]] std::int64_t memory_limit();

}  // namespace contct::read
