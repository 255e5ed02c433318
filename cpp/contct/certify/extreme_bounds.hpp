// What inside a beam's elements can be further off than at their ends.
#pragma once

#include "contct/certify/error_bounds.hpp"

namespace contct::certify {

/// Widen the errors, which bound the numbers at nodes and ends of elements, until they bound the extremes of
/// w, moment and shear too that ranges_of finds along a beam, where w in the middle of elements has a size
/// too. Those of plates and matrices are at nodes and corners: nothing changes.
void widen_by_extremes(const problem& p, const handed_out& state, error_bounds& b);

}  // namespace contct::certify
