#include "contct/text/memory.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <limits>

namespace contct {

std::int64_t memory_limit() {
  const std::int64_t pages = sysconf(_SC_PHYS_PAGES);
  const std::int64_t bytes = sysconf(_SC_PAGESIZE);
  return pages <= 0 || bytes <= 0 ? std::numeric_limits<std::int64_t>::max() : pages / 4 * 3 * bytes;
}

std::string bytes_words(std::int64_t bytes) {
  constexpr double mib = 1 << 20;
  constexpr double gib = 1 << 30;
  const auto amount = static_cast<double>(bytes);
  const double shown = amount >= gib ? amount / gib : amount / mib;
  const bool whole = amount >= 10 * mib && amount < gib;
  std::array<char, 32> words{};
  (void)std::snprintf(words.data(), words.size(), "%.*f %s", whole ? 0 : 1, shown,
                      amount >= gib ? "GiB" : "MiB");
  return words.data();
}

}  // namespace contct
