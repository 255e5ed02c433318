// Probes whether floating-point arithmetic is strict, which equality of kernels to the bit requires.
#pragma once

#include <string>

namespace contct {

/// The properties of the floating-point arithmetic. Only if strict() is true are equal kernels guaranteed to
/// return the same bits; otherwise the cause of a mismatch may be the environment.
struct floating_point {
  std::string faults;  ///< all deviations in one line, as in "subnormal results are flushed to zero"

  [[nodiscard]] bool strict() const { return faults.empty(); }
};

/// Probes the calling thread's environment and this library's compiler flags.
[[nodiscard]] floating_point probe_floating_point();

/// Returns "strict", or the faults.
[[nodiscard]] inline std::string describe(const floating_point& found) {
  return found.strict() ? "strict" : found.faults;
}

}  // namespace contct
