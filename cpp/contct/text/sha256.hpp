// SHA-256 (FIPS 180-4), which identifies files in reports.
#pragma once

#include <string>
#include <string_view>

namespace contct {

/// The hash of `bytes` as 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace contct
