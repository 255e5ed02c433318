#include "contct/number/rational.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <new>

#include "contct/number/decimal.hpp"

namespace contct {
namespace {

rational power_of(unsigned base, int exponent) {
  const integer power = boost::multiprecision::pow(integer(base), static_cast<unsigned>(std::abs(exponent)));
  return exponent < 0 ? rational(integer(1), power) : rational(power);
}

std::size_t length_in_bits(const integer& n) {
  return n == 0 ? 0 : boost::multiprecision::msb(abs(n)) + 1;
}

/// The exponent of the leading digit of x > 0: 10^e <= x < 10^(e + 1).
int leading_exponent(const rational& x) {
  const auto top = static_cast<double>(length_in_bits(numerator(x)));
  const auto bottom = static_cast<double>(length_in_bits(denominator(x)));
  int e = static_cast<int>(std::floor((top - bottom) * std::log10(2.0)));
  while (power_of(10, e) > x) --e;
  while (power_of(10, e + 1) <= x) ++e;
  return e;
}

/// Writes the digits "123" with exponent -1, that of the first digit, as "0.123". An exponent below -5 or
/// above 20 is written, as in "1.23e-7".
std::string decimal_words(std::string digits, int exponent) {
  const int count = static_cast<int>(digits.size());
  if (exponent < -5 || exponent > 20) {
    if (count > 1) digits.insert(1, ".");
    return digits + "e" + std::to_string(exponent);
  }
  if (exponent < 0) return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  if (count <= exponent + 1) return digits + std::string(static_cast<std::size_t>(exponent + 1 - count), '0');
  return digits.insert(static_cast<std::size_t>(exponent) + 1, ".");
}

#ifdef CONTCT_HAS_GMP
void* allocate(std::size_t bytes) {
  return ::operator new(bytes);
}

void release(void* block, std::size_t /*bytes*/) {
  ::operator delete(block);
}

void* reallocate(void* block, std::size_t before, std::size_t bytes) {
  void* const moved = std::memcpy(allocate(bytes), block, std::min(before, bytes));
  release(block, before);
  return moved;
}
#endif

}  // namespace

void allocate_as_new_does() {
#ifdef CONTCT_HAS_GMP
  mp_set_memory_functions(allocate, reallocate, release);
#endif
}

rational decimal_of(double x) {
  const decimal d = shortest_decimal(x);
  return rational(integer((d.negative ? "-" : "") + d.digits)) * power_of(10, static_cast<int>(d.exponent));
}

rational binary_value(double x) {
  if (!std::isfinite(x)) throw std::domain_error("an infinity or a NaN has no exact value");
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(x, &exponent), 53));
  return rational(integer(mantissa)) * power_of(2, exponent - 53);
}

double rounded(const rational& x) {
  // Rounds |x| once, to n 2^unit with a whole number n of at most 53 bits, or fewer for a subnormal number.
  // Boost's own conversion overflows if the numerator or the denominator exceeds the largest double.
  const integer top = abs(numerator(x));
  const integer bottom = denominator(x);
  constexpr int least_unit = DBL_MIN_EXP - DBL_MANT_DIG;
  int unit = std::max(least_unit, static_cast<int>(length_in_bits(top)) -
                                      static_cast<int>(length_in_bits(bottom)) - DBL_MANT_DIG);
  const auto shifted = [](const integer& n, int bits) { return bits > 0 ? integer(n << bits) : n; };
  const auto divide = [&](integer& n, integer& rest) {
    boost::multiprecision::divide_qr(shifted(top, -unit), shifted(bottom, unit), n, rest);
  };
  integer n;
  integer rest;
  divide(n, rest);
  if (length_in_bits(n) > std::size_t{DBL_MANT_DIG}) {
    ++unit;
    divide(n, rest);
  }
  const int beyond_half = integer(rest * 2).compare(shifted(bottom, unit));
  if (beyond_half > 0 || (beyond_half == 0 && n % 2 != 0)) ++n;
  const double size = std::ldexp(static_cast<double>(n.convert_to<std::uint64_t>()), unit);
  return x < 0 ? -size : size;
}

