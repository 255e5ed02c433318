#include <cmath>
#include <limits>

#include "catch.hpp"
#include "contct/number/random.hpp"

__extension__ using quad = __float128;

// Functions of cpp/playground/extended.c, renamed by CMakeLists.txt.
extern "C" quad page_sum(quad, quad), page_difference(quad, quad), page_product(quad, quad),
    page_quotient(quad, quad), page_root(quad);

namespace {

using contct::random_numbers;

/// Returns a zero, an infinity, a NaN, or a large or small number with few or all 64 bits.
long double any_number(random_numbers& random) {
  constexpr long double infinity = std::numeric_limits<long double>::infinity();
  constexpr long double not_a_number = std::numeric_limits<long double>::quiet_NaN();
  constexpr long double special[] = {0.0L, -0.0L, 1.0L, -1.0L, infinity, -infinity, not_a_number};
  if (random.chance(0.05)) return special[random.whole(0, 6)];
  std::uint64_t bits = random.bits();
  if (random.chance(0.3)) bits &= ~std::uint64_t{0} << random.whole(0, 63);
  if (random.chance(0.2)) bits |= ~std::uint64_t{0} >> random.whole(0, 63);
  const long double x = std::ldexp(static_cast<long double>(bits), random.whole(-140, 40));
  return random.chance(0.5) ? x : -x;
}

/// Returns -a, or the number next to a, for sums that cancel or round up to a power of 2; otherwise any
/// number.
long double beside(long double a, random_numbers& random) {
  if (a == 0 || random.chance(0.8)) return any_number(random);
  if (random.chance(0.3)) return -a;
  return std::nextafter(a, random.chance(0.5) ? 2 * a : 0.0L);
}

bool same(long double expected, quad found) {
  const auto narrow = static_cast<long double>(found);
  if (std::isnan(expected)) return std::isnan(narrow);
  return static_cast<quad>(narrow) == found && narrow == expected &&
         std::signbit(narrow) == std::signbit(expected);
}

}  // namespace

TEST_CASE("the playground rounds sums, products, quotients and roots of long double as x86-64 does") {
  static_assert(std::numeric_limits<long double>::digits == 64);
  random_numbers random(1989);
  int different = 0;
  for (int i = 0; i < 20'000; ++i) {
    const long double a = any_number(random);
    const long double b = beside(a, random);
    const bool equal = same(a + b, page_sum(a, b)) && same(a - b, page_difference(a, b)) &&
                       same(a * b, page_product(a, b)) && same(a / b, page_quotient(a, b)) &&
                       same(std::sqrt(a), page_root(a));
    if (!equal && different++ == 0) {
      CAPTURE(i, a, b);
      CHECK(equal);
    }
  }
  CHECK(different == 0);
}

TEST_CASE("the playground rounds a long double literal of more than 64 bits to 64 bits before use") {
  const quad tenth = static_cast<quad>(1) / 10;
  CHECK(same(0.1L * 1.0L, page_product(tenth, 1)));
  CHECK(static_cast<quad>(0.1L) != tenth);
}
