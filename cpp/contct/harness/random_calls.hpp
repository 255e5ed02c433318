// Random and adversarial calls of CONTCT, each determined by a seed and its number.
#pragma once

#include <cstdint>

#include "contct/kernel/call.hpp"

namespace contct {

/// The calls of a fuzz run, with numbers in REAL of `real_bytes`. A returned reference is valid until the
/// next call is drawn.
class call_source {
 public:
  call_source(std::uint64_t seed, int real_bytes) : seed_(seed), real_bytes_(real_bytes) {}

  /// Call `number`, from 1: odd numbers are random, even ones adversarial.
  const call_inputs& at(std::uint64_t number) {
    return number % 2 == 1 ? random(number) : adversarial(number);
  }

  /// A call with 1 to 64 pairs, some on the same node, INDOF and NDOFPN from 1 to 3, and sometimes nodes
  /// beyond 999. These calls reach every branch of the listing. Half of the nonzero numbers lie on a coarse
  /// grid, so that ties, zero gaps and stationary pairs are common; the other numbers lie between -1 and 1,
  /// and some of them are scaled by a power of ten from 1e-15 to 1e5.
  const call_inputs& random(std::uint64_t number);

  /// A call at the thresholds of the listing. Each pair is made for one IF: a response of zero or of the
  /// smallest number; a gap of EPSGAP; a response that makes SSCHK zero, subnormal or infinite; a scale
  /// factor at the winner's, at EPSMUL from the winner's, at 1 (the mark for "no event"), or at 256/257
  /// (for which DIFF of the mark 1 is EPSMUL). Numbers meet their threshold exactly, or miss the threshold by
  /// one or two ULP. Other pairs have numbers from the ends of the floating-point range: zeros, subnormals,
  /// the largest numbers, infinities, NaN. Some calls have many pairs, or invalid statuses.
  const call_inputs& adversarial(std::uint64_t number);

 private:
  std::uint64_t seed_;
  int real_bytes_;
  call_inputs in_;
};

}  // namespace contct
