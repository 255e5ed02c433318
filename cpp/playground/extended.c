/* long double as on x86-64: sums, products, quotients and roots are rounded to 64 significant bits.
 * WebAssembly's long double has 113 bits. These functions replace the library functions for long double, so
 * that results equal the program's results to the bit. Only the code of cpp/contct calls them
 * (CMakeLists.txt); the C library keeps the original functions. */
#include <math.h>
#include <stdint.h>
#include <string.h>

__extension__ typedef unsigned __int128 wide;
#if __LDBL_MANT_DIG__ == 113
typedef long double quad;
#else
__extension__ typedef __float128 quad; /* used by the tests of these functions */
#endif

quad __wrap___addtf3(quad a, quad b);
quad __wrap___subtf3(quad a, quad b);
quad __wrap___multf3(quad a, quad b);
quad __wrap___divtf3(quad a, quad b);
quad __wrap_sqrtl(quad a);

enum { bias = 16383, most = 0x7fff, fraction_bits = 112 };

/* (-1)^sign m 2^exponent. The highest bit of m is 1, or m is 0. */
struct number {
  int sign, exponent;
  uint64_t m;
};

/* Rounds m 2^exponent, m > 0, to 64 bits; ties go to even. `more`: the exact number is larger than m by less
 * than the last bit of m, and m has at least 66 bits. */
static struct number rounded(int sign, wide m, int exponent, int more) {
  const uint64_t top = (uint64_t)(m >> 64);
  const int shift = top != 0 ? __builtin_clzll(top) : 64 + __builtin_clzll((uint64_t)m);
  m <<= shift;
  struct number n = {sign, exponent - shift + 64, (uint64_t)(m >> 64)};
  const uint64_t rest = (uint64_t)m, half = (uint64_t)1 << 63;
  if ((rest > half || (rest == half && (more || n.m % 2 == 1))) && ++n.m == 0) {
    n.m = half;
    ++n.exponent;
  }
  return n;
}

/* Sets n to x. Returns false for NaN and infinity. Rounds a literal with more than 64 bits, as a compiler for
 * x86-64 does. */
static int read(quad x, struct number* n) {
  wide bits;
  memcpy(&bits, &x, sizeof bits);
  const int sign = (int)(bits >> 127), exponent = (int)(bits >> fraction_bits) & most;
  const wide one = (wide)1 << fraction_bits, fraction = bits & (one - 1);
  *n = (struct number){sign, 0, 0};
  if (exponent > 0)
    *n = rounded(sign, one | fraction, exponent - bias - fraction_bits, 0);
  else if (fraction != 0)
    *n = rounded(sign, fraction, 1 - bias - fraction_bits, 0);
  return exponent < most;
}

/* Returns n as a long double. Numbers below the smallest normal number, 2^-16382, become 0. No sum or product
 * of a few doubles is so small. */
static quad written(struct number n) {
  const int exponent = n.exponent + 63 + bias;
  wide bits = (wide)n.sign << 127;
  if (n.m != 0 && exponent >= most)
    bits |= (wide)most << fraction_bits;
  else if (n.m != 0 && exponent > 0)
    bits |= (wide)exponent << fraction_bits | (wide)(n.m << 1) << (fraction_bits - 64);
  quad x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

/* Returns 0, 1 for other finite numbers, infinity or NaN, with the sign of x. Used if an operation has its
 * result from IEEE 754's rules for 0, infinity and NaN. */
static double plain(quad x) {
  struct number n;
  if (!read(x, &n)) return (double)x;
  return copysign(n.m != 0, n.sign ? -1.0 : 1.0);
}

static struct number sum(struct number x, struct number y) {
  if (x.m == 0 && y.m == 0) return (struct number){x.sign & y.sign, 0, 0};
  if (x.m == 0) return y;
  if (y.m == 0) return x;
  if (x.exponent < y.exponent || (x.exponent == y.exponent && x.m < y.m)) {
    const struct number larger = y;
    y = x;
    x = larger;
  }
  const int behind = x.exponent - y.exponent;
  const wide a = (wide)x.m << 63, whole = (wide)y.m << 63;
  const wide b = behind < 127 ? whole >> behind : 0;
  const int more = behind >= 127 || b << behind != whole;
  if (x.sign == y.sign) return rounded(x.sign, a + b, x.exponent - 63, more);
  if (a == b && !more) return (struct number){0, 0, 0};
  return rounded(x.sign, a - b - (wide)more, x.exponent - 63, more);
}

quad __wrap___addtf3(quad a, quad b) {
  struct number x, y;
  if (!read(a, &x) | !read(b, &y)) return plain(a) + plain(b);
  return written(sum(x, y));
}

quad __wrap___subtf3(quad a, quad b) {
  struct number x, y;
  if (!read(a, &x) | !read(b, &y)) return plain(a) - plain(b);
  y.sign = !y.sign;
  return written(sum(x, y));
}

quad __wrap___multf3(quad a, quad b) {
  struct number x, y;
  if (!read(a, &x) | !read(b, &y) || x.m == 0 || y.m == 0) return plain(a) * plain(b);
  return written(rounded(x.sign ^ y.sign, (wide)x.m * y.m, x.exponent + y.exponent, 0));
}

quad __wrap___divtf3(quad a, quad b) {
  struct number x, y;
  if (!read(a, &x) | !read(b, &y) || x.m == 0 || y.m == 0) return plain(a) / plain(b);
  const wide first = (wide)x.m << 63, rest = first % y.m << 64; /* 64 bits of the quotient, and 64 more */
  const wide quotient = first / y.m << 64 | rest / y.m;
  return written(rounded(x.sign ^ y.sign, quotient, x.exponent - y.exponent - 127, rest % y.m != 0));
}

quad __wrap_sqrtl(quad a) {
  struct number x;
  if (!read(a, &x) || x.m == 0 || x.sign) return sqrt(plain(a));
  const int shift = 63 + (x.exponent % 2 == 0);
  const wide square = (wide)x.m << shift;
  uint64_t root = 0;
  for (uint64_t bit = (uint64_t)1 << 63; bit != 0; bit >>= 1)
    if ((wide)(root | bit) * (root | bit) <= square) root |= bit;
  const int rounds_up = square - (wide)root * root > root; /* no root is halfway between two numbers */
  return written(rounded(0, (wide)root << 2 | (rounds_up ? 3 : 0), (x.exponent - shift) / 2 - 2, 0));
}
