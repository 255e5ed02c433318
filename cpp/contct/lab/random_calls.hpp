// Random and adversarial calls of CONTCT, each a function of a seed and its number.
#pragma once

#include <cstdint>

#include "contct/kernel/call.hpp"

namespace contct {

/// Calls in one precision. A reference is good until the next call is asked for.
template <class Real>
class random_calls {
 public:
  explicit random_calls(std::uint64_t seed) : seed_(seed) {}

  /// Call `number` of those that reach every branch of the listing: 1 to 64 pairs, several of them on one
  /// node, every (INDOF, NDOFPN) from (1, 1) to (3, 3), nodes beyond 999 now and then. Half of the numbers
  /// lie on a coarse grid, so that ties, zero gaps and stationary pairs are common; others are scaled by
  /// powers of ten from 1e-15 to 1e5.
  const call_inputs<Real>& random(std::uint64_t number);

  /// Call `number` of those made against the listing. Every pair is made for one of its decisions: a response
  /// of either zero or the smallest number; a gap of EPSGAP; a response that makes SSCHK zero, subnormal or
  /// infinite; a scale factor that ties with the winner's, is within EPSMUL of it, or is 1 (the mark for "no
  /// event") or 256/257, where that mark is within EPSMUL: all exactly, or one or two ULP to either side; or
  /// numbers from the ends of the floating-point range: zeros, subnormals, the largest, infinities, NaN. Now
  /// and then there are many pairs, and invalid statuses.
  const call_inputs<Real>& adversarial(std::uint64_t number);

 private:
  std::uint64_t seed_;
  call_inputs<Real> in_;
};

extern template class random_calls<float>;
extern template class random_calls<double>;

/// The calls of a fuzz run: odd numbers are random, even ones adversarial.
class call_source {
 public:
  /// `real_bytes`: 8, or 4 for numbers and thresholds of single precision.
  call_source(std::uint64_t seed, int real_bytes) : real_bytes_(real_bytes), r8_(seed), r4_(seed) {}
  /// Call `number`, from 1; the reference is good until the one after.
  const call_inputs<double>& at(std::uint64_t number);

 private:
  int real_bytes_;
  random_calls<double> r8_;
  random_calls<float> r4_;
  call_inputs<double> wide_;
};

}  // namespace contct
