// Decimal literals, and the doubles that they become.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace contct {

/// The number digits * 10^exponent, or its negative. There are no zeros at either end of the digits, so that
/// equal numbers are equal in all members; 0 is "0" with exponent 0.
struct decimal {
  bool negative = false;
  std::string digits;
  std::int64_t exponent = 0;

  [[nodiscard]] bool operator==(const decimal&) const = default;
};

/// The power of ten of the last digit that is written: -3 of "1.250", 2 of "1.25e4". Nothing if `literal` is
/// not a decimal, and for whole numbers without point and exponent, which are not rounded.
[[nodiscard]] std::optional<int> last_written_digit(std::string_view literal);

/// The shortest decimal that reads as `x`, which is finite.
[[nodiscard]] decimal shortest_decimal(double x);

/// Is the literal, which reads as `x`, the shortest decimal that does? True if it is not a decimal.
[[nodiscard]] bool is_shortest(std::string_view literal, double x);

/// For a warning, where it is not: "found 0.10000000000000000555; the shortest decimal of its double, 0.1, is
/// used everywhere".
[[nodiscard]] std::string rounding_words(std::string_view literal, double x);

}  // namespace contct
