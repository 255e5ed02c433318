#include "contct/text/memory.hpp"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include "contct/text/input_text.hpp"

namespace contct::text {

std::int64_t memory_limit() {
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t mib = std::int64_t{1} << 20;
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets variables
  if (const char* const said = std::getenv("CONTCT_MEMORY_MIB"); said != nullptr) {
    const std::int64_t limit = number_in<std::int64_t>(said).value_or(0);
    if (limit < 1 || limit > most / mib)
      throw input_error("CONTCT_MEMORY_MIB: found " + in_quotes(said) +
                        "; allowed: a whole number of MiB, 1 or more");
    return limit * mib;
  }
  const std::int64_t pages = sysconf(_SC_PHYS_PAGES);
  const std::int64_t bytes = sysconf(_SC_PAGESIZE);
  return pages <= 0 || bytes <= 0 ? most : pages / 4 * 3 * bytes;
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

}  // namespace contct::text