double_double long_rounded(const rational& x) {
  const double high = rounded(x);
  return std::isfinite(high) ? double_double(high, rounded(x - binary_value(high))) : double_double(high);
}

/// The double |x| = m 2^e is the one nearest to its decimal n / 10^k. The decimal minus |x| is 2^e / 5^k
/// times the integer n 2^-(e + k) - m 5^k, whose magnitude is at most 5^k / 2. Arithmetic modulo 2^64 gives
/// this integer exactly, although its two terms may overflow.
double_double long_decimal_of(double x) {
  const decimal d = shortest_decimal(x);
  int e = 0;
  const auto m = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &e), DBL_MANT_DIG));
  e -= DBL_MANT_DIG;
  constexpr int most = 27;  // 5^27 < 2^63
  const auto k = static_cast<int>(-d.exponent);
  if (k < 0 || k > most || e + k > 0) return long_rounded(decimal_of(x));
  std::uint64_t n = 0;
  for (const char digit : d.digits) n = 10 * n + static_cast<std::uint64_t>(digit - '0');
  std::uint64_t five = 1;
  for (int i = 0; i < k; ++i) five *= 5;
  const std::uint64_t shifted = e + k > -64 ? n << -(e + k) : 0;
  const auto in_halves = [](std::int64_t i) {
    const auto high = static_cast<double>(i);
    return double_double(high, static_cast<double>(i - static_cast<std::int64_t>(high)));
  };
  const double_double off =
      in_halves(static_cast<std::int64_t>(shifted - m * five)) / in_halves(static_cast<std::int64_t>(five));
  const double low = std::ldexp(off.hi, e);
  return x < 0.0 ? double_double(x, -low) : double_double(x, low);
}

rational dot(const rational_vector& a, const rational_vector& b) {
  rational sum;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != 0 && b[i] != 0) sum += a[i] * b[i];
  return sum;
}

void add(rational_vector& sum, const rational_vector& part, const rational& share) {
  if (share == 0) return;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (part[i] != 0) sum[i] += share * part[i];
}

bool is_zero(const rational_vector& v) {
  return std::all_of(v.begin(), v.end(), [](const rational& x) { return x == 0; });
}

std::string fraction_words(const rational& x) {
  return denominator(x) == 1 ? numerator(x).str() : numerator(x).str() + "/" + denominator(x).str();
}

std::string short_words(const rational& x, int digits) {
  constexpr double digits_of_bit = 0.30103;
  const auto bits = static_cast<double>(length_in_bits(numerator(x)) + length_in_bits(denominator(x)));
  if (bits * digits_of_bit <= digits + 2) {  // two digits more, because the estimate may be too large
    std::string words = fraction_words(x);
    const auto counted = static_cast<int>(words.size()) - (x < 0 ? 1 : 0) - (denominator(x) == 1 ? 0 : 1);
    if (counted <= digits) return words;
  }
  return rounded_words(x, digits);
}

std::string rounded_words(const rational& x, int digits) {
  const rational size = abs(x);
  int exponent = leading_exponent(size);
  const rational scaled = size * power_of(10, digits - 1 - exponent);
  const rational raised = scaled + rational(1, 2);
  std::string shown = integer(numerator(raised) / denominator(raised)).str();
  if (static_cast<int>(shown.size()) > digits) {  // rounded up to a power of 10
    shown.pop_back();
    ++exponent;
  }
  const bool all = denominator(scaled) == 1;  // then the decimal is exact
  while (all && shown.size() > 1 && shown.back() == '0') shown.pop_back();
  return (x < 0 ? "-" : "") + decimal_words(shown, exponent);
}

std::size_t length_in_bits(const rational& x) {
  return std::max(length_in_bits(numerator(x)), length_in_bits(denominator(x)));
}

}  // namespace contct
