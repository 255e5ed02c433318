#include "contct/lab/printed_number.hpp"

#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace contct::lab {
namespace {

[[noreturn]] void refuse(std::string_view words) {
  throw std::invalid_argument("found \"" + std::string(words) +
                              R"("; allowed: a decimal, or a fraction "p/q")");
}

bool are_digits(std::string_view s) {
  return !s.empty() && s.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Boost reads a leading zero as the mark of an octal number.
integer whole(std::string_view digits) {
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string_view::npos ? integer(0) : integer(std::string(digits.substr(first)));
}

/// The size of the number that `words` write, its sign left out.
struct unsigned_decimal {
  integer digits;
  int exponent = 0;  // of the last digit
};

unsigned_decimal unsigned_decimal_of(std::string_view words) {
  unsigned_decimal out;
  const std::size_t e = words.find_first_of("eE");
  const std::string_view mantissa = words.substr(0, e);
  const std::size_t point = mantissa.find('.');
  std::string digits(mantissa.substr(0, point));
  if (point != std::string_view::npos) {
    const std::string_view behind = mantissa.substr(point + 1);
    digits += behind;
    out.exponent = -static_cast<int>(behind.size());
  }
  constexpr int largest_exponent = 10'000;
  int exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view said = words.substr(e + 1);
    if (said.starts_with('+')) said.remove_prefix(1);
    const auto [end, error] = std::from_chars(said.data(), said.data() + said.size(), exponent);
    if (error != std::errc{} || end != said.data() + said.size() || std::abs(exponent) > largest_exponent)
      refuse(words);
  }
  if (!are_digits(digits)) refuse(words);
  out.digits = whole(digits);
  out.exponent += exponent;
  return out;
}

rational ten_to(int exponent) {
  const integer power = boost::multiprecision::pow(integer(10), static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? rational(integer(1), power) : rational(power);
}

std::string_view without_sign(std::string_view words) {
  return words.starts_with('-') || words.starts_with('+') ? words.substr(1) : words;
}

}  // namespace

rational number_printed(std::string_view words) {
  const std::string_view size = without_sign(words);
  rational x;
  if (const std::size_t slash = size.find('/'); slash != std::string_view::npos) {
    const std::string_view top = size.substr(0, slash);
    const std::string_view bottom = size.substr(slash + 1);
    if (!are_digits(top) || !are_digits(bottom) || whole(bottom) == 0) refuse(words);
    x = rational(whole(top), whole(bottom));
  } else {
    const unsigned_decimal d = unsigned_decimal_of(size);
    x = rational(d.digits) * ten_to(d.exponent);
  }
  return words.starts_with('-') ? rational(-x) : x;
}

printing printing_of(std::string_view printed, const rational& exact) {
  const rational x = number_printed(printed);
  if (x == exact) return printing::rounded;
  if (x == 0 || exact == 0 || printed.find('/') != std::string_view::npos) return printing::neither;
  const rational unit = ten_to(unsigned_decimal_of(without_sign(printed)).exponent);
  if (2 * abs(rational(exact - x)) <= unit) return printing::rounded;
  const rational beyond = x < 0 ? rational(x - exact) : rational(exact - x);
  return beyond > 0 && beyond < unit ? printing::cut : printing::neither;
}

}  // namespace contct::lab
