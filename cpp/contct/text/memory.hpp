#pragma once

#include <cstdint>
#include <string>

namespace contct {

/// The bytes that a run may use: three quarters of the machine's memory.
[[nodiscard]] std::int64_t memory_limit();

/// A size in words: "1.5 GiB", "12 MiB".
[[nodiscard]] std::string bytes_words(std::int64_t bytes);

}  // namespace contct
