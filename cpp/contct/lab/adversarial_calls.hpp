// Calls made against the listing: every threshold exactly, and to the ULP on both sides.
#pragma once

#include "contct/kernel/call_inputs.hpp"
#include "contct/numeric/random.hpp"

namespace contct {

/// Every pair of a call is made for one decision of the listing: a response of either zero or the smallest
/// number; a gap of EPSGAP; a response that makes SSCHK zero, subnormal or infinite; a scale factor that ties
/// with the winner's, is within EPSMUL of it, or is 1 (the mark for "no event") or 256/257, where
/// that mark is within EPSMUL: all with none, one or two ULP to either side; or has numbers from
/// the edges of the line: zeros, subnormals, the largest, infinities, NaN. Now and then there are many
/// pairs, and statuses that are none.
template <class Real>
class adversarial_calls {
 public:
  explicit adversarial_calls(std::uint64_t seed) : seed_(seed), random_(seed) {}

  /// Call `number`, a function of it and the seed alone; the reference is good until the one after.
  const call_inputs<Real>& at(std::uint64_t number);

 private:
  void begin_call();
  void place_pair(std::size_t i);
  /// `x`, or its neighbour or its neighbour's on either side.
  Real nudged(Real x);
  Real from_the_edges();
  Real some_response();
  void place_gap(std::size_t dof, std::size_t i, Real gap);

  std::uint64_t seed_;
  random_numbers random_;
  Real s_ = 0;  // the scale factor that this call's ties are about
  call_inputs<Real> in_;
};

extern template class adversarial_calls<float>;
extern template class adversarial_calls<double>;

}  // namespace contct
