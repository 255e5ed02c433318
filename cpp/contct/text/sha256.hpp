// SHA-256 (FIPS 180-4): identifies the files of a report.
#pragma once

#include <string>
#include <string_view>

namespace contct {

/// As 64 hexadecimal digits.
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace contct
