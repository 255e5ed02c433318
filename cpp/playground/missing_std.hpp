// The parts of C++20 that the rooms use and that libc++ 13 of Debian's Emscripten lacks: algorithms on ranges
// with projections, from range-v3, and conversions of numbers without a locale. Every source of the
// playground includes this file first.
#pragma once

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iterator>
#include <range/v3/algorithm.hpp>
#include <string>
#include <system_error>
#include <type_traits>

// NOLINTBEGIN(cert-dcl58-cpp): these names are the standard's
namespace std {

template <class To, class From>
To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  memcpy(&to, &from, sizeof to);
  return to;
}

template <class Real, enable_if_t<is_floating_point_v<Real>, int> = 0>
from_chars_result from_chars(const char* first, const char* last, Real& value,
                             chars_format format = chars_format::general) {
  if (format == chars_format::hex) {  // strtod needs a prefix 0x and a final zero
    const bool negative = first != last && *first == '-';
    const std::string text = std::string(negative ? "-0x" : "0x").append(first + (negative ? 1 : 0), last);
    char* end = nullptr;
    const double read = strtod(text.c_str(), &end);
    const ptrdiff_t length = end - text.c_str() - 2;
    if (length <= (negative ? 1 : 0)) return {first, errc::invalid_argument};  // only the 0 of the prefix
    value = static_cast<Real>(read);
    return {first + length, errc()};
  }
  const fast_float::from_chars_result r = fast_float::from_chars(first, last, value);
  return {r.ptr, r.ec};
}

inline to_chars_result to_chars(char* first, char* last, const string& text) {
  if (last - first < static_cast<ptrdiff_t>(text.size())) return {last, errc::value_too_large};
  memcpy(first, text.data(), text.size());
  return {first + text.size(), errc()};
}

inline to_chars_result to_chars(char* first, char* last, double value) {
  return to_chars(first, last, fmt::format("{}", value));
}

/// Writes `behind` digits behind the first.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format /*scientific*/,
                                int behind) {
  return to_chars(first, last, fmt::format("{:.{}e}", value, behind));
}

/// Writes the fewest digits that give the number back, as std::to_chars of other builds does.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format format) {
  int behind = 0;
  while (behind < 16 && strtod(fmt::format("{:.{}e}", value, behind).c_str(), nullptr) != value) ++behind;
  return to_chars(first, last, value, format, behind);
}

namespace ranges {

using namespace ::ranges;  // for the names that std::ranges lacks

/// range-v3's function would need a predicate that can also compare elements of the same range.
template <class A, class B, class Predicate = std::equal_to<>>
bool equal(A&& a, B&& b, Predicate predicate = {}) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), predicate);
}

}  // namespace ranges
}  // namespace std
// NOLINTEND(cert-dcl58-cpp)
