#include "contct/numeric/bits.hpp"

#include <cstdio>

namespace contct::numeric {

std::string hexfloat(double x) {
  char text[40];
  // printf, and not to_chars: %a writes the 0x that every language reads back.
  const int length = std::snprintf(text, sizeof text, "%a", x);
  return {text, static_cast<std::size_t>(length)};
}

}  // namespace contct::numeric
