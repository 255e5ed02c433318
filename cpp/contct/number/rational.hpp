// Exact numbers, by GMP if it is found; decimals in and out.
#pragma once

#ifdef CONTCT_HAS_GMP
#include <boost/multiprecision/gmp.hpp>
#else
#include <boost/multiprecision/cpp_int.hpp>
#endif
#include <cstddef>
#include <cstdint>
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

/// A number that has become too long to go on with.
struct too_long : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// From now on GMP, which otherwise aborts the process without memory, does then what new does: it calls the
/// new handler, which must not return.
void allocate_as_new_does();

/// The shortest decimal that reads as `x`, which is finite: 0.1 is 1/10. This is what every number of a file
/// means.
[[nodiscard]] rational decimal_of(double x);

/// The exact value of a double, bit for bit. Throws std::domain_error where `x` is not finite.
[[nodiscard]] rational binary_value(double x);

/// The nearest double, the even one of two that are equally near; infinite beyond their range.
[[nodiscard]] double rounded(const rational& x);
/// The nearest double, and the nearest one to what that leaves.
[[nodiscard]] double_double long_rounded(const rational& x);

/// The number of a kind that is nearest to an exact one.
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

/// The fraction if its numerator and denominator have at most `digits` digits together; otherwise `digits`
/// significant digits, rounded half away from 0: "0.078947368421", "-1.25e-07". Trailing zeros are omitted
/// only if no other digits follow.
[[nodiscard]] std::string short_words(const rational& x, int digits);

/// Bits of the numerator or the denominator, whichever has more.
[[nodiscard]] std::size_t length_in_bits(const rational& x);

}  // namespace contct
