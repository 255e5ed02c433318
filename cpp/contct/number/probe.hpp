// Probes whether the floating-point arithmetic of this process meets the assumptions of the comparison.
#pragma once

#include <string>

namespace contct {

/// Kernels are guaranteed to be equal only if strict() is true; otherwise the environment may cause a
/// mismatch.
struct floating_point {
  bool contracts;          ///< a * b + c is fused into one rounding
  bool rounds_to_nearest;  ///< rounding mode, ties to even
  bool flushes_results;    ///< subnormal results become zero (FTZ)
  bool flushes_operands;   ///< subnormal operands count as zero (DAZ)
  bool extra_precision;    ///< intermediate results are wider than their type (x87)
  bool rearranges;         ///< the compiler may reorder sums and ignore NaN, by its macros

  [[nodiscard]] bool strict() const {
    return !contracts && rounds_to_nearest && !flushes_results && !flushes_operands && !extra_precision &&
           !rearranges;
  }
};

/// Probes the calling thread's environment and this library's compiler flags.
[[nodiscard]] floating_point probe_floating_point();

/// One line: "strict", or the deviations, as in "subnormal results are flushed to zero".
[[nodiscard]] std::string describe(const floating_point& found);

}  // namespace contct
