// CONTCT with a repaired rule: the same call, right answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "contct/kernel/call.hpp"

namespace contct {

/// A separated pair that approaches its face by less than this share of the largest response does
/// not approach: its d* is the rounding of the solve. Closed pairs have no such threshold: a break
/// that is missed locks in a force, a make that is missed costs only that share in position.
inline constexpr double quiet_share = 1e-10;

/// s of one pair under the corrected rule, or of several side by side (a vector of Real), 1 where a pair has
/// no event ahead: it must move in its own direction, i_sep n d* > 0, by more than the threshold. A pair at
/// its face, or beyond it by rounding, has s = 0. Nothing branches, since half of all pairs go either way: on
/// thousands of them that is what a call costs. `sense` is i_sep n.
template <class Real>
[[nodiscard]] inline Real corrected_scale_factor(Real d, Real d_star, Real c, Real sense, Real threshold) {
  const Real one = Real{} + 1.0;
  const Real towards_event = sense * d_star;
  const auto moves = towards_event > threshold;
  const Real way = sense * (c - d);
  const Real s = (way > 0.0 ? way : Real{}) / (moves ? towards_event : one);
  const Real within = s > 1.0 ? one : s;
  return moves ? within : one;
}

/// One call of the corrected CONTCT: c.ss, c.smin and c.isep as the listing sets them, but one
/// event at a time: the first of the least s. Among pairs at their face (s = 0) it is the one
/// with the largest |d*|, as in the paper, until that has been tried for long enough, and then the
/// one of least index, which cannot go on for ever. `at_rest` counts the answers with SMIN = 0 right
/// before this one. Returns the event. reference/corrected-rule.md has the reasons.
std::optional<event> contct_corrected(call<double>& c, int at_rest) noexcept;

/// How many answers with SMIN = 0 in a row go by the largest |d*|, for `nc` pairs.
[[nodiscard]] constexpr int patience(int nc) {
  return 20 + 4 * nc;
}

}  // namespace contct
