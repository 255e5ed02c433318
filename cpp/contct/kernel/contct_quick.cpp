#include "contct/kernel/contct_quick.hpp"

#include <cmath>

namespace contct::kernels {
namespace {

/// DO 10.
void find_scale_factors(call<double>& c, const wide_scan& scan) {
  const pair_arrays a = arrays_of(c, scan);
  c.smin = scan.listing(a).s;
  for (std::size_t i = scan.whole(a.n); i < a.n; ++i) {
    const std::size_t dof = c.dof.dof_of(c.id[i]) - 1;
    const double s = scale_factor(c.dd[dof], c.dtest[dof], c.cc[i], c.isep[i], c.isurf[i]);
    c.ss[i] = s;
    if (s > 0.0 && s < c.smin) c.smin = s;
  }
}

/// DO 30. Only pairs whose |s - s_min| is at most EPSMUL s_min can be within EPSMUL, and these are few: the
/// quotient, whose rounding counts, is computed for them alone.
int toggle(call<double>& c, std::span<event> events, const wide_scan& scan) {
  const std::size_t n = c.ss.size();
  const double bound = constants<double>::epsmul * c.smin;
  int happened = 0;
  for (std::size_t i = scan.near(c.ss.data(), 0, n, c.smin, bound); i < n;
       i = scan.near(c.ss.data(), i + 1, n, c.smin, bound)) {
    const double diff = std::abs(c.ss[i] - c.smin) / c.smin;
    if (!(diff < constants<double>::epsmul)) continue;
    const bool makes = c.isep[i] == separated;
    c.isep[i] = makes ? in_contact : separated;
    events[happened++] = {static_cast<int>(i), makes ? change::make : change::break_};
  }
  return happened;
}

}  // namespace

pair_arrays arrays_of(call<double>& c, const wide_scan& scan) {
  placing placed = placing::anyhow;
  if (scan.counts_up(c.id.data(), c.id.size()))
    placed = c.dof.ndofpn == 1 ? placing::side_by_side : placing::evenly;
  return {.d = c.dd.data(),
          .d_star = c.dtest.data(),
          .c = c.cc.data(),
          .s = c.ss.data(),
          .id = c.id.data(),
          .i_sep = c.isep.data(),
          .i_surf = c.isurf.data(),
          .n = c.cc.size(),
          .step = c.dof.ndofpn,
          .dof_0 = c.dof.dof_of(0) - 1,
          .placed = placed};
}

int contct_wide(call<double>& c, std::span<event> events, const wide_scan& scan) noexcept {
  find_scale_factors(c, scan);
  return c.smin == 1.0 ? 0 : toggle(c, events, scan);
}

}  // namespace contct::kernels
