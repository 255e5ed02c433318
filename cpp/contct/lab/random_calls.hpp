// Random calls of CONTCT that reach every branch of the listing.
#pragma once

#include "contct/kernel/call_inputs.hpp"
#include "contct/numeric/random.hpp"

namespace contct {

/// Makes one call after the other: 1 to 64 pairs, several of them on one node, every (INDOF,
/// NDOFPN) from (1, 1) to (3, 3), nodes beyond 999 now and then. Half of the numbers lie on a
/// coarse grid, so that ties, closed gaps and pairs at rest are common; others are scaled by
/// powers of ten from 1e-15 to 1e5.
template <class Real>
class random_calls {
 public:
  explicit random_calls(std::uint64_t seed) : seed_(seed), random_(seed) {}

  /// The next call; the reference is good until the one after.
  const call_inputs<Real>& next();

  /// Call `number`, a function of it and the seed alone. What the call before left in dd and dtest is
  /// overwritten by NaN: nobody may read there.
  const call_inputs<Real>& at(std::uint64_t number);

 private:
  Real number(double zero_share, double grid_share);
  void place_pair(std::size_t i, int first_node, int nodes);

  std::uint64_t seed_;
  random_numbers random_;
  call_inputs<Real> in_;
};

extern template class random_calls<float>;
extern template class random_calls<double>;

}  // namespace contct
