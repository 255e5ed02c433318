#include "contct/kernel/corrected.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace contct::kernels {
namespace {

/// d* of pair `i`.
double response(const call<double>& c, std::size_t i) {
  return c.dtest[c.dof.dof_of(c.id[i]) - 1];
}

/// Rules 1 and 2: s of pair `i`, or 1 where it has no event ahead. `m` is the largest |d*|.
double scale_factor(const call<double>& c, std::size_t i, double m) {
  const double d = c.dd[c.dof.dof_of(c.id[i]) - 1];
  const double sigma_n = c.isep[i] * c.isurf[i];
  const double theta = c.isep[i] == separated ? quiet_share * m : 0.0;
  const double sigma_v = sigma_n * response(c, i);
  const double s = std::min(std::max(0.0, sigma_n * (c.cc[i] - d)) / sigma_v, 1.0);
  return sigma_v > theta ? s : 1.0;  // a division in vain costs less than a wrongly guessed branch
}

}  // namespace

void contct_corrected(call<double>& c) noexcept {
  double m = 0.0;
  for (std::size_t i = 0; i < c.cc.size(); ++i) m = std::max(m, std::abs(response(c, i)));
  double s_min = 1.0;
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    const double s = scale_factor(c, i, m);
    c.ss[i] = s;
    s_min = std::min(s_min, s);
  }
  c.smin = s_min;
  if (c.smin == 1.0) return;

  // Rules 3 and 4: the first pair at SMIN; but of those at their faces the one with the largest |d*|.
  const bool by_index = c.smin > 0.0 || c.at_rest >= quick_answers_at_rest(c.nc());
  std::size_t chosen = c.cc.size();
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    if (c.ss[i] != c.smin) continue;
    if (chosen == c.cc.size() || (!by_index && std::abs(response(c, i)) > std::abs(response(c, chosen))))
      chosen = i;
  }
  c.isep[chosen] = c.isep[chosen] == separated ? in_contact : separated;
}

}  // namespace contct::kernels
