// CONTCT with the corrected rule (reference/corrected-rule.md): the same call, one event at a time.
#pragma once

#include "contct/kernel/call.hpp"

namespace contct {

/// theta of the rule, as a share of the largest response |d*|: a separated pair that approaches its face by
/// less than that has a d* of rounding. A missed make costs this share in position. A missed break locks in a
/// force, so pairs in contact have no threshold.
inline constexpr double quiet_share = 1e-10;

/// One call under the corrected rule: sets c.ss and c.smin and toggles at most one pair in c.isep.
void contct_corrected(call<double>& c) noexcept;

}  // namespace contct
