#include "fuzz/fuzz.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "contct/text/input_text.hpp"

namespace contct::fuzz {

void require(bool holds, std::string_view words, std::string_view found) {
  if (holds) return;
  (void)std::fprintf(stderr, "fuzzer: found otherwise: %.*s: %.*s\n", static_cast<int>(words.size()),
                     words.data(), static_cast<int>(found.size()), found.data());
  std::abort();
}

bool is_read(const std::function<void()>& read) {
  constexpr std::size_t longest_message = 2000;
  try {
    read();
    return true;
  } catch (const input_error& e) {
    const std::string_view message(e.what());
    require(!message.empty(), "a refusal says why");
    require(message.size() <= longest_message, "a refusal is no longer than a message may be", message);
    // A missing file's name is escaped only when the message is printed.
    require(message.find("cannot be read") != std::string_view::npos ||
                std::ranges::none_of(message, [](char c) { return static_cast<unsigned char>(c) < 0x20; }),
            "a refusal has one line, without control characters", message);
    return false;
  }
}

std::vector<std::string_view> parts_of(std::string_view text, std::size_t most) {
  constexpr std::string_view marker = "\n=====\n";
  std::vector<std::string_view> parts;
  for (std::size_t end = 0; parts.size() + 1 < most; text.remove_prefix(end + marker.size())) {
    end = text.find(marker);
    if (end == std::string_view::npos) break;
    parts.push_back(text.substr(0, end + 1));  // the part includes the line end before the marker
  }
  parts.push_back(text);
  return parts;
}

}  // namespace contct::fuzz
