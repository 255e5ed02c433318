// CONTCT in C++ for many pairs: several of them at a time, the same to the bit as the plain loops of
// contct.hpp.
#pragma once

#include <span>

#include "contct/kernel/contct.hpp"
#include "contct/kernel/wide_scan.hpp"

namespace contct::kernels {

/// One call of CONTCT, as contct() answers it, by that scan.
int contct_wide(call<double>& c, std::span<event> events, const wide_scan& scan = widest_scan()) noexcept;

/// The same by whichever is the quicker. A mutant of contct.hpp is asked for every call, whatever
/// instructions the processor has.
template <class Real>
int contct_quick(call<Real>& c, std::span<event> events) noexcept {
  return contct(c, events);
}
#ifndef CONTCT_PLAIN_LOOPS
template <>
inline int contct_quick(call<double>& c, std::span<event> events) noexcept {
  return c.cc.size() < widest_scan().many_pairs ? contct(c, events) : contct_wide(c, events);
}
#endif

/// The arrays of `c`, with their placing among the dofs.
[[nodiscard]] pair_arrays arrays_of(call<double>& c, const wide_scan& scan);

}  // namespace contct::kernels
