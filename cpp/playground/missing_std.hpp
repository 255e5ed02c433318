// The parts of C++20 that the rooms use and that libc++ 13 of Debian's Emscripten lacks: algorithms on ranges
// with projections, from range-v3, and conversions of numbers without a locale. Every source of the
// playground includes this file first.
#pragma once

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
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
    const bool begins =
        first != last && (isxdigit(static_cast<unsigned char>(first[negative ? 1 : 0])) != 0 ||
                          first[negative ? 1 : 0] == '.');
    if (!begins) return {first, errc::invalid_argument};
    char* end = nullptr;
    value = static_cast<Real>(strtod(text.c_str(), &end));
    return {first + (end - text.c_str()) - 2, errc()};
  }
  const fast_float::from_chars_result r = fast_float::from_chars(first, last, value);
  return {r.ptr, r.ec};
}

/// Writes the fewest digits that give the number back, as std::to_chars of other builds does.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format /*scientific*/) {
  const string text = isfinite(value) ? fmt::format("{:e}", value) : fmt::format("{}", value);
  for (int digits = 0; digits <= 17; ++digits) {
    const string shorter = isfinite(value) ? fmt::format("{:.{}e}", value, digits) : text;
    if (isfinite(value) && strtod(shorter.c_str(), nullptr) != value) continue;
    if (last - first < static_cast<ptrdiff_t>(shorter.size())) break;
    memcpy(first, shorter.data(), shorter.size());
    return {first + shorter.size(), errc()};
  }
  return {last, errc::value_too_large};
}

/// Writes a finite number with `behind` digits behind the first.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format /*scientific*/,
                                int behind) {
  return {fmt::format_to_n(first, last - first, "{:.{}e}", value, behind).out, errc()};
}

/// Writes a number without a format.
inline to_chars_result to_chars(char* first, char* last, double value) {
  const string text = fmt::format("{}", value);
  if (last - first < static_cast<ptrdiff_t>(text.size())) return {last, errc::value_too_large};
  memcpy(first, text.data(), text.size());
  return {first + text.size(), errc()};
}

namespace ranges {

using ::ranges::all_of;
using ::ranges::any_of;
using ::ranges::binary_search;
using ::ranges::copy;
using ::ranges::count;
using ::ranges::count_if;
using ::ranges::fill;
using ::ranges::find;
using ::ranges::find_if;
using ::ranges::lower_bound;
using ::ranges::max;
using ::ranges::max_element;
using ::ranges::min;
using ::ranges::min_element;
using ::ranges::minmax;
using ::ranges::move;
using ::ranges::none_of;
using ::ranges::sort;
using ::ranges::stable_sort;
using ::ranges::transform;
using ::ranges::upper_bound;

/// range-v3's function would need a predicate that can also compare elements of the same range.
template <class A, class B, class Predicate = std::equal_to<>>
bool equal(A&& a, B&& b, Predicate predicate = {}) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), predicate);
}

}  // namespace ranges
}  // namespace std
// NOLINTEND(cert-dcl58-cpp)
