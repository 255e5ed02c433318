#include "contct/kernel/corrected.hpp"

namespace contct {

std::optional<event> contct_corrected(call<double>& c, int at_rest) noexcept {
  const auto dof = [&c](std::size_t i) { return static_cast<std::size_t>(c.dof.dof_of(c.id[i]) - 1); };
  const std::size_t nc = c.cc.size();
  double largest = 0.0;
  for (std::size_t i = 0; i < nc; ++i) largest = std::max(largest, std::abs(c.dtest[dof(i)]));

  const bool by_index = at_rest >= patience(c.nc());
  std::size_t chosen = nc;
  double response = 0.0;  // |d*| of the chosen pair
  c.smin = 1.0;
  for (std::size_t i = 0; i < nc; ++i) {
    const double d_star = c.dtest[dof(i)];
    const double s = corrected_scale_factor(c.dd[dof(i)], d_star, c.cc[i], c.isep[i], c.isurf[i], largest);
    c.ss[i] = std::min(s, 1.0);
    const bool stronger = s == 0.0 && c.smin == 0.0 && !by_index && std::abs(d_star) > response;
    if (!(s < c.smin) && !stronger) continue;
    c.smin = s;
    chosen = i;
    response = std::abs(d_star);
  }
  if (chosen == nc) return {};
  const bool makes = c.isep[chosen] == separated;
  c.isep[chosen] = makes ? in_contact : separated;
  return event{static_cast<int>(chosen), makes ? change::make : change::break_};
}

}  // namespace contct
