#include "contct/read/memory_limit.hpp"

#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

#include "contct/text/input_text.hpp"

namespace contct::read {
namespace {

constexpr std::int64_t mib = std::int64_t{1} << 20;

std::int64_t limit_from(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1 ||
      value > std::numeric_limits<std::int64_t>::max() / mib)
    throw input_error("CONTCT_MEMORY_MIB: found " + in_quotes(text) +
                      "; allowed: a whole number of MiB, 1 or more");
  return value * mib;
}

}  // namespace

std::int64_t memory_limit() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets variables
  if (const char* const said = std::getenv("CONTCT_MEMORY_MIB"); said != nullptr) return limit_from(said);
  const std::int64_t pages = sysconf(_SC_PHYS_PAGES);
  const std::int64_t bytes = sysconf(_SC_PAGESIZE);
  if (pages <= 0 || bytes <= 0) return std::numeric_limits<std::int64_t>::max();
  return pages / 4 * 3 * bytes;
}

}  // namespace contct::read
