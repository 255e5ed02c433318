// Is the end of a step an equilibrium? Judged from K, the loads and the pairs alone, without any solve.
#pragma once

#include <string>

#include "contct/exact/path.hpp"

namespace contct::exact {

/// The first condition that does not hold exactly; empty where the state is an equilibrium under the full
/// load.
inline std::string wrong_with(const exact_problem& p, const exact_step& acting, const exact_step_end& e) {
  if (e.fraction != 1) return "the load is not reached";
  vector rest = acting.load;
  for (std::size_t dof = 0; dof < p.dofs(); ++dof)
    for (const auto& [column, k] : p.stiffness[dof])
      rest[dof] -= k * e.displacement[static_cast<std::size_t>(column)];
  for (std::size_t i = 0; i < p.pairs.size(); ++i) {
    const exact_pair& c = p.pairs[i];
    const auto dof = static_cast<std::size_t>(c.dof);
    const rational gap = c.surface * (c.face - e.displacement[dof]);
    const rational force = gap < 0 ? rational(-c.stiffness * gap) : rational(0);
    rest[dof] -= c.surface * force;
    if (e.gap[i] < 0 || e.force[i] < 0 || e.force[i] != force || (e.closed[i] == 0 && e.gap[i] != gap))
      return "pair " + std::to_string(i + 1) + " is not on its side of its face";
  }
  for (std::size_t i = 0; i < p.supports.size(); ++i)
    if (p.supports[i].fixed) rest[static_cast<std::size_t>(p.supports[i].dof)] += e.reactions[i];
  for (std::size_t dof = 0; dof < p.dofs(); ++dof) {
    if (rest[dof] != 0) return "dof " + std::to_string(dof + 1) + " is not in balance";
    if (p.fixed[dof] != 0 && e.displacement[dof] != acting.settlement[dof])
      return "dof " + std::to_string(dof + 1) + " is not where its support holds it";
  }
  return "";
}

}  // namespace contct::exact
