// CONTCT with the corrected rule (reference/corrected-rule.md): the same call, one event at a time.
#pragma once

#include "contct/kernel/call.hpp"
#include "contct/kernel/wide_scan.hpp"

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

/// Rules 1 and 2: s of pair `i`, or 1 where it has no event ahead. `m` is the largest |d*|.
[[nodiscard]] double corrected_scale_factor(const call<double>& c, std::size_t i, double m) noexcept;

/// The same call to the bit, for thousands of pairs: nothing branches, and several pairs are divided at once.
void contct_corrected_quick(call<double>& c, const wide_scan& scan = widest_scan()) noexcept;

}  // namespace contct::kernels
