// Numbers of about 32 digits: the sum of two doubles (T. J. Dekker 1971). No operation is exact, but those
// named so; all others are off by at most 2^-100 of their result.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "contct/rooms.hpp"

namespace contct::numeric {

/// hi + lo, where hi is that sum rounded to a double.
struct double_double {
  double hi = 0.0, lo = 0.0;

  constexpr double_double() = default;
  constexpr double_double(double x) : hi(x) {}  // NOLINT(google-explicit-constructor): numbers mix
  constexpr double_double(int x) : hi(x) {}     // NOLINT(google-explicit-constructor)
  constexpr double_double(double h, double l) : hi(h), lo(l) {}

  friend double_double operator-(const double_double& a) { return {-a.hi, -a.lo}; }
};

/// a + b, exactly.
[[nodiscard]] inline double_double exact_sum(double a, double b) {
  const double sum = a + b;
  const double of_b = sum - a;
  return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// a * b, exactly, unless it is below the smallest doubles.
[[nodiscard]] inline double_double exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// The same sum, of which |hi| is at least |lo| already.
[[nodiscard]] inline double_double renormalized(double hi, double lo) {
  const double sum = hi + lo;
  return {sum, lo - (sum - hi)};
}

[[nodiscard]] inline double_double operator+(const double_double& a, const double_double& b) {
  const double_double high = exact_sum(a.hi, b.hi);
  const double_double low = exact_sum(a.lo, b.lo);
  const double_double some = renormalized(high.hi, high.lo + low.hi);
  return renormalized(some.hi, some.lo + low.lo);
}
[[nodiscard]] inline double_double operator-(const double_double& a, const double_double& b) {
  return a + (-b);
}
[[nodiscard]] inline double_double operator*(const double_double& a, const double_double& b) {
  const double_double p = exact_product(a.hi, b.hi);
  return renormalized(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}
[[nodiscard]] inline double_double operator/(const double_double& a, const double_double& b) {
  const double first = a.hi / b.hi;
  const double_double left = a - b * first;
  const double second = left.hi / b.hi;
  const double third = (left - b * second).hi / b.hi;
  const double_double some = renormalized(first, second);
  return some + third;
}
inline double_double& operator+=(double_double& a, const double_double& b) {
  return a = a + b;
}
inline double_double& operator-=(double_double& a, const double_double& b) {
  return a = a - b;
}
inline double_double& operator*=(double_double& a, const double_double& b) {
  return a = a * b;
}

[[nodiscard]] inline double_double abs(const double_double& a) {
  return a.hi < 0.0 ? -a : a;
}
[[nodiscard]] inline bool operator<(const double_double& a, const double_double& b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}
[[nodiscard]] inline bool operator==(const double_double& a, const double_double& b) {
  return a.hi == b.hi && a.lo == b.lo;
}

/// 10^n.
[[nodiscard]] inline double_double power_of_ten(int n) {
  double_double power = 1.0;
  double_double square = 10.0;
  for (int left = n < 0 ? -n : n; left > 0; left /= 2) {
    if (left % 2 != 0) power *= square;
    if (left > 1) square *= square;
  }
  return n < 0 ? double_double(1.0) / power : power;
}

/// The shortest decimal that reads as a finite number: digits times 10^power, at most 17 digits.
struct short_decimal {
  std::int64_t digits = 0;
  int power = 0;
};

[[nodiscard]] inline short_decimal shortest_decimal(double x) {
  char text[32];
  const char* const end = std::to_chars(text, text + sizeof text, x, std::chars_format::scientific).ptr;
  short_decimal d;
  bool behind_point = false;
  const char* at = text;
  for (; *at != 'e'; ++at) {
    if (*at == '.') behind_point = true;
    if (*at < '0' || *at > '9') continue;
    d.digits = 10 * d.digits + (*at - '0');
    d.power -= behind_point ? 1 : 0;
  }
  int exponent = 0;
  (void)std::from_chars(at + (at[1] == '+' ? 2 : 1), end, exponent);
  d.power += exponent;
  if (x < 0.0) d.digits = -d.digits;
  return d;
}

__extension__ using wide_integer = __int128;

/// `digits` times 10^power; `digits` of up to 38 digits.
[[nodiscard]] inline double_double scaled_by_ten(wide_integer digits, int power) {
  const auto high = static_cast<double>(digits);
  const double_double whole =
      renormalized(high, static_cast<double>(digits - static_cast<wide_integer>(high)));
  if (power >= 0) return whole * power_of_ten(power);
  constexpr int most = 200;  // 10^-power itself may be no double
  if (-power > most) return whole / power_of_ten(most) / power_of_ten(-power - most);
  return whole / power_of_ten(-power);
}

/// The shortest decimal that reads as the finite number `x`: of 0.1 one tenth, to 2^-94 of it or, where that
/// is less, to some 2^-1074.
[[nodiscard]] inline double_double long_decimal(double x) {
  if (x == std::trunc(x) && std::abs(x) < 0x1p53) return x;
  const short_decimal d = shortest_decimal(x);
  return scaled_by_ten(d.digits, d.power);
}

/// The sum of such decimals to 2^-94 of itself, however much of them cancels.
[[nodiscard]] inline double_double decimal_sum(std::span<const double> all) {
  std::vector<short_decimal> parts;
  for (const double x : all)
    if (x != 0.0) parts.push_back(shortest_decimal(x));
  std::ranges::sort(parts, std::ranges::greater(), &short_decimal::power);
  constexpr wide_integer most = wide_integer{1}
                                << 120U;  // leaves room for the next digit, and for many parts
  double_double rounded;
  wide_integer sum = 0;
  int power = parts.empty() ? 0 : parts.front().power;
  for (const short_decimal& d : parts) {
    for (; power > d.power && sum != 0; --power) {
      if ((sum < 0 ? -sum : sum) > most) {         // what follows cancels none of it
        for (; sum % 10 == 0; ++power) sum /= 10;  // 10^power times the sum is a number, but nearly none
        rounded = rounded + scaled_by_ten(sum, power);
        sum = 0;
        break;
      }
      sum *= 10;
    }
    power = d.power;
    sum += d.digits;
  }
  return rounded + scaled_by_ten(sum, power);
}

/// The difference of two such decimals to 2^-94 of itself, however near they are to each other.
[[nodiscard]] inline double_double decimal_difference(double a, double b) {
  const double parts[] = {a, -b};
  return decimal_sum(parts);
}

}  // namespace contct::numeric
