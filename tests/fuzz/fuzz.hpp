// What the fuzzers share: an input as text, and the checks on every refusal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace contct::fuzz {

/// A fuzzer's input as text; it lives as long as `data`.
[[nodiscard]] inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// End the program, which libFuzzer reports with the input, unless `holds`. `words` say what was expected,
/// `found` what there was.
void require(bool holds, std::string_view words, std::string_view found = {});

/// Call `read`; false where it refuses its input. A refusal is an input_error of one line without control
/// characters, not longer than a message may be; anything else that is thrown ends the program.
bool is_read(const std::function<void()>& read);

/// The parts of an input that the marker, on a line of its own, separates: at most `most`, the last one with
/// the rest. For readers of several files.
[[nodiscard]] std::vector<std::string_view> parts_of(std::string_view text, std::size_t most);

}  // namespace contct::fuzz
