// Rational numbers, by GMP or else by Boost, and their conversion from and to decimals.
#pragma once

#ifdef CONTCT_HAS_GMP
#include <boost/multiprecision/gmp.hpp>
#else
#include <boost/multiprecision/cpp_int.hpp>
#endif
#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "contct/number/double_double.hpp"

namespace contct {

#ifdef CONTCT_HAS_GMP
using integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
using rational =
    boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
#else
using integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
using rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
#endif

/// Thrown when a number has too many digits to continue.
struct too_long : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Makes GMP call the new handler, which must not return, when memory runs out. By default GMP aborts the
/// process.
void allocate_as_new_does();

/// The shortest decimal that reads as the finite `x`: 1/10 for 0.1. Numbers in files have this meaning.
[[nodiscard]] rational decimal_of(double x);

/// The exact value of a double. Throws std::domain_error if `x` is not finite.
[[nodiscard]] rational binary_value(double x);

/// The double nearest to x, ties to even; infinite if x is out of range.
[[nodiscard]] double rounded(const rational& x);
/// hi is the double nearest to x, and lo the double nearest to x - hi; lo is 0 if hi is infinite.
[[nodiscard]] double_double long_rounded(const rational& x);
/// long_rounded(decimal_of(x)), for most doubles without rational numbers; the low part may then have a
/// relative error of 2^-100 before its rounding.
[[nodiscard]] double_double long_decimal_of(double x);

template <class Number>
[[nodiscard]] Number nearest(const rational& x) {
  if constexpr (std::is_same_v<Number, double>) return contct::rounded(x);
  if constexpr (std::is_same_v<Number, double_double>) return long_rounded(x);
  if constexpr (std::is_same_v<Number, rational>) return x;
}

using rational_vector = std::vector<rational>;

[[nodiscard]] rational dot(const rational_vector& a, const rational_vector& b);
/// sum += share * part.
void add(rational_vector& sum, const rational_vector& part, const rational& share);
[[nodiscard]] bool is_zero(const rational_vector& v);

/// "p/q" in lowest terms, or "p".
[[nodiscard]] std::string fraction_words(const rational& x);

/// The fraction if its numerator and denominator have at most `digits` digits together, as in "-208/58875".
/// Otherwise a decimal of `digits` significant digits, rounded half away from 0: "-0.003532909", "3.333e-11".
/// Trailing zeros are omitted only if the decimal is exact.
[[nodiscard]] std::string short_words(const rational& x, int digits);
/// This decimal of x, which is not 0.
[[nodiscard]] std::string rounded_words(const rational& x, int digits);

/// The length of the numerator or the denominator in bits, whichever is larger.
[[nodiscard]] std::size_t length_in_bits(const rational& x);

}  // namespace contct
