// What the C++ library of Debian's Emscripten, libc++ 13, lacks of C++20, as far as the rooms use it:
// algorithms over whole ranges with projections, and numbers read and written without a locale. Included in
// front of every source of the playground, and of nothing else.
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
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>

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
  if (format == chars_format::hex) {  // C's own reader wants a prefix, and an end
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

/// The fewest digits that give the number back, as the library of the other builds has them.
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

/// With so many digits behind the point.
inline to_chars_result to_chars(char* first, char* last, double value, chars_format /*scientific*/,
                                int digits) {
  const string text = isfinite(value) ? fmt::format("{:.{}e}", value, digits) : fmt::format("{}", value);
  if (last - first < static_cast<ptrdiff_t>(text.size())) return {last, errc::value_too_large};
  memcpy(first, text.data(), text.size());
  return {first + text.size(), errc()};
}

/// The same without a format, for people.
inline to_chars_result to_chars(char* first, char* last, double value) {
  const string text = fmt::format("{}", value);
  if (last - first < static_cast<ptrdiff_t>(text.size())) return {last, errc::value_too_large};
  memcpy(first, text.data(), text.size());
  return {first + text.size(), errc()};
}

namespace ranges {

/// Compares what a projection makes of two elements.
template <class Compare, class Projection>
auto projected(Compare& compare, Projection& projection) {
  return [&](auto&& a, auto&& b) -> bool {
    return invoke(compare, invoke(projection, std::forward<decltype(a)>(a)),
                  invoke(projection, std::forward<decltype(b)>(b)));
  };
}

template <class Predicate, class Projection>
auto holds(Predicate& predicate, Projection& projection) {
  return
      [&](auto&& a) -> bool { return invoke(predicate, invoke(projection, std::forward<decltype(a)>(a))); };
}

template <class Range, class T, class Projection = identity>
auto find(Range&& r, const T& value, Projection projection = {}) {
  return std::find_if(std::begin(r), std::end(r),
                      [&](auto&& a) -> bool { return invoke(projection, a) == value; });
}
template <class Range, class Predicate, class Projection = identity>
auto find_if(Range&& r, Predicate predicate, Projection projection = {}) {
  return std::find_if(std::begin(r), std::end(r), holds(predicate, projection));
}
template <class Range, class Predicate, class Projection = identity>
bool all_of(Range&& r, Predicate predicate, Projection projection = {}) {
  return std::all_of(std::begin(r), std::end(r), holds(predicate, projection));
}
template <class Range, class Predicate, class Projection = identity>
bool any_of(Range&& r, Predicate predicate, Projection projection = {}) {
  return std::any_of(std::begin(r), std::end(r), holds(predicate, projection));
}
template <class Range, class Predicate, class Projection = identity>
bool none_of(Range&& r, Predicate predicate, Projection projection = {}) {
  return std::none_of(std::begin(r), std::end(r), holds(predicate, projection));
}
template <class Range, class T, class Projection = identity>
auto count(Range&& r, const T& value, Projection projection = {}) {
  return std::count_if(std::begin(r), std::end(r),
                       [&](auto&& a) -> bool { return invoke(projection, a) == value; });
}
template <class Range, class Predicate, class Projection = identity>
auto count_if(Range&& r, Predicate predicate, Projection projection = {}) {
  return std::count_if(std::begin(r), std::end(r), holds(predicate, projection));
}
template <class Range, class Compare = std::less<>, class Projection = identity>
void sort(Range&& r, Compare compare = {}, Projection projection = {}) {
  std::sort(std::begin(r), std::end(r), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = identity>
void stable_sort(Range&& r, Compare compare = {}, Projection projection = {}) {
  std::stable_sort(std::begin(r), std::end(r), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = identity>
bool is_sorted(Range&& r, Compare compare = {}, Projection projection = {}) {
  return std::is_sorted(std::begin(r), std::end(r), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = identity>
auto max_element(Range&& r, Compare compare = {}, Projection projection = {}) {
  return std::max_element(std::begin(r), std::end(r), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = identity>
auto min_element(Range&& r, Compare compare = {}, Projection projection = {}) {
  return std::min_element(std::begin(r), std::end(r), projected(compare, projection));
}
template <class Range, class Compare = std::less<>, class Projection = identity>
auto max(Range&& r, Compare compare = {}, Projection projection = {}) {
  return *max_element(r, compare, projection);
}
template <class Range, class Compare = std::less<>, class Projection = identity>
auto min(Range&& r, Compare compare = {}, Projection projection = {}) {
  return *min_element(r, compare, projection);
}
template <class T>
struct min_max_result {
  T min, max;
};
template <class Range, class Compare = std::less<>, class Projection = identity>
auto minmax(Range&& r, Compare compare = {}, Projection projection = {}) {
  const auto found = std::minmax_element(std::begin(r), std::end(r), projected(compare, projection));
  return min_max_result<std::decay_t<decltype(*found.first)>>{*found.first, *found.second};
}
template <class Range, class T, class Compare = std::less<>, class Projection = identity>
auto lower_bound(Range&& r, const T& value, Compare compare = {}, Projection projection = {}) {
  return std::lower_bound(std::begin(r), std::end(r), value, [&](auto&& element, const T& sought) -> bool {
    return invoke(compare, invoke(projection, element), sought);
  });
}
template <class Range, class T, class Compare = std::less<>>
bool binary_search(Range&& r, const T& value, Compare compare = {}) {
  return std::binary_search(std::begin(r), std::end(r), value, compare);
}
template <class Range, class Out, class Operation>
void transform(Range&& r, Out out, Operation operation) {
  std::transform(std::begin(r), std::end(r), out,
                 [&](auto&& a) -> decltype(auto) { return invoke(operation, std::forward<decltype(a)>(a)); });
}
template <class A, class B, class Out, class Operation>
void transform(A&& a, B&& b, Out out, Operation operation) {
  std::transform(std::begin(a), std::end(a), std::begin(b), out, operation);
}
template <class Range, class Predicate, class T>
void replace_if(Range&& r, Predicate predicate, const T& value) {
  std::replace_if(std::begin(r), std::end(r), predicate, value);
}
template <class Range, class Out, class Predicate>
void copy_if(Range&& r, Out out, Predicate predicate) {
  std::copy_if(std::begin(r), std::end(r), out, predicate);
}
template <class Range, class Out>
void move(Range&& r, Out out) {
  std::move(std::begin(r), std::end(r), out);
}
template <class A, class B, class Predicate = std::equal_to<>>
bool equal(A&& a, B&& b, Predicate predicate = {}) {
  return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b), predicate);
}

}  // namespace ranges
}  // namespace std
// NOLINTEND(cert-dcl58-cpp)
