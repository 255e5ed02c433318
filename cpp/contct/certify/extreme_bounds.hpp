// What inside a beam's elements can be further off than at their ends.
#pragma once

#include "contct/certify/error_bounds.hpp"

namespace contct::certify {

/// Widen `error`, which bounds the numbers at nodes and ends of elements, until it bounds the extremes of w,
/// moment and shear too that ranges_of finds along a beam. Those of plates and matrices are at nodes and
/// corners: nothing changes.
void widen_by_extremes(const problem& p, const handed_out& state, by_quantity& error);

}  // namespace contct::certify
