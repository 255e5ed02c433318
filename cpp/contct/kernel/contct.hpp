// CONTCT in C++: the listing's arithmetic, operation for operation, and the corrected rule.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "contct/kernel/call.hpp"

namespace contct {

/// The constants of the listing's DATA statement. Each literal has the precision of the build: the
/// single-precision 1.E-20 is not the double nearest to 1e-20.
template <class Real>
struct constants;

template <>
struct constants<float> {
  static constexpr float delta = 1.E-20F;
  static constexpr float epsgap = 1.E-10F;
  static constexpr float epsmul = .390625E-02F;  // 2^-8
};

template <>
struct constants<double> {
  static constexpr double delta = 1.E-20;
  static constexpr double epsgap = 1.E-10;
  static constexpr double epsmul = .390625E-02;
};

/// Returns the scale factor s of one pair, computed as in the body of the listing's DO 10 loop (steps 3 to 11
/// of the paper's algorithm). Arguments: deflection D, response d*, face c, ISEP and ISURF.
template <class Real>
[[nodiscard]] Real scale_factor(Real d, Real d_star, Real c, int i_sep, int i_surf) {
  const Real gap = c - d;                 // eq. 5, without its sign
  if (d_star == Real(0)) return Real(1);  // no response, no event
  if (std::abs(gap) < constants<Real>::epsgap) {
    const Real s_chk = static_cast<Real>(i_sep * i_surf) / d_star;      // eq. 11
    return s_chk > Real(0) ? s_chk * constants<Real>::delta : Real(1);  // eq. 12
  }
  return gap / d_star;  // eq. 4
}

/// One call of CONTCT. Sets c.ss and c.smin, toggles c.isep, and writes the events, in order of pairs, to
/// `events` (length at least nc). Returns the number of events; 0 means that the whole residual load can be
/// applied. Allocates no memory, prints nothing, and throws no exception.
template <class Real>
[[gnu::noinline]] int contct(call<Real>& c, std::span<event> events) noexcept;

template <class Real>
int contct(call<Real>& c, std::span<event> events) noexcept {
  const std::size_t nc = c.cc.size();
  Real s_min = Real(1);
  for (std::size_t i = 0; i < nc; ++i) {  // DO 10
    const std::size_t dof = c.dof.dof_of(c.id[i]) - 1;
    const Real s = scale_factor(c.dd[dof], c.dtest[dof], c.cc[i], c.isep[i], c.isurf[i]);
    c.ss[i] = s;
    if (s > Real(0) && s < s_min) s_min = s;  // eq. 9
  }
  c.smin = s_min;
  if (s_min == Real(1)) return 0;

  int happened = 0;
  for (std::size_t i = 0; i < nc; ++i) {  // DO 30
    const Real diff = std::abs(c.ss[i] - s_min) / s_min;
    if (diff < constants<Real>::epsmul) {
      const bool makes = c.isep[i] == separated;
      c.isep[i] = makes ? in_contact : separated;
      events[happened++] = {static_cast<int>(i), makes ? change::make : change::break_};
    }
  }
  return happened;
}

/// One call under the corrected rule (reference/corrected-rule.md). Sets c.ss and c.smin, and toggles at most
/// one pair in c.isep.
void contct_corrected(call<double>& c) noexcept;

}  // namespace contct
