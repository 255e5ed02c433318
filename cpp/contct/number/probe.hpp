// Does the floating-point arithmetic of this process meet the assumptions of the comparison?
#pragma once

#include <string>

namespace contct {

/// The results of the floating-point probe. Equality between kernels is promised only if strict() holds;
/// otherwise a mismatch may be due to the environment.
struct floating_point {
  bool contracts;          ///< a * b + c is fused into one rounding
  bool rounds_to_nearest;  ///< rounding mode, ties to even
  bool flushes_results;    ///< subnormal results become zero (FTZ)
  bool flushes_operands;   ///< subnormal operands count as zero (DAZ)
  bool extra_precision;    ///< intermediate results are wider than their type (x87)
  bool rearranges;         ///< the compiler was allowed to reorder sums and to ignore NaN: not measurable

  [[nodiscard]] bool strict() const {
    return !contracts && rounds_to_nearest && !flushes_results && !flushes_operands && !extra_precision &&
           !rearranges;
  }
};

/// Probe the calling thread's environment, with the flags that this library was compiled under.
[[nodiscard]] floating_point probe_floating_point();

/// One line for people: "strict", or what is wrong, as in "subnormal results are flushed to zero".
[[nodiscard]] std::string describe(const floating_point& found);

}  // namespace contct
