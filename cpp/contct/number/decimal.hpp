// Decimal literals and the doubles that they are read as.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace contct {

/// The number digits * 10^exponent, or its negative. `digits` neither begins nor ends with a zero, so that
/// equal numbers have equal members; 0 is "0" with exponent 0.
struct decimal {
  bool negative = false;
  std::string digits;
  std::int64_t exponent = 0;

  [[nodiscard]] bool operator==(const decimal&) const = default;
};

/// The shortest decimal that reads as the finite `x`.
[[nodiscard]] decimal shortest_decimal(double x);

/// So many significant digits identify any double.
inline constexpr int most_digits = 17;

/// True if `literal` is the shortest decimal of its double `x`, or x with most_digits, or if it is not a
/// decimal.
[[nodiscard]] bool stands_for(std::string_view literal, double x);

/// The number of significant digits of `literal`, as written; 0 for the number 0, or if it is no decimal.
[[nodiscard]] int significant_digits(std::string_view literal);

/// The warning that a literal, `shown` in printable letters, is not the shortest decimal of `x`: "found
/// 0.10000000000000000555; the shortest decimal of its double, 0.1, is used everywhere".
[[nodiscard]] std::string rounding_words(std::string_view shown, double x);

}  // namespace contct
