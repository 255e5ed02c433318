#include "contct/number/decimal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace contct {
namespace {

constexpr std::int64_t endless = std::int64_t{1} << 40;  // larger than any exponent of a double

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_whole(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, is_digit);
}

/// Removes a sign at the front of `rest`; returns true if the sign is a minus.
bool take_minus(std::string_view& rest) {
  const bool minus = rest.starts_with('-');
  if (minus || rest.starts_with('+')) rest.remove_prefix(1);
  return minus;
}

/// The number that `literal`, such as "-1_000.5e-3" or "1.5D+02", means; nothing if `literal` is not a
/// decimal.
std::optional<decimal> decimal_in(std::string_view literal) {
  std::string text(literal);
  std::erase(text, '_');
  std::string_view rest = text;
  const bool negative = take_minus(rest);
  std::int64_t exponent = 0;
  if (const std::size_t mark = rest.find_first_of("eEdD"); mark != std::string_view::npos) {
    std::string_view power = rest.substr(mark + 1);
    rest = rest.substr(0, mark);
    const bool minus = take_minus(power);
    if (!is_whole(power)) return std::nullopt;
    for (const char c : power) exponent = std::min(endless, exponent * 10 + (c - '0'));
    if (minus) exponent = -exponent;
  }
  std::string digits(rest);
  if (const std::size_t point = digits.find('.'); point != std::string::npos) {
    digits.erase(point, 1);
    exponent -= static_cast<std::int64_t>(digits.size() - point);
  }
  if (!is_whole(digits)) return std::nullopt;
  const std::size_t last = digits.find_last_not_of('0');
  if (last == std::string::npos) return decimal{false, "0", 0};
  const std::size_t first = digits.find_first_not_of('0');
  return decimal{negative, digits.substr(first, last + 1 - first),
                 exponent + static_cast<std::int64_t>(digits.size() - last - 1)};
}

/// The finite x as std::to_chars writes it in this format; by default the shortest text.
template <class... Format>
std::string written(double x, Format... format) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, format...);
  return {text.data(), end.ptr};
}

}  // namespace

decimal shortest_decimal(double x) {
  return *decimal_in(written(x, std::chars_format::scientific));
}

int significant_digits(std::string_view literal) {
  if (!decimal_in(literal)) return 0;
  const std::string_view mantissa = literal.substr(0, literal.find_first_of("eEdD"));
  const std::size_t first = std::min(mantissa.find_first_of("123456789"), mantissa.size());
  return static_cast<int>(std::ranges::count_if(mantissa.substr(first), is_digit));
}

bool stands_for(std::string_view literal, double x) {
  // No two decimals of up to 15 digits read as the same normal double.
  constexpr int always_kept = 15;
  if (std::ranges::count_if(literal, is_digit) <= always_kept && std::isnormal(x)) return true;
  const std::optional<decimal> found = decimal_in(literal);
  return !found || *found == shortest_decimal(x) ||
         *found == decimal_in(written(x, std::chars_format::scientific, most_digits - 1));
}

std::string rounding_words(std::string_view shown, double x) {
  // Without a format, to_chars may write all digits of a whole number beyond 2^53, not only the shortest.
  const std::string shortest = std::abs(x) < 1e16 ? written(x) : written(x, std::chars_format::scientific);
  return "found " + std::string(shown) + "; the shortest decimal of its double, " + shortest +
         ", is used everywhere";
}

}  // namespace contct
