#include "contct/kernel/corrected.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace contct {
namespace {

/// The dof of pair `i`, from 0.
std::size_t dof_at(const call<double>& c, std::size_t i) {
  return c.dof.dof_of(c.id[i]) - 1;
}

/// Rules 1 and 2: s of each pair, or 1 where it has no event ahead. A division in vain costs less than a
/// wrongly guessed branch, and a loop of its own lets the compiler divide for two pairs at a time.
void find_scale_factors(call<double>& c) {
  const std::size_t nc = c.cc.size();
  double m = 0.0;
  for (std::size_t i = 0; i < nc; ++i) m = std::max(m, std::abs(c.dtest[dof_at(c, i)]));
  for (std::size_t i = 0; i < nc; ++i) {
    const double sigma_n = static_cast<double>(c.isep[i]) * c.isurf[i];
    const double gap = sigma_n * (c.cc[i] - c.dd[dof_at(c, i)]);
    c.ss[i] = (gap > 0.0 ? gap : 0.0) / (sigma_n * c.dtest[dof_at(c, i)]);
  }
  const double quiet = quiet_share * m;
  for (std::size_t i = 0; i < nc; ++i) {
    const double sigma_v = static_cast<double>(c.isep[i]) * c.isurf[i] * c.dtest[dof_at(c, i)];
    const double theta = c.isep[i] == separated ? quiet : 0.0;
    const double s = c.ss[i] > 1.0 ? 1.0 : c.ss[i];
    c.ss[i] = sigma_v > theta ? s : 1.0;
  }
}

}  // namespace

void contct_corrected(call<double>& c) noexcept {
  find_scale_factors(c);
  c.smin = 1.0;
  for (const double s : c.ss) c.smin = std::min(c.smin, s);
  if (c.smin == 1.0) return;

  // Rules 3 and 4: the first pair at SMIN; but of those at their faces the one with the largest |d*|.
  const auto size_of_response = [&c](std::size_t i) { return std::abs(c.dtest[dof_at(c, i)]); };
  const bool by_index = c.smin > 0.0;
  std::size_t chosen = c.cc.size();
  for (std::size_t i = 0; i < c.cc.size(); ++i) {
    if (c.ss[i] != c.smin) continue;
    if (chosen == c.cc.size() || (!by_index && size_of_response(i) > size_of_response(chosen))) chosen = i;
    if (by_index) break;
  }
  c.isep[chosen] = c.isep[chosen] == separated ? in_contact : separated;
}

}  // namespace contct
