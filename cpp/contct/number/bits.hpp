// Equality to the bit, and distance in units in the last place.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <type_traits>

namespace contct {

template <class Real>
using bits_of = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

/// True if a and b have the same bits, or if both are NaN; -0.0 and +0.0 differ.
template <class Real>
[[nodiscard]] inline bool same_bits(Real a, Real b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
  return std::bit_cast<bits_of<Real>>(a) == std::bit_cast<bits_of<Real>>(b);
}

/// The position of x in the ascending sequence of all floating-point numbers: neighbours differ by 1, and the
/// position of -0.0 is one below that of +0.0.
template <class Real>
[[nodiscard]] inline std::int64_t place_of(Real x) {
  using bits = bits_of<Real>;
  constexpr bits sign = bits{1} << (8 * sizeof(Real) - 1);
  const bits b = std::bit_cast<bits>(x);
  return (b & sign) != 0 ? -static_cast<std::int64_t>(b & ~sign) - 1 : static_cast<std::int64_t>(b);
}

/// The distance of a and b in units in the last place; 0 if both are NaN, and the largest std::uint64_t if
/// only one of them is NaN.
template <class Real>
[[nodiscard]] inline std::uint64_t ulps_between(Real a, Real b) {
  if (same_bits(a, b)) return 0;
  if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<std::uint64_t>::max();
  const std::int64_t p = place_of(a);
  const std::int64_t q = place_of(b);
  return p > q ? static_cast<std::uint64_t>(p) - static_cast<std::uint64_t>(q)
               : static_cast<std::uint64_t>(q) - static_cast<std::uint64_t>(p);
}

/// The exact value of x as text: "0x1.8p+1", "-0x0p+0", "inf", "nan".
[[nodiscard]] inline std::string hexfloat(double x) {
  char text[40];
  // %a writes the prefix 0x, which other languages need to read the text; to_chars omits the prefix.
  const int length = std::snprintf(text, sizeof text, "%a", x);
  return {text, static_cast<std::size_t>(length)};
}

/// The decimal with the fewest digits that reads as `x`.
[[nodiscard]] inline std::string short_decimal(double x) {
  char text[40];
  for (int digits = 1; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    (void)std::snprintf(text, sizeof text, "%.*g", digits, x);
    if (same_bits(std::strtod(text, nullptr), x)) break;
  }
  return text;
}

}  // namespace contct
