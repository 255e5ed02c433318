#include "contct/compare/early_toggles.hpp"

#include <algorithm>
#include <cmath>

#include "contct/compare/explanation.hpp"

namespace contct::compare {

void early_toggles::called(const answered_call& c) {
  last_call_.clear();
  for (std::size_t i = 0; i < c.isep_before.size(); ++i) {
    const int dof = c.c.dof.dof_of(c.c.id[i]) - 1;
    const double reached = c.c.dd[dof] + c.c.smin * c.c.dtest[dof];
    if (std::isfinite(reached)) largest_ = std::max(largest_, std::abs(reached));
    if (c.c.isep[i] != c.isep_before[i])
      last_call_.push_back({static_cast<int>(i), std::abs(c.c.cc[i] - reached)});
  }
}

void early_toggles::incremented(const increment& i) {
  for (const event& e : i.events) {
    const auto at =
        std::find_if(last_call_.begin(), last_call_.end(), [&e](const auto& d) { return d.pair == e.pair; });
    if (at == last_call_.end() || !(at->distance > rounding_share(sizeof(double)) * largest_)) continue;
    all_.push_back({i.step, i.number, e, at->distance, at->distance / largest_});
  }
}

}  // namespace contct::compare
