#include "contct/compare/path_observers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "contct/compare/explanation.hpp"

namespace contct::compare {

void early_toggles::called(const answered_call& c) {
  distances_.assign(c.isep_before.size(), 0.0);
  for (std::size_t i = 0; i < c.isep_before.size(); ++i) {
    const int dof = c.c.dof.dof_of(c.c.id[i]) - 1;
    const double reached = c.c.dd[dof] + c.c.smin * c.c.dtest[dof];
    if (std::isfinite(reached)) largest_ = std::max(largest_, std::abs(reached));
    if (c.c.isep[i] != c.isep_before[i]) distances_[i] = std::abs(c.c.cc[i] - reached);
  }
}

void early_toggles::incremented(const increment& i) {
  const double rounding = rounding_share(sizeof(double)) * largest_;
  for (const event& e : i.events) {
    const double distance = e.pair < std::ssize(distances_) ? distances_[e.pair] : 0.0;
    if (distance > rounding) all_.push_back({i.step, i.number, e, distance, distance / largest_});
  }
}

}  // namespace contct::compare
