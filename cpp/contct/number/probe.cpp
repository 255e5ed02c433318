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

bool nearest_even() {
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
  return {.contracts = contraction_happens(),
          .rounds_to_nearest = nearest_even(),
          .flushes_results = results_are_flushed(),
          .flushes_operands = operands_are_flushed(),
          .extra_precision = FLT_EVAL_METHOD != 0,
          .rearranges = may_rearrange()};
}

std::string describe(const floating_point& found) {
  if (found.strict()) return "strict";
  const std::pair<bool, const char*> faults[] = {
      {found.contracts, "products and sums are contracted into one rounding"},
      {!found.rounds_to_nearest, "the rounding mode is not to nearest, ties to even"},
      {found.flushes_results, "subnormal results are flushed to zero"},
      {found.flushes_operands, "subnormal operands count as zero"},
      {found.extra_precision, "intermediate results carry extra precision"},
      {found.rearranges, "the compiler was allowed to rearrange sums and to ignore NaN"}};
  std::string what;
  for (const auto& [wrong, words] : faults)
    if (wrong) what += (what.empty() ? "" : "; ") + std::string(words);
  return what;
}

}  // namespace contct
