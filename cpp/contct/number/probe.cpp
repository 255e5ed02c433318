#include "contct/number/probe.hpp"

#include <cfloat>
#include <limits>
#include <utility>

namespace contct {
namespace {

// Returns x through a volatile variable, so that the compiler does not compute with x at compile time.
double opaque(double x) {
  volatile double held = x;
  return held;
}

bool contraction_happens() {
  // For e = 2^-30, (1 + e)(1 - e) - 1 is -e^2 with one rounding, and 0 with two.
  const double e = opaque(0x1p-30);
  const double a = 1.0 + e;
  const double b = 1.0 - e;
  const double c = opaque(-1.0);
  return a * b + c != 0.0;
}

bool rounds_to_nearest_even() {
  const double half_ulp = opaque(0x1p-53);
  const double one = opaque(1.0);
  const double odd = opaque(1.0 + 0x1p-52);
  return one + half_ulp == 1.0 && odd + half_ulp == 1.0 + 0x1p-51 && -one - half_ulp == -1.0 &&
         one - half_ulp / 2.0 == 1.0;
}

bool results_are_flushed() {
  const double smallest_normal = opaque(std::numeric_limits<double>::min());
  const double half = smallest_normal * opaque(0.5);
  volatile double held = half;
  // DAZ alone also makes this function return true, because the product then reads `held` as zero.
  return opaque(held) * opaque(0x1p+60) * opaque(0x1p+60) == 0.0;
}

bool operands_are_flushed() {
  const double subnormal = opaque(std::numeric_limits<double>::denorm_min());
  return subnormal * opaque(0x1p+60) == 0.0;
}

/// Rearranged sums cannot be measured, but macros show the compiler flags that allow them.
constexpr bool may_rearrange() {
#if defined __FAST_MATH__ || (defined __FINITE_MATH_ONLY__ && __FINITE_MATH_ONLY__)
  return true;
#else
  return false;
#endif
}

}  // namespace

floating_point probe_floating_point() {
  const std::pair<bool, const char*> faults[] = {
      {contraction_happens(), "products and sums are contracted into one rounding"},
      {!rounds_to_nearest_even(), "the rounding mode is not to nearest, ties to even"},
      {results_are_flushed(), "subnormal results are flushed to zero"},      // FTZ
      {operands_are_flushed(), "subnormal operands count as zero"},          // DAZ
      {FLT_EVAL_METHOD != 0, "intermediate results carry extra precision"},  // x87
      {may_rearrange(), "the compiler was allowed to rearrange sums and to ignore NaN"}};
  floating_point found;
  for (const auto& [wrong, words] : faults)
    if (wrong) found.faults.append(found.strict() ? "" : "; ").append(words);
  return found;
}

}  // namespace contct
