// CONTCT with the corrected rule (reference/corrected-rule.md): the same call, one event at a time.
#pragma once

#include "contct/kernel/call.hpp"

namespace contct::kernels {

/// theta of the rule, as a share of the largest response |d*|: a separated pair that approaches its face by
/// less than that has a d* of rounding. A missed make costs this share in position. A missed break locks in a
/// force, so pairs in contact have no threshold.
inline constexpr double quiet_share = 1e-10;

/// For how many answers in a row with SMIN = 0 the largest |d*| decides among `nc` pairs, before the least
/// index does.
[[nodiscard]] constexpr int quick_answers_at_rest(int nc) {
  return 20 + 4 * nc;
}

/// One call under the corrected rule: sets c.ss and c.smin and toggles at most one pair in c.isep. c.at_rest
/// decides between the two choices at SMIN = 0.
void contct_corrected(call<double>& c) noexcept;

}  // namespace contct::kernels
