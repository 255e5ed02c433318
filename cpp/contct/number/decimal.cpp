#include "contct/number/decimal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "contct/text/strings.hpp"

namespace contct {
namespace {

constexpr std::int64_t endless = std::int64_t{1} << 40;  // larger than any exponent of a double

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Removes the digits at the front of `rest`, and the underscores between them; returns the digits.
std::string take_digits(std::string_view& rest) {
  std::string digits;
  while (!rest.empty() && (is_digit(rest.front()) || rest.front() == '_')) {
    if (rest.front() != '_') digits += rest.front();
    rest.remove_prefix(1);
  }
  return digits;
}

/// Removes a sign at the front of `rest`; returns true if the sign is a minus.
bool take_minus(std::string_view& rest) {
  const bool minus = !rest.empty() && rest.front() == '-';
  if (minus || (!rest.empty() && rest.front() == '+')) rest.remove_prefix(1);
  return minus;
}

/// The exponent that `rest` is, such as "e-3"; 0 if `rest` is empty, nothing if it is not an exponent.
std::optional<std::int64_t> exponent_in(std::string_view rest) {
  if (rest.empty()) return 0;
  if (std::string_view("eEdD").find(rest.front()) == std::string_view::npos) return std::nullopt;
  rest.remove_prefix(1);
  const bool minus = take_minus(rest);
  const std::string digits = take_digits(rest);
  if (digits.empty() || !rest.empty()) return std::nullopt;
  std::int64_t exponent = 0;
  for (const char c : digits) exponent = std::min(endless, exponent * 10 + (c - '0'));
  return minus ? -exponent : exponent;
}

/// The number that `literal`, such as "-1_000.5e-3" or "1.5D+02", means; nothing if `literal` is not a
/// decimal.
std::optional<decimal> decimal_in(std::string_view literal) {
  const bool negative = take_minus(literal);
  std::string digits = take_digits(literal);
  std::int64_t exponent = 0;
  if (!literal.empty() && literal.front() == '.') {
    literal.remove_prefix(1);
    const std::string fraction = take_digits(literal);
    exponent = -static_cast<std::int64_t>(fraction.size());
    digits += fraction;
  }
  const std::optional<std::int64_t> written = exponent_in(literal);
  if (digits.empty() || !written) return std::nullopt;
  const std::size_t last = digits.find_last_not_of('0');
  if (last == std::string::npos) return decimal{false, "0", 0};
  const std::size_t first = digits.find_first_not_of('0');
  return decimal{negative, digits.substr(first, last + 1 - first),
                 *written + exponent + static_cast<std::int64_t>(digits.size() - last - 1)};
}

/// The decimal of the finite x with `behind` digits behind the first; the shortest one without `behind`.
template <class... Behind>
decimal printed(double x, Behind... behind) {
  std::array<char, 64> text{};
  char* const last = text.data() + text.size();
  const auto end = std::to_chars(text.data(), last, x, std::chars_format::scientific, behind...);
  return *decimal_in(std::string_view(text.data(), end.ptr - text.data()));
}

}  // namespace

decimal shortest_decimal(double x) {
  return printed(x);
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
  const std::optional<decimal> written = decimal_in(literal);
  return !written || *written == shortest_decimal(x) || *written == printed(x, most_digits - 1);
}

std::string rounding_words(std::string_view literal, double x) {
  // Without a format, to_chars may write all digits of a whole number beyond 2^53, not only the shortest.
  std::array<char, 32> shortest{};
  char* const last = shortest.data() + shortest.size();
  const auto end = std::abs(x) < 1e16
                       ? std::to_chars(shortest.data(), last, x)
                       : std::to_chars(shortest.data(), last, x, std::chars_format::scientific);
  return "found " + printable(literal) + "; the shortest decimal of its double, " +
         std::string(shortest.data(), end.ptr) + ", is used everywhere";
}

}  // namespace contct
