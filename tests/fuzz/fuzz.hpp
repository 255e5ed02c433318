// Functions of all fuzzers: an input as text, and the checks of every refusal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace contct::fuzz {

/// Returns a fuzzer's input as text, which is valid as long as `data`.
[[nodiscard]] inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the program unless `holds`, so that libFuzzer reports the input. The message has `words`, which is
/// the expectation, and `found`.
void require(bool holds, std::string_view words, std::string_view found = {});

/// Calls `read`, and returns false if `read` refuses the input. A refusal must be an input_error of one line
/// with a limited length and without control characters. Any other exception ends the program.
bool is_read(const std::function<void()>& read);

/// Splits an input at lines with the marker into at most `most` parts, one for each file of a reader. The
/// last part has the rest.
[[nodiscard]] std::vector<std::string_view> parts_of(std::string_view text, std::size_t most);

}  // namespace contct::fuzz
