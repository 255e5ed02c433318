// Numbers of about 32 digits: the sum of two doubles (T. J. Dekker 1971). The functions named exact_.. are
// exact; all other operations have errors of at most 2^-100 of their result.
#pragma once

#include <cmath>

namespace contct {

/// The number hi + lo; hi is this sum rounded to a double.
struct double_double {
  double hi = 0.0, lo = 0.0;

  constexpr double_double() = default;
  constexpr double_double(double x) : hi(x) {}  // NOLINT(google-explicit-constructor): for mixed sums
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

/// a * b, exactly, unless its rounding error is too small for a double.
[[nodiscard]] inline double_double exact_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// hi + lo, exactly, if |hi| >= |lo|.
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

}  // namespace contct
