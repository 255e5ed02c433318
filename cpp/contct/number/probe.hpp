// Probes whether floating-point arithmetic is strict, which equality of kernels to the bit requires.
#pragma once

#include <string>

namespace contct {

/// The properties of the floating-point arithmetic. Only if strict() is true are equal kernels guaranteed to
/// return the same bits; otherwise the cause of a mismatch may be the environment.
struct floating_point {
  bool contracts;          ///< a * b + c is rounded only once
  bool rounds_to_nearest;  ///< to the nearest number, ties to even
  bool flushes_results;    ///< subnormal results become zero (FTZ)
  bool flushes_operands;   ///< subnormal operands count as zero (DAZ)
  bool extra_precision;    ///< intermediate results are wider than their type (x87)
  bool rearranges;         ///< compiler flags allow reordered sums and ignored NaN

  [[nodiscard]] bool strict() const {
    return !contracts && rounds_to_nearest && !flushes_results && !flushes_operands && !extra_precision &&
           !rearranges;
  }
};

/// Probes the calling thread's environment and this library's compiler flags.
[[nodiscard]] floating_point probe_floating_point();

/// Returns "strict", or all deviations in one line, as in "subnormal results are flushed to zero".
[[nodiscard]] std::string describe(const floating_point& found);

}  // namespace contct
